// Extraction on the device (contour-lines specification 2.2, 2.6, 2.11): the lines of the processor, in its order.

#include "limn/gpu/line_extraction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/base/random.h"
#include "limn/lines/contour.h"
#include "limn/lines/prepare.h"
#include "limn/lines/suggestive_face.h"
#include "limn/surface/shapes.h"

namespace limn::test {
namespace {

constexpr float near_zero = 1e-6f; // of a quantity's range
constexpr float end_tolerance = 1e-4f; // of an edge

Shape shape_of(const std::string& name, std::size_t triangles) { return make_shape({.name = name, .triangles = triangles, .float_positions = false}); }

LineModel model_of(const Shape& shape)
{
    const PlacedSurface placed = {&shape.mesh, &shape.exact};
    return build_line_model({&placed, 1});
}

/// A block with the outline of an L: 12 corners, one of them inwards.
Mesh l_block()
{
    const dvec2 outline[6] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    Mesh mesh;
    for (const double z : {0.0, 1.0})
        for (const dvec2& p : outline)
            mesh.positions.emplace_back(p, z);
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        mesh.triangles.insert(mesh.triangles.end(), {{i, j, j + 6}, {i, j + 6, i + 6}});
    }
    for (const uvec3& t : {uvec3(0, 1, 3), uvec3(1, 2, 3), uvec3(0, 3, 5), uvec3(3, 4, 5)})
        mesh.triangles.insert(mesh.triangles.end(), {t + 6u, uvec3(t.x, t.z, t.y)});
    return mesh;
}

/// What is asked of both sides.
struct Asked {
    SuggestiveOptions suggestive, highlights;
    explicit Asked(float limit = 0.01f, float fade = 2, float speed_limit = 0)
    {
        suggestive.limit = limit;
        suggestive.fade = fade;
        suggestive.speed_limit = speed_limit;
        highlights = suggestive;
        highlights.highlight = true;
    }
    ClusterRequest request(bool curvature = true) const
    {
        return {.suggestive = curvature ? &suggestive : nullptr, .highlights = curvature ? &highlights : nullptr};
    }
};

ClusterLines on_processor(const LineModel& model, const View& view, const ClusterRequest& request)
{
    ClusterLines lines;
    lines.contours = extract_contours(model, facing_of_vertices(model, view));
    if (request.suggestive)
        lines.suggestive = extract_suggestive(model, view, *request.suggestive);
    if (request.highlights)
        lines.highlights = extract_suggestive(model, view, *request.highlights);
    return lines;
}

/// The faces where a quantity that decides is so near zero that rounding may decide.
class Doubtful {
public:
    Doubtful(const LineModel& model, const View& view, const SuggestiveOptions* options) : model_(model)
    {
        const std::size_t n = model.vertex_count();
        const auto add = [&](auto&& value) {
            std::vector<float> values(n);
            for (std::uint32_t i = 0; i < n; ++i)
                values[i] = value(i);
            mark(values);
        };
        vertices_.resize(n);
        faces_.resize(model.faces.size());
        if (!options) {
            add([&](std::uint32_t i) { return facing_at(model, view, i); });
            return;
        }
        add([&](std::uint32_t i) { return suggestive_corner(model, view, i, *options).kr; });
        add([&](std::uint32_t i) { return suggestive_corner(model, view, i, *options).strength; });
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            const uvec3& t = model.faces[f];
            const vec3 a = model.positions[t.y] - model.positions[t.x], b = model.positions[t.z] - model.positions[t.x], v = view.to_eye(model.positions[t.x]);
            faces_[f] = std::abs(glm::dot(glm::cross(a, b), v)) < near_zero * glm::length(a) * glm::length(b) * glm::length(v);
        }
    }
    bool operator()(std::uint32_t face) const
    {
        const uvec3& t = model_.faces[face];
        return faces_[face] || vertices_[t.x] || vertices_[t.y] || vertices_[t.z];
    }

private:
    void mark(const std::vector<float>& values)
    {
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        const float small = near_zero * (*most - *least);
        for (std::size_t i = 0; i < values.size(); ++i)
            vertices_[i] = vertices_[i] || std::abs(values[i]) < small;
    }
    const LineModel& model_;
    std::vector<bool> vertices_, faces_;
};

using Key = std::tuple<bool, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
Key key_of(const Segment& s) { return {s.along_edge, s.face, s.edge_a, s.edge_b, s.other}; }

std::map<Key, const Segment*> by_key(const std::vector<Segment>& segments)
{
    std::map<Key, const Segment*> all;
    for (const Segment& s : segments)
        all[key_of(s)] = &s;
    return all;
}

/// The length of the edge that an end lies on; the face's longest for an end inside of it.
float edge_length(const LineModel& model, const Segment& s, std::uint32_t edge)
{
    const auto length = [&](std::uint32_t h) {
        const auto at = [&](std::uint32_t half_edge) { return model.positions[model.faces[half_edge / 3][int(half_edge % 3)]]; };
        return glm::distance(at(h), at(next_half_edge(h)));
    };
    if (edge < 3 * model.faces.size())
        return length(edge);
    return std::max({length(3 * s.face), length(3 * s.face + 1), length(3 * s.face + 2)});
}

struct Agreement {
    std::size_t segments = 0, other = 0; ///< of the processor; on one side only
    float worst_end = 0, worst_ink = 0;  ///< ends in edges
};

/// Checks one kind of line.
void compare(const LineModel& model, const std::vector<Segment>& processor, const std::vector<Segment>& device, const Doubtful& doubtful, const std::string& what,
             Agreement& sum)
{
    const auto expected = by_key(processor), found = by_key(device);
    ASSERT_EQ(found.size(), device.size()) << what << ": a segment came twice";
    std::vector<Key> order, device_order;
    for (const Segment& s : processor) {
        const auto other = found.find(key_of(s));
        if (other == found.end()) {
            ++sum.other;
            EXPECT_TRUE(doubtful(s.face)) << what << ": face " << s.face << " lacks its line";
            continue;
        }
        order.push_back(key_of(s));
        const Segment& d = *other->second;
        if (doubtful(s.face))
            continue; // its zeros may be anywhere
        sum.worst_end = std::max({sum.worst_end, glm::distance(s.a, d.a) / edge_length(model, s, s.edge_a), glm::distance(s.b, d.b) / edge_length(model, s, s.edge_b)});
        sum.worst_ink = std::max({sum.worst_ink, std::abs(s.ink_a - d.ink_a), std::abs(s.ink_b - d.ink_b)});
    }
    for (const Segment& s : device) {
        if (expected.count(key_of(s)) != 0) {
            device_order.push_back(key_of(s));
        } else {
            ++sum.other;
            EXPECT_TRUE(doubtful(s.face)) << what << ": face " << s.face << " has a line too many";
        }
    }
    EXPECT_EQ(order, device_order) << what << ": the order";
    sum.segments += processor.size();
}

void compare(const LineModel& model, const View& view, const ClusterLines& device, const ClusterRequest& request, const std::string& what, Agreement& sum)
{
    const ClusterLines processor = on_processor(model, view, request);
    compare(model, processor.contours, device.contours, Doubtful(model, view, nullptr), what + " contours", sum);
    if (request.suggestive)
        compare(model, processor.suggestive, device.suggestive, Doubtful(model, view, request.suggestive), what + " suggestive", sum);
    if (request.highlights)
        compare(model, processor.highlights, device.highlights, Doubtful(model, view, request.highlights), what + " highlights", sum);
}

void expect_good(const Agreement& sum, const char* what)
{
    fmt::print("[ lines    ] {}: {} segments, {} on one side only, ends within {:.1e} of an edge, ink {:.1e}\n", what, sum.segments, sum.other, sum.worst_end,
               sum.worst_ink);
    EXPECT_LE(sum.worst_end, end_tolerance) << what;
    EXPECT_LE(sum.worst_ink, 1e-3f) << what;
    EXPECT_GT(sum.segments, 0u) << what;
}

std::vector<View> views_of(const LineModel& model, const Mesh& mesh)
{
    std::vector<View> views;
    for (const bool orthographic : {false, true})
        for (const char* view : {"front", "iso", "35,25", "200,-40"})
            views.push_back(model.view(Camera::framing(mesh.bounds(), {.view = view, .up_axis = 'z', .size = {400, 300}, .orthographic = orthographic})));
    views.push_back({false, vec3(0.1f, 0.2f, 0.05f)}); // amid the model
    return views;
}

class GpuLines : public Gpu {};

TEST_F(GpuLines, AreThoseOfTheProcessor)
{
    for (const char* name : {"torus", "blob", "knot", "bumpy-torus", "rings"}) {
        const Shape shape = shape_of(name, 20000);
        const LineModel model = model_of(shape);
        gpu::LineExtractor lines(model);
        Agreement sum;
        for (const Asked& asked : {Asked(), Asked(0, 0), Asked(0.005f, 3, 2)})
            for (const View& view : views_of(model, shape.mesh)) {
                lines.extract(view, asked.request());
                compare(model, view, lines.read(), asked.request(), name, sum);
            }
        expect_good(sum, name);
    }
}

TEST_F(GpuLines, FollowCreases)
{
    for (const auto& [name, mesh] : {std::pair<const char*, Mesh>("L-block", l_block()), {"cube", shape_of("cube", 3000).mesh}, {"cylinder", shape_of("cylinder", 3000).mesh}}) {
        const PreparedMesh prepared = prepare_mesh(mesh);
        const PlacedSurface placed = prepared.placed();
        const LineModel model = build_line_model({&placed, 1});
        ASSERT_FALSE(model.split_edges.empty());
        gpu::LineExtractor lines(model);
        Agreement sum;
        std::size_t along_creases = 0;
        for (const View& view : views_of(model, prepared.mesh)) {
            const ClusterRequest contours;
            lines.extract(view, contours);
            const ClusterLines found = lines.read();
            compare(model, view, found, contours, name, sum);
            along_creases += std::size_t(std::count_if(found.contours.begin(), found.contours.end(), [](const Segment& s) { return s.along_edge; }));
        }
        EXPECT_GT(along_creases, 0u) << name;
        expect_good(sum, name);
    }
}

TEST_F(GpuLines, KnowAllObjectsOfAModel)
{
    const Shape torus = shape_of("torus", 3000), blob = shape_of("blob", 3000);
    dmat4 aside(1);
    aside[3] = {3, 0.5, 0, 1};
    const PlacedSurface placed[] = {{&torus.mesh, &torus.exact}, {&blob.mesh, &blob.exact, aside}, {&torus.mesh, &torus.exact, aside * aside}};
    const LineModel model = build_line_model(placed);
    gpu::LineExtractor lines(model);
    const Asked asked;
    Agreement sum;
    for (const View& view : views_of(model, torus.mesh)) {
        lines.extract(view, asked.request());
        const ClusterLines found = lines.read();
        compare(model, view, found, asked.request(), "three objects", sum);
        EXPECT_EQ(model.object_of_face(found.contours.back().face), 2u);
    }
    expect_good(sum, "three objects");
}

/// Faces between random vertices with random normals: half of them hold a contour.
LineModel random_faces(std::size_t count)
{
    LineModel model;
    Random random(7, count);
    const auto vector = [&] { return vec3(dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))); };
    const std::uint32_t vertices = std::uint32_t(count / 2 + 3);
    for (std::uint32_t i = 0; i < vertices; ++i) {
        model.positions.push_back(vector());
        model.normals.push_back(vector());
    }
    model.positions.push_back(vec3(0));
    model.first_vertex = {0, vertices};
    model.first_face = {0, std::uint32_t(count)};
    for (std::size_t f = 0; f < count; ++f) {
        const std::uint32_t i = random.below(vertices);
        model.faces.emplace_back(i, (i + 1) % vertices, (i + 2) % vertices);
    }
    model.adjacency.twin.assign(3 * count, none);
    return model;
}

void expect_the_same_faces(std::size_t count)
{
    const LineModel model = random_faces(count);
    const View view = {false, vec3(0.3f, 2.5f, -1)};
    gpu::LineExtractor lines(model);
    lines.extract(view, {});
    const std::vector<Segment> device = lines.read().contours, processor = extract_contours(model, facing_of_vertices(model, view));
    ASSERT_EQ(device.size(), processor.size()) << count << " faces";
    std::size_t differ = 0;
    for (std::size_t i = 0; i < device.size(); ++i)
        differ += key_of(device[i]) != key_of(processor[i]);
    EXPECT_EQ(differ, 0u) << count << " faces";
}

TEST_F(GpuLines, AreCountedRightAtTheBordersOfBlocks)
{
    for (const std::size_t count : {1, 2, 31, 32, 33, 255, 256, 257, 1023, 1024, 1025, 65535, 65536, 65537, 66048})
        expect_the_same_faces(count);
}

TEST_F(GpuLines, AreCountedRightBeyondAMillionFaces) // 4,097 blocks: three levels of sums
{
    expect_the_same_faces(1024 * 1024 + 1);
}

TEST_F(GpuLines, AreTheSameBytesTwice)
{
    const Shape shape = shape_of("blob", 20000);
    const LineModel model = model_of(shape);
    const Asked asked;
    const View view = views_of(model, shape.mesh)[2];
    const auto bytes = [&](gpu::LineExtractor& lines) {
        lines.extract(view, asked.request());
        const ClusterLines found = lines.read();
        const std::size_t count = found.contours.size() + found.suggestive.size() + found.highlights.size();
        EXPECT_GT(count, 1000u);
        std::vector<unsigned> all = lines.segments().read<unsigned>(12 * count);
        const std::vector<unsigned> commands = lines.commands().read<unsigned>(12);
        all.insert(all.end(), commands.begin(), commands.end());
        return all;
    };
    gpu::LineExtractor first(model), second(model);
    const std::vector<unsigned> once = bytes(first);
    EXPECT_EQ(once, bytes(first));
    EXPECT_EQ(once, bytes(second));
}

TEST_F(GpuLines, CommandsDrawWhatWasFound)
{
    const Shape shape = shape_of("bumpy-torus", 5000);
    const LineModel model = model_of(shape);
    gpu::LineExtractor lines(model);
    const Asked asked;
    lines.extract(views_of(model, shape.mesh)[1], asked.request());
    const ClusterLines found = lines.read();
    const unsigned c = unsigned(found.contours.size()), s = unsigned(found.suggestive.size()), h = unsigned(found.highlights.size());
    EXPECT_EQ(lines.commands().read<unsigned>(12), (std::vector<unsigned>{6 * c, 1, 0, 0, 6 * s, 1, 6 * c, 0, 6 * h, 1, 6 * (c + s), 0}));
}

// The room is that of the first view; what does not fit is missing, never written elsewhere, and comes with complete().
TEST_F(GpuLines, GetMoreRoomWhereTheyNeedIt)
{
    const Shape shape = shape_of("blob", 20000);
    const LineModel model = model_of(shape);
    gpu::LineExtractor lines(model);
    const View view = views_of(model, shape.mesh)[1];
    const Asked asked;
    const ClusterRequest nothing = {.contours = false}, few = {.contours = false, .suggestive = &asked.suggestive};
    lines.extract(view, nothing);
    EXPECT_EQ(lines.capacity(), 0u);
    lines.extract(view, asked.request());
    EXPECT_EQ(lines.commands().read<unsigned>(1)[0], 0u);
    lines.extract(view, few);
    lines.complete();
    const std::size_t room = lines.capacity();
    lines.extract(view, asked.request());
    const std::vector<unsigned> commands = lines.commands().read<unsigned>(12);
    EXPECT_EQ(commands[0] + commands[4] + commands[8], 6 * room) << "as many as there is room for";
    Agreement sum;
    compare(model, view, lines.read(), asked.request(), "blob", sum);
    expect_good(sum, "after making room");
    const std::size_t enough = lines.capacity();
    EXPECT_GE(enough, 2 * sum.segments - 2 * sum.other);
    lines.extract(view, asked.request());
    lines.complete();
    EXPECT_EQ(lines.capacity(), enough) << "a second view of the same needs no more";
}

TEST_F(GpuLines, MayBeNone)
{
    const Shape plane = shape_of("plane", 500);
    const LineModel flat = model_of(plane);
    gpu::LineExtractor lines(flat);
    const Asked asked;
    lines.extract({true, vec3(0, 0, 1)}, asked.request());
    const ClusterLines found = lines.read();
    EXPECT_TRUE(found.contours.empty() && found.suggestive.empty() && found.highlights.empty());
    EXPECT_EQ(lines.commands().read<unsigned>(12), (std::vector<unsigned>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}));

    LineModel empty;
    empty.positions.resize(2);
    empty.normals.resize(1);
    empty.first_vertex = {0, 1};
    empty.first_face = {0, 0};
    gpu::LineExtractor none_at_all(empty);
    none_at_all.extract({true, vec3(0, 0, 1)}, {});
    EXPECT_TRUE(none_at_all.read().contours.empty());
}

TEST_F(GpuLines, AreContoursAloneWithoutCurvature)
{
    const Shape shape = shape_of("torus", 5000);
    LineModel model = model_of(shape);
    for (auto* vectors : {&model.e1, &model.e2})
        vectors->clear();
    model.k1.clear();
    model.k2.clear();
    model.derivative.clear();
    gpu::LineExtractor lines(model);
    const View view = views_of(model, shape.mesh)[2];
    lines.extract(view, {});
    Agreement sum;
    compare(model, view, lines.read(), {}, "torus", sum);
    expect_good(sum, "without curvature");
    const Asked asked;
    EXPECT_THROW(lines.extract(view, asked.request()), Error::Input);
    model.normals.clear();
    EXPECT_THROW(gpu::LineExtractor{model}, Error::Input);
}

TEST_F(GpuLines, RefuseAModelThatTheDeviceCannotSee)
{
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (most > 512 << 20)
        GTEST_SKIP() << "this device sees buffers of " << most << " bytes";
    LineModel model = random_faces(1);
    const std::size_t count = std::size_t(most) / sizeof(uvec3) + 1;
    model.faces.assign(count, model.faces[0]);
    try {
        const gpu::LineExtractor lines(model);
        FAIL() << count << " faces were taken";
    } catch (const Error::Device& error) {
        EXPECT_NE(std::string(error.what()).find(fmt::format("{} faces", count)), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(std::to_string(most)), std::string::npos) << error.what();
    }
}

TEST_F(GpuLines, SumsAreRightForAnyCount)
{
    for (const std::size_t count : {0, 1, 2, 255, 256, 257, 65535, 65536, 65537, 1200000}) {
        const gpu::BlockScan scan(count);
        std::vector<uvec4> numbers(count);
        for (std::size_t i = 0; i < count; ++i)
            numbers[i] = uvec4(i % 7, i % 256 == 0, 1, i * i % 11);
        scan.sums().write(0, count * sizeof(uvec4), numbers.data());
        scan.run();
        const std::vector<uvec4> sums = scan.sums().read<uvec4>(scan.total() + 1);
        uvec4 before(0);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < count; ++i) {
            wrong += sums[i] + sums[scan.level1() + i / 256] + sums[scan.level2() + i / 65536] != before;
            before += numbers[i];
        }
        EXPECT_EQ(wrong, 0u) << count;
        EXPECT_EQ(sums[scan.total()], before) << count;
    }
    EXPECT_THROW(gpu::BlockScan((std::size_t(1) << 24) + 1), Error::Input);
}

} // namespace
} // namespace limn::test
