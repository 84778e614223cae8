#include "draw_report.h"

#include "peak_memory.h"

using namespace limn;

namespace {

nlohmann::ordered_json json_of(const DrawnView& view)
{
    nlohmann::ordered_json types = nlohmann::ordered_json::object();
    for (int t = 0; t < line_type_count; ++t)
        if (const DrawReport::PerType& type = view.report.types[std::size_t(t)]; type.segments + type.strokes > 0)
            types[std::string(line_type_name(LineType(t)))] = {{"segments", type.segments},
                                                               {"strokes", type.strokes},
                                                               {"visible_pixels", type.visible_pixels},
                                                               {"hidden_pixels", type.hidden_pixels}};
    nlohmann::ordered_json json = {
        {"camera", nlohmann::ordered_json::parse(camera_to_json(view.camera))},
        {"types", types},
        {"camera_inside", view.report.camera_inside},
        {"camera_on_surface", view.eye == EyePlace::on_surface},
        {"seconds",
         {{"extract", view.report.extract_seconds}, {"visibility", view.report.visibility_seconds}, {"chain", view.report.chain_seconds}}}};
    if (view.clusters)
        json["clusters"] = {{"survivors", view.clusters->survivors}, {"bounded", view.clusters->bounded}};
    return json;
}

nlohmann::ordered_json json_of(const Input& input)
{
    nlohmann::ordered_json json = {{"file", input.file},
                                   {"vertices", input.vertices},
                                   {"triangles", input.triangles},
                                   {"low", {input.bounds.low.x, input.bounds.low.y, input.bounds.low.z}},
                                   {"high", {input.bounds.high.x, input.bounds.high.y, input.bounds.high.z}}};
    if (!input.name.empty())
        json["name"] = input.name;
    if (input.transform != dmat4(1))
        for (int i = 0; i < 16; ++i)
            json["matrix"].push_back(input.transform[i % 4][i / 4]);
    if (input.estimate)
        json["curvature"] = {{"rings", input.estimate->radius},
                             {"position_noise", input.estimate->position_noise},
                             {"predicted_error", input.estimate->predicted_error},
                             {"reliable", input.estimate->reliable}};
    return json;
}

double sum(const std::vector<DrawnView>& views, double DrawReport::*member)
{
    double total = 0;
    for (const DrawnView& view : views)
        total += view.report.*member;
    return total;
}

} // namespace

std::string draw_report(const std::string& command, const std::string& device, const Models& models, const std::vector<DrawnView>& views,
                        const std::vector<std::string>& written, const Warnings& warnings, const Times& times, const nlohmann::ordered_json& more)
{
    nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", command}, {"device", device}};
    for (const Input& input : models.inputs)
        json["inputs"].push_back(json_of(input));
    json["warnings"] = warnings.all();
    for (const DrawnView& view : views)
        json["views"].push_back(json_of(view));
    json.update(more);
    json["outputs"] = written;
    json["seconds"] = {{"read", models.read_seconds},
                       {"surface", models.surface_seconds},
                       {"merge", models.merge_seconds},
                       {"rays", times.rays},
                       {"features", times.features},
                       {"extract", sum(views, &DrawReport::extract_seconds)},
                       {"visibility", sum(views, &DrawReport::visibility_seconds)},
                       {"chain", sum(views, &DrawReport::chain_seconds)},
                       {"shade", times.shade},
                       {"write", times.write},
                       {"total", times.total}};
    json["peak_memory"] = peak_memory();
    return json.dump(2) + "\n";
}
