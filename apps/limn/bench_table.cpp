#include "bench_table.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include <fmt/format.h>

std::string MarkdownTable::text() const
{
    std::vector<std::size_t> widths(rows_[0].size(), 3);
    for (const auto& row : rows_)
        for (std::size_t k = 0; k < row.size(); ++k)
            widths[k] = std::max(widths[k], row[k].size());
    std::string out;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        for (std::size_t k = 0; k < widths.size(); ++k)
            out += k == 0 ? fmt::format("| {:<{}} ", rows_[r][k], widths[k]) : fmt::format("| {:>{}} ", rows_[r][k], widths[k]);
        out += "|\n";
        for (std::size_t k = 0; r == 0 && k < widths.size(); ++k)
            out += k == 0 ? fmt::format("|{:-<{}}", "", widths[k] + 2) : fmt::format("|{:-<{}}:", "", widths[k] + 1);
        out += r == 0 ? "|\n" : "";
    }
    return out;
}

nlohmann::ordered_json json_of(const MarkdownTable& table)
{
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (std::size_t r = 1; r < table.rows().size(); ++r) {
        nlohmann::ordered_json& row = rows.emplace_back(nlohmann::ordered_json::object());
        for (std::size_t k = 0; k < table.rows()[r].size(); ++k)
            row[table.rows()[0][k]] = table.rows()[r][k];
    }
    return rows;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

double scaling_exponent(const std::vector<double>& sizes, const std::vector<double>& times)
{
    const double n = double(sizes.size());
    double x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const double a = std::log(sizes[i]), b = std::log(times[i]);
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

std::string machine_name()
{
    std::string processor = "unknown processor", line;
    for (std::ifstream file("/proc/cpuinfo"); std::getline(file, line);)
        if (line.starts_with("model name")) {
            processor = line.substr(line.find(':') + 2);
            break;
        }
    return fmt::format("{} x {}", std::thread::hardware_concurrency(), processor);
}
