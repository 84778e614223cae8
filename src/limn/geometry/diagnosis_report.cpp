#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "limn/geometry/counted.h"
#include "limn/geometry/diagnose.h"

namespace limn {
namespace {

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

std::string in_units_of_memory(std::size_t bytes)
{
    return bytes < 1000000 ? fmt::format("{:.1f} kB", double(bytes) / 1e3) : fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

std::string size_text(const Bounds& box)
{
    return fmt::format("{:.6g} x {:.6g} x {:.6g}", box.size().x, box.size().y, box.size().z);
}

std::string corner_text(const dvec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

nlohmann::ordered_json corner_json(const dvec3& p) { return {p.x, p.y, p.z}; }

template <class T> nlohmann::ordered_json or_null(const std::optional<T>& value)
{
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

} // namespace

std::vector<std::string> complaints(const Diagnosis& d)
{
    std::vector<std::string> found;
    const auto add = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0)
            found.push_back(counted(count, one, many));
    };
    add(d.border_edges, "border edge", "border edges");
    add(d.non_manifold_edges, "non-manifold edge", "non-manifold edges");
    add(d.non_manifold_vertices, "non-manifold vertex", "non-manifold vertices");
    add(d.misoriented_edges, "edge with inconsistent winding", "edges with inconsistent winding");
    add(d.degenerate_faces, "degenerate face", "degenerate faces");
    add(d.duplicate_faces, "duplicate face", "duplicate faces");
    add(d.not_finite_vertices, "NaN or infinite vertex", "NaN or infinite vertices");
    add(d.unreferenced_vertices, "unreferenced vertex", "unreferenced vertices");
    return found;
}

std::string diagnosis_text(const Diagnosis& d)
{
    std::string text;
    const auto row = [&](const char* name, const std::string& value) { text += fmt::format("{:<16}{}\n", name, value); };
    row("vertices", fmt::format("{}", d.vertices));
    row("triangles", fmt::format("{}", d.triangles));
    row("edges", fmt::format("{}", d.edges));
    row("shells", fmt::format("{}", d.shells));
    row("closed", yes_or_no(d.closed));
    row("manifold", yes_or_no(d.manifold));
    row("oriented", yes_or_no(d.oriented));
    row("Euler number", fmt::format("{}", d.euler) + (d.genus ? fmt::format(" (genus {})", *d.genus) : ""));
    row("area", fmt::format("{:.6g}", d.area));
    row("volume", d.volume ? fmt::format("{:.6g}{}", *d.volume, *d.volume < 0 ? " (inside out)" : "") : "none (not closed)");
    if (!d.bounds.empty()) {
        row("size", size_text(d.bounds));
        row("from, to", corner_text(d.bounds.low) + ", " + corner_text(d.bounds.high));
        row("edge length", fmt::format("{:.6g} to {:.6g}, median {:.6g}", d.shortest_edge, d.longest_edge, d.median_edge));
    }
    row("memory", in_units_of_memory(d.memory));
    std::string unclean;
    for (const std::string& complaint : complaints(d))
        unclean += (unclean.empty() ? "" : ", ") + complaint;
    row("unclean", unclean.empty() ? "nothing" : unclean);
    return text;
}

std::string diagnosis_json(const Diagnosis& d)
{
    const nlohmann::ordered_json object = {
        {"vertices", d.vertices},
        {"triangles", d.triangles},
        {"edges", d.edges},
        {"border_edges", d.border_edges},
        {"non_manifold_edges", d.non_manifold_edges},
        {"misoriented_edges", d.misoriented_edges},
        {"non_manifold_vertices", d.non_manifold_vertices},
        {"degenerate_faces", d.degenerate_faces},
        {"duplicate_faces", d.duplicate_faces},
        {"not_finite_vertices", d.not_finite_vertices},
        {"not_finite_faces", d.not_finite_faces},
        {"unreferenced_vertices", d.unreferenced_vertices},
        {"shells", d.shells},
        {"closed", d.closed},
        {"manifold", d.manifold},
        {"oriented", d.oriented},
        {"euler", d.euler},
        {"genus", or_null(d.genus)},
        {"area", d.area},
        {"volume", or_null(d.volume)},
        {"bounds", d.bounds.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json{{"low", corner_json(d.bounds.low)}, {"high", corner_json(d.bounds.high)}}},
        {"edge_length", {{"shortest", d.shortest_edge}, {"median", d.median_edge}, {"longest", d.longest_edge}}},
        {"memory", d.memory},
    };
    return object.dump(2) + "\n";
}

} // namespace limn
