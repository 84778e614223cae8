#include <iterator>

#include <fmt/format.h>

#include "limn/base/parallel.h"
#include "limn/geometry/weld.h"
#include "limn/geometry/writers.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1 << 13;

using Text = fmt::memory_buffer;

/// Lets `f(out, i)` write the text of each i in [0, n), in parallel, and joins the texts in order.
template <class F> void append_each(std::string& text, std::size_t n, F&& f)
{
    std::vector<std::string> parts((n + grain - 1) / grain);
    parallel_blocks(n, grain, [&](std::size_t begin, std::size_t end) {
        Text out;
        for (std::size_t i = begin; i < end; ++i)
            f(out, i);
        parts[begin / grain].assign(out.data(), out.size());
    });
    std::size_t size = text.size();
    for (const std::string& part : parts)
        size += part.size();
    text.reserve(size);
    for (std::string& part : parts) {
        text += part;
        std::string().swap(part);
    }
}

/// Values without repetition, and the number of each corner's value among them, from 1.
template <class T> struct Distinct {
    std::vector<T> values;
    std::vector<std::uint32_t> number; ///< empty: there are none

    explicit Distinct(const std::vector<T>& corners)
    {
        std::vector<dvec3> points;
        points.reserve(corners.size());
        for (const T& c : corners)
            points.push_back(to_point(c));
        number = find_same_positions(points);
        for (std::size_t c = 0; c < corners.size(); ++c) {
            if (number[c] != c) {
                number[c] = number[number[c]];
                continue;
            }
            values.push_back(corners[c]);
            number[c] = std::uint32_t(values.size());
        }
    }
    static dvec3 to_point(const vec3& v) { return v; }
    static dvec3 to_point(const vec2& v) { return {v, 0}; }
};

std::string name_in_one_line(std::string name)
{
    for (char& c : name)
        if (c == '\n' || c == '\r')
            c = ' ';
    return name;
}

class ObjWriter {
public:
    ObjWriter(const Mesh& mesh, const WriteMeshOptions& options)
        : mesh_(mesh), doubles_(options.double_positions), normals_(options.normals ? mesh.corner_normals : std::vector<vec3>()), uvs_(mesh.corner_uvs)
    {
    }

    std::string bytes() const
    {
        std::string text = "# written by Limn\n";
        append_each(text, mesh_.positions.size(), [&](Text& out, std::size_t v) { put_position(out, v); });
        append_each(text, uvs_.values.size(), [&](Text& out, std::size_t i) {
            fmt::format_to(std::back_inserter(out), "vt {} {}\n", uvs_.values[i].x, uvs_.values[i].y);
        });
        append_each(text, normals_.values.size(), [&](Text& out, std::size_t i) {
            fmt::format_to(std::back_inserter(out), "vn {} {} {}\n", normals_.values[i].x, normals_.values[i].y, normals_.values[i].z);
        });
        if (mesh_.polygons.empty())
            append_each(text, mesh_.triangles.size(), [&](Text& out, std::size_t i) { put_triangle(out, i); });
        else
            put_polygons(text);
        append_each(text, mesh_.creases.size(), [&](Text& out, std::size_t i) {
            const CreaseEdge& crease = mesh_.creases[i];
            fmt::format_to(std::back_inserter(out), "t crease 2/1/0 {} {} {}\n", crease.a, crease.b, crease.sharpness);
        });
        return text;
    }

private:
    void put_position(Text& out, std::size_t v) const
    {
        const dvec3& p = mesh_.positions[v];
        if (doubles_)
            fmt::format_to(std::back_inserter(out), "v {} {} {}", p.x, p.y, p.z);
        else
            fmt::format_to(std::back_inserter(out), "v {} {} {}", float(p.x), float(p.y), float(p.z));
        if (!mesh_.colours.empty()) {
            const vec4& c = mesh_.colours[v];
            fmt::format_to(std::back_inserter(out), " {} {} {} {}", c.x, c.y, c.z, c.w);
        }
        out.push_back('\n');
    }

    /// "g" where triangle i begins a run of another group.
    void put_group(Text& out, std::size_t i) const
    {
        const std::vector<std::uint32_t>& groups = mesh_.face_groups;
        if (groups.empty() || (i > 0 && groups[i] == groups[i - 1]))
            return;
        const std::string name = groups[i] < mesh_.group_names.size() ? mesh_.group_names[groups[i]] : fmt::format("group {}", groups[i]);
        fmt::format_to(std::back_inserter(out), "g {}\n", name_in_one_line(name));
    }

    void put_corner(Text& out, std::uint32_t vertex, std::size_t corner) const
    {
        fmt::format_to(std::back_inserter(out), " {}", vertex + 1);
        if (!uvs_.number.empty())
            fmt::format_to(std::back_inserter(out), "/{}", uvs_.number[corner]);
        if (!normals_.number.empty())
            fmt::format_to(std::back_inserter(out), "{}/{}", uvs_.number.empty() ? "/" : "", normals_.number[corner]);
    }

    void put_triangle(Text& out, std::size_t i) const
    {
        put_group(out, i);
        out.push_back('f');
        for (std::size_t k = 0; k < 3; ++k)
            put_corner(out, mesh_.triangles[i][int(k)], 3 * i + k);
        out.push_back('\n');
    }

    /// Polygon by polygon, each with the attributes of the triangles it was cut into.
    void put_polygons(std::string& text) const
    {
        const Polygons& polygons = mesh_.polygons;
        Text out;
        std::size_t triangle = 0;
        for (std::size_t f = 0; f + 1 < polygons.offsets.size(); ++f) {
            const std::size_t size = polygons.offsets[f + 1] - polygons.offsets[f];
            put_group(out, triangle);
            out.push_back('f');
            for (std::size_t k = 0; k < size; ++k) {
                const std::uint32_t vertex = polygons.vertices[polygons.offsets[f] + k];
                put_corner(out, vertex, corner_of(vertex, triangle, size - 2));
            }
            out.push_back('\n');
            triangle += size - 2;
        }
        text.append(out.data(), out.size());
    }

    /// A corner at `vertex` of the `count` triangles from `first` on.
    std::size_t corner_of(std::uint32_t vertex, std::size_t first, std::size_t count) const
    {
        for (std::size_t c = 3 * first; c < 3 * (first + count); ++c)
            if (mesh_.triangles[c / 3][int(c % 3)] == vertex)
                return c;
        return 3 * first;
    }

    const Mesh& mesh_;
    bool doubles_;
    Distinct<vec3> normals_;
    Distinct<vec2> uvs_;
};

} // namespace

std::string obj_bytes(const Mesh& mesh, const WriteMeshOptions& options) { return ObjWriter(mesh, options).bytes(); }

} // namespace limn
