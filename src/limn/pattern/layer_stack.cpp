#include "limn/pattern/layer_stack.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"

// The shared text needs the dialect's word once more, inside of a struct.
#define FORMULA inline

namespace limn {
namespace formulas {

struct LayerTops {
    const float* tops;
    float layer_top(int k) const { return tops[k]; }
#include "limn/formulas/layer_table.glsl"
};

} // namespace formulas

namespace {

void check_height(double height)
{
    if (!(height > 0 && std::isfinite(height)))
        throw Error::Input(fmt::format("a layer height of {} is not above 0", height));
}

} // namespace

LayerStack::LayerStack(double height, double bottom, double first) : bottom_(float(bottom)), height_(float(height))
{
    check_height(height);
    if (first != 0) {
        check_height(first);
        tops_ = {float(bottom + first)};
    }
}

LayerStack::LayerStack(std::vector<double> heights, double bottom) : bottom_(float(bottom))
{
    if (heights.empty())
        throw Error::Input("a stack of layers needs at least one");
    double top = bottom;
    for (const double height : heights) {
        check_height(height);
        top += height;
        tops_.push_back(float(top));
    }
    height_ = float(heights.back());
}

LayerStack LayerStack::scaled(double factor, double shift) const
{
    LayerStack stack = *this;
    stack.bottom_ = float(double(bottom_) * factor + shift);
    stack.height_ = float(double(height_) * factor);
    for (float& top : stack.tops_)
        top = float(double(top) * factor + shift);
    return stack;
}

double LayerStack::layers_below(double at) const { return double(formulas::LayerTops{tops_.data()}.layers_below(row(), float(at))); }

formulas::LayerPlace LayerStack::place(float at, const vec2& change, float width) const
{
    return formulas::LayerTops{tops_.data()}.layer_place(row(), at, change, width);
}

std::vector<double> layer_heights_from_text(std::string_view text, const std::string& name)
{
    struct Entry {
        double z, height;
    };
    std::vector<Entry> pairs;
    std::vector<double> heights;
    int line = 0, columns = 0;
    while (!text.empty()) {
        ++line;
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view row = text.substr(0, end);
        text.remove_prefix(std::min(text.size(), end + 1));
        row = row.substr(0, row.find('#'));
        double numbers[2] = {};
        int count = 0;
        while (true) {
            const std::size_t start = row.find_first_not_of(" \t\r,;");
            if (start == std::string_view::npos)
                break;
            row.remove_prefix(start);
            const std::size_t size = std::min(row.find_first_of(" \t\r,;"), row.size());
            const std::string_view word = row.substr(0, size);
            row.remove_prefix(size);
            double value = 0;
            const auto [after, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
            if (failure != std::errc() || after != word.data() + word.size() || !std::isfinite(value))
                throw Error::Read(fmt::format("{}, line {}: '{}' is not a number", name, line, word));
            if (count == 2)
                throw Error::Read(fmt::format("{}, line {}: more than a height, or a Z and a height", name, line));
            numbers[count++] = value;
        }
        if (count == 0)
            continue;
        if (columns != 0 && columns != count)
            throw Error::Read(fmt::format("{}, line {}: {} numbers, where the lines before have {}", name, line, count, columns));
        columns = count;
        const double height = numbers[count - 1];
        if (!(height > 0 && height < 1000))
            throw Error::Read(fmt::format("{}, line {}: a layer height of {} mm is not above 0 and below 1000", name, line, height));
        if (count == 1) {
            heights.push_back(height);
            continue;
        }
        if (numbers[0] < 0 || (!pairs.empty() && !(numbers[0] > pairs.back().z)))
            throw Error::Read(fmt::format("{}, line {}: Z {} does not follow the one before", name, line, numbers[0]));
        pairs.push_back({numbers[0], height});
    }
    if (pairs.empty() && heights.empty())
        throw Error::Read(fmt::format("{}: no layer heights", name));
    if (pairs.empty())
        return heights;
    constexpr std::size_t most = 1000000;
    double top = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const double until = i + 1 < pairs.size() ? pairs[i + 1].z : top;
        do { // a last entry gives one layer, which goes on
            heights.push_back(pairs[i].height);
            top += pairs[i].height;
            if (heights.size() > most)
                throw Error::Read(fmt::format("{}: more than {} layers", name, most));
        } while (top < until - 1e-9);
    }
    return heights;
}

} // namespace limn
