#include "bench_agreement.h"

#include <algorithm>
#include <filesystem>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench_table.h"
#include "common.h"
#include "limn/base/error.h"
#include "limn/drawing/agreement.h"
#include "limn/geometry/read_mesh.h"
#include "limn/lines/draw.h"
#include "limn/lines/image_lines.h"
#include "limn/lines/prepare.h"
#include "limn/lines/regions.h"
#include "limn/lines/shader_lines.h"
#include "limn/surface/shapes.h"

using namespace limn;

namespace {

struct AgreementBench {
    std::vector<std::string> models = {"torus", "bumpy-torus", "rings", "knot", "blob"}; ///< closed shapes with suggestive contours
    std::size_t triangles = 100000; ///< of shapes
    int views = 8;
    int edge = 512;                 ///< of the pictures, px
};

constexpr double tolerance = 3; ///< px

AgreementBench bench_of(const BenchRequest& request)
{
    if (request.sizes.size() > 1 || request.edges.size() > 1)
        throw Error::Input("bench agreement: give one size with --sizes, and one with --edges");
    AgreementBench bench;
    if (!request.models.empty())
        bench.models = request.models;
    if (!request.sizes.empty())
        bench.triangles = request.sizes.front();
    if (request.views > 0)
        bench.views = request.views;
    if (!request.edges.empty())
        bench.edge = request.edges.front();
    return bench;
}

/// A method's agreement with the objects' space, mean over views.
struct MethodAgreement {
    std::string method;
    LineAgreement agreement;
};

struct ModelAgreement {
    std::string model; ///< the shape, or the file's name without its folder
    std::vector<MethodAgreement> methods;
};

Mesh mesh_of(const std::string& model, std::size_t triangles)
{
    const std::vector<std::string>& shapes = shape_names();
    if (std::find(shapes.begin(), shapes.end(), model) == shapes.end() && std::filesystem::exists(model))
        return read_mesh(model);
    ShapeOptions options;
    options.name = model;
    options.triangles = triangles;
    return make_shape(options).mesh;
}

/// A model with all that its views need.
struct Subject {
    PreparedMesh prepared;
    Bounds bounds;
    LineModel model;
    RayScene rays;

    explicit Subject(Mesh mesh) : prepared(prepare_mesh(std::move(mesh))), bounds(prepared.mesh.bounds()), model(model_of(prepared)), rays(build_ray_scene(model)) {}
    static LineModel model_of(const PreparedMesh& prepared)
    {
        const PlacedSurface placed = prepared.placed();
        return build_line_model({&placed, 1});
    }
};

/// What the methods look at in one view.
struct Seen {
    const Subject& subject;
    const Camera& camera;
    GBuffer buffer;
    LineFields fields;
};

struct Method {
    std::string name;
    std::function<Image(const Seen&)> find;
};

Method by_shader(const std::string& name, ShaderMethod method)
{
    return {name, [=](const Seen& seen) {
                ShaderLineOptions options = {.method = method};
                options.suggestive_limit = float(LineOptions().suggestive_limit);
                options.feature_size = model_feature_size(seen.subject.model, {});
                return find_shader_lines(seen.subject.model, seen.buffer, seen.camera, options);
            }};
}

Method by_filter(const std::string& name, ImageMethod method)
{
    return {name, [=](const Seen& seen) { return find_image_lines(seen.fields, {.method = method}); }};
}

std::vector<Method> all_methods()
{
    return {by_shader("M6 texture", ShaderMethod::texture),     by_shader("M7 width", ShaderMethod::width),
            by_filter("M8 threshold", ImageMethod::threshold),  by_filter("M9 depth-raw", ImageMethod::depth_raw),
            by_filter("M9 depth", ImageMethod::depth),          by_filter("M10 valley-printed", ImageMethod::valley_printed),
            by_filter("M10 valley", ImageMethod::valley)};
}

/// The lines that the methods are compared with.
Image lines_of_space(const Subject& subject, const Camera& camera)
{
    LineOptions options;
    options.lines = {LineType::contour, LineType::suggestive};
    options.fade = options.min_length = 0;
    return line_pixels(draw_lines(subject.model, subject.rays, camera, options));
}

LineAgreement mean(const std::vector<LineAgreement>& all)
{
    LineAgreement sum;
    for (const LineAgreement& one : all) {
        sum.precision += one.precision / double(all.size());
        sum.recall += one.recall / double(all.size());
        sum.chamfer += one.chamfer / double(all.size());
    }
    return sum;
}

std::vector<MethodAgreement> measure(const Subject& subject, const AgreementBench& bench, const std::function<void(double)>& progress)
{
    const std::vector<Method> methods = all_methods();
    std::vector<std::vector<LineAgreement>> found(methods.size());
    for (int i = 0; i < bench.views; ++i) {
        progress(double(i) / bench.views);
        Framing framing;
        framing.view = fmt::format("{},{}", (37 * i) % 360, (23 * i) % 120 - 60);
        framing.size = {bench.edge, bench.edge};
        const Camera camera = Camera::framing(subject.bounds, framing);
        const SeenScene scene = seen_scene(subject.model, subject.rays);
        Seen seen = {subject, camera, trace_gbuffer(scene, camera), {}};
        seen.fields = line_fields(seen.buffer, camera, scene, scene.scale);
        const Image wanted = lines_of_space(subject, camera);
        for (std::size_t m = 0; m < methods.size(); ++m)
            found[m].push_back(compare_lines(methods[m].find(seen), wanted, tolerance));
    }
    std::vector<MethodAgreement> result;
    for (std::size_t m = 0; m < methods.size(); ++m)
        result.push_back({methods[m].name, mean(found[m])});
    return result;
}

/// Mean over the models.
std::vector<MethodAgreement> summary(const std::vector<ModelAgreement>& measures)
{
    std::vector<MethodAgreement> result;
    for (std::size_t m = 0; m < measures[0].methods.size(); ++m) {
        std::vector<LineAgreement> all;
        for (const ModelAgreement& model : measures)
            all.push_back(model.methods[m].agreement);
        result.push_back({measures[0].methods[m].method, mean(all)});
    }
    return result;
}

std::string table_text(const std::vector<MethodAgreement>& methods)
{
    MarkdownTable table({"method", "precision", "recall", "F1", "chamfer px"});
    for (const MethodAgreement& m : methods)
        table.add({m.method, fmt::format("{:.3f}", m.agreement.precision), fmt::format("{:.3f}", m.agreement.recall), fmt::format("{:.3f}", m.agreement.f1()),
                   fmt::format("{:.2f}", m.agreement.chamfer)});
    return table.text();
}

nlohmann::ordered_json json_of(const std::vector<MethodAgreement>& methods)
{
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const MethodAgreement& m : methods)
        rows.push_back({{"method", m.method},
                        {"precision", m.agreement.precision},
                        {"recall", m.agreement.recall},
                        {"f1", m.agreement.f1()},
                        {"chamfer_px", m.agreement.chamfer}});
    return rows;
}

std::string agreement_text(const AgreementBench& bench, const std::vector<ModelAgreement>& measures)
{
    const ImageLineOptions filters;
    const ShaderLineOptions shader;
    std::string out = fmt::format(
        "## Lines per pixel against lines of the objects' space\n\n`limn bench agreement`, version {}. Shapes of `limn sample`, about {} triangles, surfaces "
        "estimated by jets; {} views all round at {} x {} pixels, one sample a pixel. Wanted: the pixels that visible contours and suggestive contours of `limn "
        "draw` (M1 and M3, limit {}, neither faded nor short ones left out) run through. Found: what each method inks by more than half, with the defaults of `limn "
        "render` for every model: widths of {} px, the same limit for M6 and M7, texture of {} texels; intensity below {} (M8), response above {} (M9 raw), step "
        "above {} and fold above {} degrees (M9), radius {} px (M10), {} darker and contrast {} (M10 valley). *Precision*: share of the found pixels with a wanted one "
        "within {} px. *Recall*: the other way round. *F1*: their harmonic mean. *Chamfer*: mean distance to the nearest of the other, averaged over both "
        "directions. Means over views, then over models; distances are exact. Lines are not thinned first: a broad one costs precision.\n\n",
        LIMN_VERSION, with_thousands(bench.triangles), bench.views, bench.edge, bench.edge, LineOptions().suggestive_limit, shader.contour_width, shader.texture_size,
        filters.dark, filters.sobel, filters.step, filters.fold_degrees, filters.radius, filters.darker, filters.contrast, tolerance);
    out += fmt::format("Mean of {}:\n\n{}\n", measures.size() == 1 ? "1 model" : fmt::format("{} models", measures.size()), table_text(summary(measures)));
    for (const ModelAgreement& m : measures)
        out += fmt::format("### Agreement on {}\n\n{}\n", m.model, table_text(m.methods));
    return out;
}

std::string agreement_json(const AgreementBench& bench, const std::vector<ModelAgreement>& measures)
{
    nlohmann::ordered_json json = {{"limn", LIMN_VERSION},         {"command", "bench"},
                                   {"what", "agreement"},          {"triangles", bench.triangles},
                                   {"views", bench.views},         {"size", bench.edge},
                                   {"tolerance_px", tolerance}, {"mean", json_of(summary(measures))}};
    for (const ModelAgreement& m : measures)
        json["models"].push_back({{"model", m.model}, {"methods", json_of(m.methods)}});
    return json.dump(2) + "\n";
}

} // namespace

BenchResult bench_agreement(const BenchRequest& request, Console& console)
{
    const AgreementBench bench = bench_of(request);
    std::vector<ModelAgreement> measures;
    for (const std::string& model : bench.models) {
        const double first = double(measures.size()), count = double(bench.models.size());
        console.progress(model, first / count);
        const Subject subject(mesh_of(model, bench.triangles));
        measures.push_back({std::filesystem::path(model).filename().string(),
                            measure(subject, bench, [&](double part) { console.progress(model, (first + part) / count); })});
    }
    return {agreement_text(bench, measures), agreement_json(bench, measures), counted(measures.size(), "model")};
}
