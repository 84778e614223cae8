#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/lines/suggestive.h"
#include "limn/lines/suggestive_face.h"
#include "lines/analytic.h"

namespace limn {
namespace {

using namespace test;

/// One of 100 views, half of them orthographic.
View view_of(const LineModel& model, int i)
{
    std::mt19937 random(unsigned(100 + i));
    const dvec3 d = random_direction(random);
    return i % 2 == 0 ? perspective_view(model, model.centre + (2.0 + i / 50.0) * model.scale * d) : orthographic_view(d);
}

bool same(const Segment& a, const Segment& b)
{
    return a.a == b.a && a.b == b.b && a.ink_a == b.ink_a && a.ink_b == b.ink_b && a.face == b.face && a.edge_a == b.edge_a && a.edge_b == b.edge_b;
}

/// The segments on faces that are turned to the eye.
std::vector<Segment> visible(const LineModel& model, const View& view, const std::vector<Segment>& all)
{
    std::vector<Segment> front;
    for (const Segment& s : all) {
        const uvec3& t = model.faces[s.face];
        if (faces_eye(model.positions[t.x], model.positions[t.y], model.positions[t.z], view))
            front.push_back(s);
    }
    return front;
}

std::vector<SuggestiveShortcuts> variants()
{
    const SuggestiveShortcuts none_of_them = {false, false, false, false, false};
    std::vector<SuggestiveShortcuts> list = {none_of_them};
    for (bool SuggestiveShortcuts::*one : {&SuggestiveShortcuts::skip_convex, &SuggestiveShortcuts::front_only, &SuggestiveShortcuts::sign_first,
                                           &SuggestiveShortcuts::stored_normals, &SuggestiveShortcuts::strength_test}) {
        list.push_back(none_of_them);
        list.back().*one = true; // it alone
        list.push_back({});
        list.back().*one = false; // all but it
    }
    return list;
}

void expect_exact(std::string_view shape, std::size_t triangles, int views)
{
    const LineModel model = shape_model(shape, triangles, 0.2);
    const SuggestiveFaces faces = find_suggestive_faces(model);
    for (int i = 0; i < views; ++i) {
        const View view = view_of(model, i);
        const auto codes = view_codes(model, view);
        SuggestiveOptions options;
        options.limit = i % 3 == 0 ? 0 : 0.01f;
        const auto reference = extract_suggestive(model, view, codes, options, &faces);
        for (const SuggestiveShortcuts& shortcuts : variants()) {
            options.shortcuts = shortcuts;
            const auto found = visible(model, view, extract_suggestive(model, view, codes, options, &faces));
            ASSERT_EQ(found.size(), reference.size()) << shape << ", view " << i;
            for (std::size_t k = 0; k < found.size(); ++k)
                ASSERT_TRUE(same(found[k], reference[k])) << shape << ", view " << i << ", segment " << k;
        }
        options.shortcuts = {};
        const auto without_faces = extract_suggestive(model, view, options);
        ASSERT_TRUE(std::equal(reference.begin(), reference.end(), without_faces.begin(), without_faces.end(), same)) << shape << ", view " << i;
    }
}

// Checklist 16: with each shortcut alone, all but each, none and all, the visible segments are the same bits.
TEST(Shortcuts, ChangeNoVisibleSegment)
{
    for (const char* shape : {"torus", "blob", "bumpy-torus", "rings", "bent-sheet"})
        expect_exact(shape, 5000, 100);
}

TEST(Shortcuts, ChangeNoVisibleSegmentOnLargeMeshesSlow)
{
    for (const char* shape : {"torus", "blob", "bumpy-torus", "knot", "sine-sheet"})
        expect_exact(shape, 100000, 100);
}

// Checklist 16: every face is accounted for; the statistics of tables 4.3 and 4.4.
TEST(Shortcuts, AccountForEveryFace)
{
    std::string table;
    for (const char* shape : {"torus", "blob", "bumpy-torus", "rings", "knot"}) {
        const LineModel model = shape_model(shape, 20000);
        const SuggestiveFaces faces = find_suggestive_faces(model);
        SuggestiveCounts sign, cull, both_sides;
        for (int i = 0; i < 20; ++i) {
            const View view = view_of(model, i);
            const auto codes = view_codes(model, view);
            SuggestiveOptions options;
            extract_suggestive(model, view, codes, options, &faces, &sign);
            options.shortcuts.sign_first = false;
            extract_suggestive(model, view, codes, options, &faces, &cull);
            options.shortcuts.front_only = false;
            extract_suggestive(model, view, codes, options, &faces, &both_sides);
        }
        for (const SuggestiveCounts& c : {sign, cull, both_sides}) {
            EXPECT_EQ(c.faces, 20 * model.faces.size());
            EXPECT_EQ(c.tested, 20 * faces.candidates.size());
            EXPECT_EQ(c.one_sign + c.turned_away + c.too_weak + c.trimmed + c.drawn, c.tested);
        }
        EXPECT_EQ(sign.drawn, cull.drawn);
        EXPECT_GT(sign.one_sign, cull.one_sign);
        EXPECT_LT(sign.turned_away, cull.turned_away);
        EXPECT_GE(both_sides.drawn, sign.drawn);
        const auto percent = [](std::size_t part, std::size_t whole) { return 100.0 * double(part) / double(whole); };
        table += fmt::format("{}: kept {:.0f} %, with lines {:.1f} %, visible {:.1f} %, by sign {:.0f} %, by facing {:.0f} %\n", shape,
                             percent(sign.tested, sign.faces), percent(both_sides.drawn, sign.faces), percent(sign.drawn, sign.faces),
                             percent(sign.one_sign, sign.tested), percent(cull.turned_away, cull.tested));
    }
    RecordProperty("tables 4.3 and 4.4", table);
}

// Checklist 17: both orders of the tests, timed.
TEST(Shortcuts, BothOrdersOfTheTestsFindTheSame)
{
    const LineModel model = shape_model("blob", 100000);
    const SuggestiveFaces faces = find_suggestive_faces(model);
    double seconds[2] = {};
    for (int i = 0; i < 20; ++i) {
        const View view = view_of(model, i);
        const auto codes = view_codes(model, view);
        std::vector<Segment> found[2];
        for (const bool sign_first : {true, false}) {
            SuggestiveOptions options;
            options.shortcuts.sign_first = sign_first;
            const auto start = std::chrono::steady_clock::now();
            found[sign_first] = extract_suggestive(model, view, codes, options, &faces);
            seconds[sign_first] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        }
        ASSERT_TRUE(std::equal(found[0].begin(), found[0].end(), found[1].begin(), found[1].end(), same));
    }
    RecordProperty("ms per view", fmt::format("sign first {:.2f}, facing first {:.2f}", 50 * seconds[1], 50 * seconds[0]));
}

TEST(Shortcuts, KeepCoarseFacesThatJoinConvexAndConcaveVertices)
{
    LineModel model = shape_model("sphere", 500);
    model.k1[model.faces[7].x] = model.k2[model.faces[7].x] = -1; // K > 0 at every vertex, H of both signs
    const std::vector<std::uint32_t> candidates = find_suggestive_faces(model).candidates;
    EXPECT_TRUE(std::find(candidates.begin(), candidates.end(), 7u) != candidates.end());
    EXPECT_LT(candidates.size(), 12u);
}

} // namespace
} // namespace limn
