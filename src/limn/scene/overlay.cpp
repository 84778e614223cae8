#include "limn/scene/overlay.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/drawing/raster.h"

namespace limn {
namespace {

/// Lines in an object's frame, one after the other, and the type of stroke whose style they have.
struct OverlayLines {
    LineType type;
    std::vector<std::vector<dvec3>> lines;
};

// The types of strokes that stand for the layers; their order is that of drawing.
constexpr LineType of_control = LineType::highlight, of_edges = LineType::valley, of_normals = LineType::ridge, of_triangles = LineType::crease,
                   of_curves = LineType::contour, of_crossings = LineType::outline;

Style overlay_style()
{
    Style style;
    constexpr double thin = 0.25, bold = 0.6;
    style.curves = false;
    style.line(of_control) = {thin, vec3(1, 0.85f, 0), 1};
    style.line(of_edges) = {thin, vec3(0.1f, 0.35f, 1), 1};
    style.line(of_normals) = {thin, vec3(0, 0.7f, 0.2f), 1};
    style.line(of_triangles) = {thin, vec3(0.9f, 0.1f, 0.1f), 1};
    style.line(of_curves) = {bold, vec3(0, 0.75f, 0.85f), 1};
    style.line(of_crossings) = {2.5 * bold, vec3(1, 0, 1), 1};
    return style;
}

std::vector<OverlayLines> control_layers(const LoopModel& model)
{
    const LoopTopology& t = model.pose().shape.table().control();
    OverlayLines layer{of_control, {}};
    for (const std::uint32_t h : t.half_edge)
        layer.lines.push_back({model.pose().corners.positions[t.start(h)], model.pose().corners.positions[t.end(h)]});
    return {layer};
}

std::vector<OverlayLines> edge_layers(const LoopModel& model)
{
    constexpr int pieces = 16, normals = 4;
    constexpr double normal_length = 0.2; // of the edge
    const LoopTopology& t = model.pose().shape.table().control();
    OverlayLines edges{of_edges, {}}, along{of_normals, {}};
    for (const std::uint32_t h : t.half_edge) {
        const double length = glm::distance(model.pose().corners.positions[t.start(h)], model.pose().corners.positions[t.end(h)]);
        std::vector<dvec3>& line = edges.lines.emplace_back();
        for (int i = 0; i <= pieces; ++i) {
            const SurfaceSample sample = model.pose().shape.sample(on_half_edge(h, double(i) / pieces));
            line.push_back(sample.position);
            if (i % (pieces / normals) == 0)
                along.lines.push_back({sample.position, sample.position + normal_length * length * sample.normal});
        }
    }
    return {edges, along};
}

/// Contours, and their ends on the edges as short lines.
OverlayLines curve_layer(const CutMesh& mesh, bool ends)
{
    OverlayLines layer{ends ? of_crossings : of_curves, {}};
    for (const std::vector<std::uint32_t>& curve : mesh.silhouette.curves) {
        const auto place = [&](std::uint32_t v) { return mesh.silhouette.mesh.positions[v]; };
        if (!ends) {
            std::vector<dvec3>& line = layer.lines.emplace_back();
            for (const std::uint32_t v : curve)
                line.push_back(place(v));
            continue;
        }
        for (const std::uint32_t v : {curve.front(), curve.back()})
            layer.lines.push_back({place(v), place(v)});
    }
    return layer;
}

OverlayLines triangle_layer(const CutMesh& mesh)
{
    const SilhouetteMesh& cut = mesh.silhouette;
    OverlayLines layer{of_triangles, {}};
    for (std::size_t first = 0; first < cut.faces.size();) { // triangles of one control face follow each other
        std::size_t end = first;
        while (end < cut.faces.size() && cut.faces[end] == cut.faces[first])
            ++end;
        for (std::size_t i = first; i < end && end - first > 1; ++i)
            for (int k = 0; k < 3; ++k)
                layer.lines.push_back({cut.mesh.positions[cut.mesh.triangles[i][k]], cut.mesh.positions[cut.mesh.triangles[i][(k + 1) % 3]]});
        first = end;
    }
    return layer;
}

/// The visible parts of lines as strokes.
class Strokes {
public:
    Strokes(const LoopView& view, const Camera& camera) : tracer_(view.seen, camera), camera_(camera), slack_(0.02 * view.seen.scale) {}

    void add(const OverlayLines& layer, const dmat4& transform)
    {
        for (const std::vector<dvec3>& line : layer.lines)
            add(layer.type, line, transform);
    }
    std::vector<Stroke> strokes;

private:
    void add(LineType type, const std::vector<dvec3>& line, const dmat4& transform)
    {
        constexpr double step = 2, dot = 0.5; // pixels
        Stroke stroke;
        const auto finish = [&] {
            if (stroke.points.size() > 1)
                strokes.push_back(stroke);
            stroke = {};
        };
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const dvec3 a(transform * dvec4(line[i], 1)), b(transform * dvec4(line[i + 1], 1));
            const dvec2 from = camera_.project(a).pixel, to = camera_.project(b).pixel;
            const int pieces = std::clamp(int(glm::distance(from, to) / step), 1, 2000);
            for (int k = 0; k <= pieces; ++k) {
                const Projected p = camera_.project(glm::mix(a, b, double(k) / pieces));
                if (!is_seen(p)) {
                    finish();
                    continue;
                }
                stroke.type = type;
                stroke.points.push_back(a == b ? p.pixel + dvec2(k == 0 ? -dot : dot, 0) : p.pixel);
                stroke.ink.push_back(1);
                stroke.world.push_back(a);
                stroke.faces.push_back(none);
            }
        }
        finish();
    }
    bool is_seen(const Projected& p) const
    {
        if (p.depth <= 0 && !camera_.orthographic)
            return false;
        const Fragment there = tracer_.at(p.pixel);
        return !there.hit() || p.depth <= double(there.depth) + slack_;
    }

    FragmentTracer tracer_;
    const Camera& camera_;
    double slack_; ///< lines on the limit surface may lie below the triangles that show it
};

} // namespace

void check_overlay(const std::string& letters)
{
    for (const char letter : letters)
        if (letter < 'A' || letter > 'F')
            throw Error::Input(fmt::format("--overlay: '{}' is none of A, B, C, D, E, F", letter));
}

Image draw_overlay(const Image& picture, const LoopView& view, std::span<const PlacedLoop> placed, const Camera& camera, const std::string& letters)
{
    check_overlay(letters);
    Strokes strokes(view, camera);
    const auto shows = [&](char letter) { return letters.find(letter) != std::string::npos; };
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const LoopModel& model = *placed[i].model;
        std::vector<OverlayLines> layers;
        const auto append = [&](std::vector<OverlayLines> more) { layers.insert(layers.end(), more.begin(), more.end()); };
        if (shows('A'))
            append(control_layers(model));
        if (shows('B'))
            append(edge_layers(model));
        if (shows('E'))
            layers.push_back(triangle_layer(view.meshes[i]));
        if (shows('D'))
            layers.push_back(curve_layer(view.meshes[i], false));
        if (shows('C'))
            layers.push_back(curve_layer(view.meshes[i], true));
        for (const OverlayLines& layer : layers)
            strokes.add(layer, placed[i].transform);
    }
    std::stable_sort(strokes.strokes.begin(), strokes.strokes.end(), [](const Stroke& a, const Stroke& b) { return a.type < b.type; });
    Drawing drawing;
    drawing.camera = camera;
    drawing.strokes = std::move(strokes.strokes);
    return lay_over(picture, drawing, overlay_style());
}

} // namespace limn
