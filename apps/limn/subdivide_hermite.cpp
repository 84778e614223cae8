#include "subdivide_hermite.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "table_options.h"

using namespace limn;

namespace {

using Kind = SubdivideScheme::Kind;

const OptionTable<SubdivideScheme>& scheme_table()
{
    static const OptionTable<SubdivideScheme> table = {
        choice_row<SubdivideScheme, Kind>("scheme", {{"loop", Kind::loop}, {"hermite", Kind::hermite}},
                                          "Loop subdivision, or triangles bent by the normals at their vertices, which stay, until --max-error is reached", &SubdivideScheme::kind),
    };
    return table;
}

void refuse(const CLI::App& app, const std::vector<std::string>& names, const std::string& scheme)
{
    for (const std::string& name : names)
        if (app.count("--" + name) > 0)
            throw Error::Input(fmt::format("--{} goes with --scheme {} only", name, scheme));
}

} // namespace

void add_scheme_options(CLI::App& app, SubdivideScheme& scheme)
{
    add_table_options(app, scheme_table(), scheme, "Subdivision");
    add_table_options(app, hermite_option_table(), scheme.hermite, "Scheme hermite");
}

void check_scheme(const CLI::App& app, const SubdivideScheme& scheme)
{
    if (scheme.is_hermite()) {
        refuse(app, {"levels", "limit", "crease-rule", "crease-angle", "crease-tags", "normal-map"}, "loop");
        return;
    }
    std::vector<std::string> names;
    for (const auto& row : hermite_option_table())
        names.push_back(row.name);
    refuse(app, names, "hermite");
}

double hermite_error(const Mesh& mesh, double asked) { return asked > 0 ? asked : 2 * mesh.bounds().radius() / 1000; }

Subdivided subdivide_hermite(const Mesh& mesh, const SubdivideScheme& scheme, double error)
{
    if (!(error > 0)) // a mesh of no size
        return {mesh, 0, 0, 0, {}};
    SmoothedMesh made = smooth_mesh(mesh, {error}, scheme.hermite);
    Subdivided out;
    out.mesh = std::move(made.mesh);
    out.levels = int(made.triangles.size());
    if (!made.within_bound)
        out.notes.push_back(fmt::format("{} passes did not bring all edges within {:.3g} of their curves", scheme.hermite.passes, error));
    return out;
}

nlohmann::ordered_json scheme_json(const SubdivideScheme& scheme)
{
    nlohmann::ordered_json json;
    for (const auto& row : scheme_table())
        json[row.name] = row.get(scheme);
    if (scheme.is_hermite())
        for (const auto& row : hermite_option_table())
            json[row.name] = row.get(scheme.hermite);
    return json;
}
