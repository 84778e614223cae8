#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "limn/shadow/brick_format.h"

namespace limn {

/// The depths that may stand for an element: whole numbers of depth_step from low to high.
struct DepthRange {
    std::int32_t low, high;

    static constexpr DepthRange background() { return {1, 0}; }
    /// Of an element that nobody asks for: outside the maps, or beyond the grid.
    static constexpr DepthRange anything() { return {-1, 1 << depth_bits}; }
    bool is_background() const { return low > high; }
    bool is_anything() const { return low < 0; }
    bool is_surface() const { return low >= 0 && low <= high; }
};

/// Those between two surfaces, away from both by the margin; at least one that is not before the first and before the second.
DepthRange depth_range(float near, float far, float margin);

/// What a brick was made into.
struct EncodedBrick {
    enum class Kind : std::uint8_t {
        background, ///< nothing more is to be said
        constant,   ///< one surface depth, `value`, everywhere
        general,    ///< `bytes`
    };
    Kind kind = Kind::background;
    std::uint8_t value = 0; ///< of 8 bits
    std::string bytes;
};

/// Makes bricks; keeps its memory from brick to brick. What is decoded is within the range of every element, and as much in its middle as the
/// brick's few different depths allow.
///
/// The depths are the fewest that hit all ranges, each moved to where it hits most. The elements that have a surface and those that have none are
/// told apart by one tree, the depths by another, in which elements without a surface count as any. Each tree halves the brick along the axes in
/// the order that makes it smallest. (The coherent shadow map specification, 10.1: the hierarchical tree, after Scandolo, Bauszat and Eisemann 2016.)
class BrickEncoder {
public:
    /// @param elements  brick_elements of them: x, then y, s and t
    EncodedBrick encode(const std::vector<DepthRange>& elements);

private:
    struct Value {
        std::int32_t depth;
        int kind; ///< 0, 1, 2: of 8, 12 and 20 bits
    };
    struct Tree {
        std::uint32_t order = 0, nodes = 0, last_nodes = 0;
    };
    void find_values(const std::vector<DepthRange>& elements);
    void count_hits(const std::vector<DepthRange>& elements);
    Value best_value(DepthRange range) const;
    Tree outline_tree(const std::vector<DepthRange>& elements);
    Tree depth_tree(const std::vector<DepthRange>& elements);
    void find_fits(const std::vector<DepthRange>& elements);
    void merge_outline(const std::vector<DepthRange>& elements, std::uint32_t order);
    void merge_fits(std::uint32_t order);
    std::uint32_t most_central(const std::vector<DepthRange>& elements, std::uint32_t order, std::size_t node, std::uint32_t first, std::uint32_t count) const;
    void write_outline(std::string& bytes, std::size_t& bit) const;
    void write_depths(const std::vector<DepthRange>& elements, const Tree& tree, std::string& bytes, std::size_t& bit) const;

    std::vector<std::uint64_t> sorted_; ///< ranges by their upper end
    std::vector<std::int32_t> hits_;    ///< of depths of 12 bits
    std::vector<Value> values_;
    std::size_t words_ = 1;             ///< of 64 values each
    std::vector<std::uint64_t> fits_;   ///< by element: which values are in its range
    // Trees by node: 1 is the root, and 2 n and 2 n + 1 are the halves of n.
    std::vector<std::uint8_t> outline_; ///< 1: background in it, 2: surface in it
    std::vector<std::uint64_t> common_; ///< words_ for each node: the values that fit all of it
};

} // namespace limn
