#include "limn/lines/chain.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "limn/base/random.h"

namespace limn {
namespace {

/// A segment that is nothing but its two ids.
Segment link(std::uint32_t a, std::uint32_t b)
{
    Segment s;
    s.edge_a = a;
    s.edge_b = b;
    return s;
}

std::uint32_t id_at_start(const std::vector<Segment>& segments, const Link& l) { return l.reversed ? segments[l.segment].edge_b : segments[l.segment].edge_a; }
std::uint32_t id_at_end(const std::vector<Segment>& segments, const Link& l) { return l.reversed ? segments[l.segment].edge_a : segments[l.segment].edge_b; }

/// Segments and directions of a chain: -3 is segment 2 walked backwards.
std::vector<int> walk(const Chains& chains, std::size_t c)
{
    std::vector<int> result;
    for (const Link& l : chains[c])
        result.push_back(l.reversed ? -int(l.segment) - 1 : int(l.segment) + 1);
    return result;
}

TEST(Chain, OpenOnesComeFirstAndThenLoopsEachInTheOrderOfTheirFirstSegment)
{
    // Segments 0 and 3 are a loop, 1 and 4 a chain, 2 a chain of its own.
    const std::vector<Segment> segments = {link(10, 11), link(20, 21), link(30, 31), link(11, 10), link(21, 22)};
    const Chains chains = chain_segments(segments);
    ASSERT_EQ(chains.size(), 3u);
    EXPECT_EQ(walk(chains, 0), (std::vector<int>{2, 5}));
    EXPECT_EQ(walk(chains, 1), (std::vector<int>{3}));
    EXPECT_EQ(walk(chains, 2), (std::vector<int>{1, 4}));
    EXPECT_EQ(chains.closed, (std::vector<std::uint8_t>{0, 0, 1}));
}

TEST(Chain, WalksSegmentsThatRunTheOtherWayBackwards)
{
    const std::vector<Segment> segments = {link(1, 2), link(3, 2), link(3, 4)};
    const Chains chains = chain_segments(segments);
    ASSERT_EQ(chains.size(), 1u);
    EXPECT_EQ(walk(chains, 0), (std::vector<int>{1, -2, 3}));
    EXPECT_FALSE(chains.closed[0]);
}

TEST(Chain, StartsAtAFreeEndEvenWhereTheFirstSegmentMustBeTurned)
{
    const std::vector<Segment> segments = {link(2, 1), link(2, 3)}; // from 1 over 2 to 3
    const Chains chains = chain_segments(segments);
    ASSERT_EQ(chains.size(), 1u);
    EXPECT_EQ(walk(chains, 0), (std::vector<int>{-1, 2}));
}

TEST(Chain, EndsWhereThreeEndsMeet)
{
    const std::vector<Segment> segments = {link(1, 5), link(5, 2), link(5, 3)};
    const Chains chains = chain_segments(segments);
    EXPECT_EQ(chains.size(), 3u);
    EXPECT_EQ(std::count(chains.closed.begin(), chains.closed.end(), 1), 0);
}

TEST(Chain, LinksNothingAtTheIdNone)
{
    const std::vector<Segment> segments = {link(1, none), link(none, 2), link(none, none)};
    EXPECT_EQ(chain_segments(segments).size(), 3u);
}

TEST(Chain, ASegmentWhoseEndsMeetIsALoopOfOne)
{
    const Chains chains = chain_segments(std::vector{link(7, 7)});
    ASSERT_EQ(chains.size(), 1u);
    EXPECT_TRUE(chains.closed[0]);
}

TEST(Chain, OfNothingIsNothing)
{
    EXPECT_EQ(chain_segments({}).size(), 0u);
}

// Random loops and paths, cut up, turned and shuffled, are found again.
TEST(Chain, FindsShuffledLoopsAndPathsWhole)
{
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Random random(seed);
        std::vector<Segment> segments;
        std::size_t loops = 0, paths = 0;
        for (std::uint32_t line = 0; line < 20; ++line) {
            const std::uint32_t first = 1000 * line, n = 2 + random.below(200);
            const bool closed = random.below(2) == 1;
            (closed ? loops : paths) += 1;
            for (std::uint32_t k = 0; k < n; ++k)
                segments.push_back(link(first + k, closed && k + 1 == n ? first : first + k + 1));
        }
        for (std::size_t i = segments.size(); i > 1; --i)
            std::swap(segments[i - 1], segments[random.below(std::uint32_t(i))]);
        for (Segment& s : segments)
            if (random.below(2) == 1)
                std::swap(s.edge_a, s.edge_b);
        const Chains chains = chain_segments(segments);
        ASSERT_EQ(chains.size(), loops + paths) << "seed " << seed;
        ASSERT_EQ(std::size_t(std::count(chains.closed.begin(), chains.closed.end(), 1)), loops) << "seed " << seed;
        EXPECT_TRUE(std::is_sorted(chains.closed.begin(), chains.closed.end()));
        std::vector<int> used(segments.size(), 0);
        for (std::size_t c = 0; c < chains.size(); ++c)
            for (std::size_t k = 0; k < chains[c].size(); ++k) {
                ++used[chains[c][k].segment];
                const bool last = k + 1 == chains[c].size();
                if (!last || chains.closed[c]) {
                    ASSERT_EQ(id_at_end(segments, chains[c][k]), id_at_start(segments, chains[c][last ? 0 : k + 1])) << "seed " << seed;
                }
            }
        EXPECT_EQ(std::count(used.begin(), used.end(), 1), std::ptrdiff_t(segments.size())) << "seed " << seed;
    }
}

} // namespace
} // namespace limn
