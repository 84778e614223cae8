#include "limn/shadow/brick_encoder.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace limn {
namespace {

constexpr int value_bits[3] = {8, 12, 20};
constexpr int hit_shift = depth_bits - 12;
constexpr std::size_t hit_bins = (std::size_t(1) << 12) + 2;
constexpr int most_tries = 16; ///< places that are tried for a value
constexpr std::uint8_t any = 0, background = 1, surface = 2, both = 3;

/// Writes the lowest bits of a number at a bit.
void put(std::string& bytes, std::size_t& bit, std::uint64_t value, int count)
{
    for (int done = 0; done < count;) {
        if (bit / 8 == bytes.size())
            bytes += '\0';
        const int room = std::min(int(8 - bit % 8), count - done);
        bytes[bit / 8] = char(static_cast<unsigned char>(bytes[bit / 8]) | (value >> done & ((1u << room) - 1)) << bit % 8);
        done += room, bit += std::size_t(room);
    }
}

/// The first multiple of 2^shift from a number on, as how many it is.
std::int32_t first_multiple(std::int32_t from, int shift) { return (from + (1 << shift) - 1) >> shift; }

std::uint32_t way_of(std::uint32_t order, std::size_t element)
{
    const auto& ways = brick_ways[order];
    return std::uint32_t(ways[0][element & 7] | ways[1][element >> 3 & 7] | ways[2][element >> 6 & 7] | ways[3][element >> 9]);
}

/// For each order the element at the end of each way.
const std::array<std::array<std::uint16_t, brick_elements>, brick_orders>& elements_by_way()
{
    static const auto table = [] {
        std::array<std::array<std::uint16_t, brick_elements>, brick_orders> all = {};
        for (std::uint32_t order = 0; order < brick_orders; ++order)
            for (std::size_t element = 0; element < brick_elements; ++element)
                all[order][way_of(order, element)] = std::uint16_t(element);
        return all;
    }();
    return table;
}

} // namespace

DepthRange depth_range(float near, float far, float margin)
{
    const auto between = [](double low, double high) {
        constexpr std::int32_t steps = 1 << depth_bits;
        return DepthRange{std::max(0, std::int32_t(std::ceil(low * steps))), std::min(steps, std::int32_t(std::ceil(high * steps))) - 1};
    };
    const double away = double(margin) * (double(far) - near);
    const DepthRange wanted = between(near + away, far - away);
    if (!wanted.is_background())
        return wanted;
    const DepthRange possible = between(near, far); // the surfaces are further apart than a step (depth_layers.h)
    const std::int32_t middle = (possible.low + possible.high) / 2;
    return {middle, middle};
}

EncodedBrick BrickEncoder::encode(const std::vector<DepthRange>& elements)
{
    const bool any_surface = std::any_of(elements.begin(), elements.end(), [](const DepthRange& r) { return r.is_surface(); });
    if (!any_surface)
        return {};
    const bool any_background = std::any_of(elements.begin(), elements.end(), [](const DepthRange& r) { return r.is_background(); });
    find_values(elements);
    if (!any_background && values_.size() == 1 && values_[0].kind == 0)
        return {EncodedBrick::Kind::constant, std::uint8_t(values_[0].depth >> (depth_bits - 8)), {}};
    const Tree outline = any_background ? outline_tree(elements) : Tree{};
    const Tree depths = values_.size() > 1 ? depth_tree(elements) : Tree{};
    BrickHeader header = {outline.order, depths.order, outline.nodes, depths.nodes, {}};
    for (const Value& value : values_)
        ++header.values[std::size_t(value.kind)];
    EncodedBrick brick{EncodedBrick::Kind::general, 0, {}};
    std::size_t bit = 0;
    const bool small = header.is_small();
    put(brick.bytes, bit, small, 1);
    put(brick.bytes, bit, header.outline_order, 2);
    put(brick.bytes, bit, header.depth_order, 2);
    put(brick.bytes, bit, header.outline_nodes, small ? 7 : 9);
    put(brick.bytes, bit, header.depth_nodes, small ? 7 : 9);
    for (const std::uint32_t count : header.values)
        put(brick.bytes, bit, count, small ? 5 : 11);
    for (const Value& value : values_)
        put(brick.bytes, bit, std::uint32_t(value.depth) >> (depth_bits - value_bits[value.kind]), value_bits[value.kind]);
    if (outline.nodes > 0)
        write_outline(brick.bytes, bit);
    if (depths.nodes > 0)
        write_depths(elements, depths, brick.bytes, bit);
    return brick;
}

void BrickEncoder::count_hits(const std::vector<DepthRange>& elements)
{
    hits_.assign(hit_bins, 0);
    for (const DepthRange& range : elements)
        if (range.is_surface()) {
            const std::int32_t first = first_multiple(range.low, hit_shift), last = range.high >> hit_shift;
            if (first <= last)
                ++hits_[std::size_t(first)], --hits_[std::size_t(last) + 1];
        }
    for (std::size_t i = 1; i < hit_bins; ++i)
        hits_[i] += hits_[i - 1];
}

BrickEncoder::Value BrickEncoder::best_value(DepthRange range) const
{
    for (int kind = 0; kind < 2; ++kind) {
        const int shift = depth_bits - value_bits[kind];
        const std::int32_t first = first_multiple(range.low, shift), last = std::min(range.high >> shift, (1 << value_bits[kind]) - 1);
        if (first > last)
            continue;
        const std::int32_t step = std::max(1, (last - first) / most_tries);
        Value best{first << shift, kind};
        for (std::int32_t k = first; k <= last; k += step)
            if (hits_[std::size_t(k << shift >> hit_shift)] > hits_[std::size_t(best.depth >> hit_shift)])
                best.depth = k << shift;
        return best;
    }
    return {(range.low + range.high) / 2, 2};
}

/// The fewest depths that hit all ranges are the upper ends of those that no depth before hits, from below.
void BrickEncoder::find_values(const std::vector<DepthRange>& elements)
{
    sorted_.clear();
    for (const DepthRange& range : elements)
        if (range.is_surface())
            sorted_.push_back(std::uint64_t(range.high) << 32 | std::uint64_t(range.low));
    std::sort(sorted_.begin(), sorted_.end());
    count_hits(elements);
    values_.clear();
    DepthRange group = {0, -1};
    for (const std::uint64_t pair : sorted_) {
        const auto low = std::int32_t(pair & 0xFFFFFFFF), high = std::int32_t(pair >> 32);
        if (group.high >= 0 && low <= group.high) {
            group.low = std::max(group.low, low);
            continue;
        }
        if (group.high >= 0)
            values_.push_back(best_value(group));
        group = {low, high};
    }
    values_.push_back(best_value(group));
    std::stable_sort(values_.begin(), values_.end(), [](const Value& a, const Value& b) { return a.kind < b.kind; });
}

void BrickEncoder::merge_outline(const std::vector<DepthRange>& elements, std::uint32_t order)
{
    outline_.resize(2 * brick_elements);
    const auto& by_way = elements_by_way()[order];
    for (std::size_t way = 0; way < brick_elements; ++way) {
        const DepthRange& range = elements[by_way[way]];
        outline_[brick_elements + way] = range.is_anything() ? any : range.is_background() ? background : surface;
    }
    for (std::size_t node = brick_elements - 1; node > 0; --node)
        outline_[node] = outline_[2 * node] | outline_[2 * node + 1];
}

BrickEncoder::Tree BrickEncoder::outline_tree(const std::vector<DepthRange>& elements)
{
    Tree best;
    for (std::uint32_t order = 0; order < brick_orders; ++order) {
        merge_outline(elements, order);
        const auto above_last = std::uint32_t(std::count(outline_.begin() + 1, outline_.begin() + brick_elements / 2, both));
        if (order == 0 || above_last < best.nodes)
            best = {order, above_last, std::uint32_t(std::count(outline_.begin() + brick_elements / 2, outline_.begin() + brick_elements, both))};
    }
    merge_outline(elements, best.order);
    return best;
}

void BrickEncoder::find_fits(const std::vector<DepthRange>& elements)
{
    words_ = (values_.size() + 63) / 64;
    fits_.assign(words_ * brick_elements, 0);
    for (std::size_t i = 0; i < brick_elements; ++i) {
        const DepthRange& range = elements[i];
        if (!range.is_surface()) {
            std::fill_n(fits_.begin() + std::ptrdiff_t(words_ * i), words_, ~std::uint64_t(0));
            continue;
        }
        for (std::size_t v = 0; v < values_.size(); ++v)
            fits_[words_ * i + v / 64] |= std::uint64_t(range.low <= values_[v].depth && values_[v].depth <= range.high) << v % 64;
    }
}

void BrickEncoder::merge_fits(std::uint32_t order)
{
    common_.resize(2 * brick_elements * words_);
    const auto& by_way = elements_by_way()[order];
    for (std::size_t way = 0; way < brick_elements; ++way)
        std::copy_n(fits_.begin() + std::ptrdiff_t(words_ * by_way[way]), words_, common_.begin() + std::ptrdiff_t(words_ * (brick_elements + way)));
    for (std::size_t node = brick_elements - 1; node > 0; --node)
        for (std::size_t word = 0; word < words_; ++word)
            common_[node * words_ + word] = common_[2 * node * words_ + word] & common_[(2 * node + 1) * words_ + word];
}

BrickEncoder::Tree BrickEncoder::depth_tree(const std::vector<DepthRange>& elements)
{
    find_fits(elements);
    const auto is_inner = [&](std::size_t node) {
        return std::all_of(common_.begin() + std::ptrdiff_t(node * words_), common_.begin() + std::ptrdiff_t((node + 1) * words_),
                           [](std::uint64_t word) { return word == 0; });
    };
    const auto width = std::uint32_t(std::bit_width(values_.size() - 1));
    Tree best;
    std::uint32_t best_cost = 0;
    for (std::uint32_t order = 0; order < brick_orders; ++order) {
        merge_fits(order);
        Tree tree{order, 0, 0};
        for (std::size_t node = 1; node < brick_elements; ++node)
            if (is_inner(node))
                ++(node < brick_elements / 2 ? tree.nodes : tree.last_nodes);
        const std::uint32_t cost = 2 * tree.nodes + width * (width == 1 ? tree.nodes : tree.nodes + tree.last_nodes);
        if (order == 0 || cost < best_cost)
            best = tree, best_cost = cost;
    }
    merge_fits(best.order);
    return best;
}

std::uint32_t BrickEncoder::most_central(const std::vector<DepthRange>& elements, std::uint32_t order, std::size_t node, std::uint32_t first, std::uint32_t count) const
{
    const auto& by_way = elements_by_way()[order];
    std::uint32_t best = 0;
    float best_score = -1;
    for (std::uint32_t v = 0; v < values_.size(); ++v) {
        if (!(common_[node * words_ + v / 64] >> v % 64 & 1))
            continue;
        float score = 0;
        for (std::uint32_t way = first; way < first + count; ++way) {
            const DepthRange& range = elements[by_way[way]];
            if (range.is_surface())
                score += float(std::min(values_[v].depth - range.low, range.high - values_[v].depth) + 1) / float(range.high - range.low + 1);
        }
        if (score > best_score)
            best = v, best_score = score;
    }
    return best;
}

void BrickEncoder::write_outline(std::string& bytes, std::size_t& bit) const
{
    std::vector<std::uint32_t> level = {1}, next;
    std::vector<bool> leaves, last;
    for (int depth = 0; depth < brick_levels - 1; ++depth) {
        next.clear();
        for (const std::uint32_t node : level)
            for (std::uint32_t half = 2 * node; half <= 2 * node + 1; ++half) {
                const bool inner = outline_[half] == both;
                put(bytes, bit, inner, 1);
                if (inner)
                    next.push_back(half);
                else
                    leaves.push_back(outline_[half] == surface);
            }
        level.swap(next);
    }
    for (const std::uint32_t node : level)
        leaves.push_back(outline_[2 * node] == surface);
    for (const bool is_surface : leaves)
        put(bytes, bit, is_surface, 1);
}

void BrickEncoder::write_depths(const std::vector<DepthRange>& elements, const Tree& tree, std::string& bytes, std::size_t& bit) const
{
    const int width = int(std::bit_width(values_.size() - 1));
    std::vector<std::uint32_t> level = {1}, next, leaves;
    const auto is_inner = [&](std::size_t node) {
        return std::all_of(common_.begin() + std::ptrdiff_t(node * words_), common_.begin() + std::ptrdiff_t((node + 1) * words_),
                           [](std::uint64_t word) { return word == 0; });
    };
    const auto leaf = [&](std::uint32_t node, int depth) {
        const std::uint32_t count = brick_elements >> depth;
        leaves.push_back(most_central(elements, tree.order, node, (node - (std::uint32_t(1) << depth)) * count, count));
    };
    for (int depth = 1; depth < brick_levels; ++depth) {
        next.clear();
        for (const std::uint32_t node : level)
            for (std::uint32_t half = 2 * node; half <= 2 * node + 1; ++half) {
                const bool inner = is_inner(half);
                put(bytes, bit, inner, 1);
                if (inner)
                    next.push_back(half);
                else
                    leaf(half, depth);
            }
        level.swap(next);
    }
    for (const std::uint32_t node : level) {
        leaf(2 * node, brick_levels);
        if (width > 1) // of two values, the other half has the other
            leaf(2 * node + 1, brick_levels);
    }
    for (const std::uint32_t value : leaves)
        put(bytes, bit, value, width);
}

} // namespace limn
