#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

/// A table of text cells, written as markdown with columns of one width.
class MarkdownTable {
public:
    explicit MarkdownTable(std::vector<std::string> header) : rows_{std::move(header)} {}
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    std::string text() const;
    const std::vector<std::vector<std::string>>& rows() const { return rows_; }

private:
    std::vector<std::vector<std::string>> rows_; ///< the header first
};

/// A table as a list of rows, a member for each column; numbers as they stand in the text.
nlohmann::ordered_json json_of(const MarkdownTable& table);

/// The middle of some measurements; the mean of the two middle ones of an even number. At least one.
double median(std::vector<double> values);

/// The slope of log(time) over log(size) by least squares: 1 where time grows as size does. At least two sizes.
double scaling_exponent(const std::vector<double>& sizes, const std::vector<double>& times);

/// "4 x Some Processor": cores and their name.
std::string machine_name();
