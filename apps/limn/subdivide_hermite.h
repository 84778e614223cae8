#pragma once

#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "limn/subdivision/subdivide.h"
#include "limn/terrain/hermite_smoothing.h"

/// How a mesh is made smooth: as the limit of subdivision, which leaves its vertices, or by the normals at its vertices, which stay.
struct SubdivideScheme {
    enum class Kind { loop, hermite } kind = Kind::loop;
    limn::HermiteOptions hermite;
    bool is_hermite() const { return kind == Kind::hermite; }
};

void add_scheme_options(CLI::App& app, SubdivideScheme& scheme);
/// @throws Error::Input for options of the other scheme
void check_scheme(const CLI::App& app, const SubdivideScheme& scheme);
/// How far edges may stay from their curves, in the mesh's unit.
/// @param asked  0: a thousandth of the box's diagonal
double hermite_error(const limn::Mesh& mesh, double asked);
/// `levels` are the passes.
limn::Subdivided subdivide_hermite(const limn::Mesh& mesh, const SubdivideScheme& scheme, double error);
nlohmann::ordered_json scheme_json(const SubdivideScheme& scheme);
