#include "limn/scene/passes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/drawing/raster.h"
#include "limn/formulas/formulas.h"
#include "limn/lines/face_point.h"

namespace limn {
namespace {

struct PassFacts {
    Pass pass;
    std::string_view name, unit;
    Need need;
    int channels;
};

constexpr std::array<PassFacts, 10> all_passes = {{
    {Pass::ndotv, "ndotv", "", Need::normals, 1},
    {Pass::kr, "kr", "1/length", Need::curvature, 1},
    {Pass::dwkr, "dwkr", "1/length^2", Need::derivative, 1},
    {Pass::k1, "k1", "1/length", Need::curvature, 1},
    {Pass::k2, "k2", "1/length", Need::curvature, 1},
    {Pass::depth, "depth", "length", Need::normals, 1},
    {Pass::normal, "normal", "", Need::normals, 3},
    {Pass::position, "position", "length", Need::normals, 3},
    {Pass::id, "id", "", Need::normals, 1},
    {Pass::lines, "lines", "", Need::normals, 1},
}};

const PassFacts& facts(Pass pass) { return all_passes[std::size_t(pass)]; }

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

/// A quantity at a vertex, in world units.
float at_vertex(const LineModel& m, const View& view, Pass pass, std::uint32_t i)
{
    const float scale = float(m.scale);
    if (pass == Pass::k1)
        return m.k1[i] / scale;
    if (pass == Pass::k2)
        return m.k2[i] / scale;
    const formulas::RadialTerms terms = formulas::radial_terms(view.to_eye(m.positions[i]), m.normals[i], m.e1[i], m.e2[i], m.k1[i], m.k2[i]);
    if (pass == Pass::kr)
        return formulas::radial_curvature(terms, m.k1[i], m.k2[i]) / scale;
    return formulas::radial_curvature_derivative(terms, m.k1[i], m.k2[i], m.derivative[i]) / (scale * scale);
}

/// The value of one pixel that shows the model.
vec3 value_at(const LineModel& model, const View& view, const GBuffer& seen, std::size_t i, Pass pass)
{
    const vec3& p = seen.positions[i];
    switch (pass) {
    case Pass::ndotv: return vec3(glm::dot(seen.normals[i], glm::normalize(view.to_eye(p))));
    case Pass::depth: return vec3(seen.depths[i]);
    case Pass::normal: return seen.normals[i];
    case Pass::position: return vec3(model.to_world(p));
    case Pass::id: return vec3(float(model.object_of_face(seen.triangles[i]) + 1));
    default: break;
    }
    const uvec3& t = model.faces[seen.triangles[i]];
    const vec3 weights = weights_in_face(model, seen.triangles[i], p);
    return vec3(weights.x * at_vertex(model, view, pass, t.x) + weights.y * at_vertex(model, view, pass, t.y) + weights.z * at_vertex(model, view, pass, t.z));
}

void find_range(PassImage& pass)
{
    if (pass.pass == Pass::ndotv || pass.pass == Pass::normal) {
        pass.low = -1;
        pass.high = 1;
        return;
    }
    bool any = false;
    for (const float value : pass.values.samples)
        if (std::isfinite(value)) {
            pass.low = any ? std::min(pass.low, double(value)) : double(value);
            pass.high = any ? std::max(pass.high, double(value)) : double(value);
            any = true;
        }
}

void check(const LineModel& model, Pass pass)
{
    const Need need = facts(pass).need;
    if ((need >= Need::curvature && !model.has_curvature()) || (need >= Need::derivative && !model.has_derivative()))
        throw Error::Input(fmt::format("pass '{}': the surface has no {}", facts(pass).name, need == Need::derivative ? "derivative of curvature" : "curvature"));
}

} // namespace

std::string_view pass_name(Pass pass) { return facts(pass).name; }
std::string_view pass_unit(Pass pass) { return facts(pass).unit; }

std::vector<Pass> passes_from_text(std::string_view text)
{
    std::vector<Pass> passes;
    std::string known;
    for (const PassFacts& f : all_passes)
        known += fmt::format("{}, ", f.name);
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(','));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
        bool found = false;
        for (const PassFacts& f : all_passes)
            if (word == "all" || word == f.name) {
                found = true;
                if (std::find(passes.begin(), passes.end(), f.pass) == passes.end())
                    passes.push_back(f.pass);
            }
        if (!found)
            throw Error::Input(fmt::format("--pass: '{}' is none of {}all", word, known));
    }
    return passes;
}

Need pass_need(std::span<const Pass> passes)
{
    Need need = Need::normals;
    for (const Pass pass : passes)
        need = std::max(need, facts(pass).need);
    return need;
}

PassImage lines_pass(const Drawing& drawing, const Style& style)
{
    Drawing strokes = drawing;
    strokes.regions.clear();
    strokes.captions.clear();
    return {Pass::lines, ink_cover(strokes, style), 0, 1};
}

PassImage make_pass(const LineModel& model, const GBuffer& seen, const Camera& camera, Pass pass)
{
    check(model, pass);
    const View view = model.view(camera);
    PassImage result = {pass, Image(seen.size, facts(pass).channels, pass == Pass::id ? 0.0f : nothing)};
    parallel_each(std::size_t(seen.size.y), 4, [&](std::size_t y) {
        for (int x = 0; x < seen.size.x; ++x) {
            const std::size_t i = seen.index(x, int(y));
            if (seen.triangles[i] == none)
                continue;
            const vec3 value = value_at(model, view, seen, i, pass);
            for (int c = 0; c < result.values.channels; ++c)
                result.values.at(x, int(y))[c] = value[c];
        }
    });
    find_range(result);
    return result;
}

Image pass_for_whole_numbers(const PassImage& pass)
{
    constexpr double top = 65535;
    if (pass.pass == Pass::id && pass.high > top)
        throw Error::Input(fmt::format("pass 'id': {:g} models do not fit into 16 bits; write EXR", pass.high));
    Image image = pass.values;
    const double span = pass.high - pass.low;
    for (float& value : image.samples)
        if (pass.pass == Pass::id)
            value = float(value / top);
        else
            value = std::isfinite(value) ? float((1 + (span > 0 ? (value - pass.low) / span : 0) * (top - 1)) / top) : 0.0f;
    return image;
}

} // namespace limn
