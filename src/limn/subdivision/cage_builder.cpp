#include "limn/subdivision/cage_builder.h"

#include <algorithm>
#include <stdexcept>

namespace limn {

std::uint32_t CageBuilder::vertex(const dvec3& position)
{
    positions_.push_back(position);
    return std::uint32_t(positions_.size() - 1);
}

CageBuilder::Row CageBuilder::row(std::span<const dvec3> positions)
{
    Row numbers;
    for (const dvec3& p : positions)
        numbers.push_back(vertex(p));
    return numbers;
}

void CageBuilder::face(const Row& corners) { faces_.push_back(corners); }

void CageBuilder::band(const Row& a, const Row& b)
{
    for (std::size_t i = 0; i + 1 < a.size(); ++i)
        face({a[i], a[i + 1], b[i + 1], b[i]});
}

void CageBuilder::closed_band(const Row& a, const Row& b)
{
    band(a, b);
    face({a.back(), a.front(), b.front(), b.back()});
}

void CageBuilder::halving_band(const Row& a, const Row& half, bool inwards)
{
    const auto add = [&](std::uint32_t u, std::uint32_t v, std::uint32_t w) { face(inwards ? Row{u, v, w} : Row{u, w, v}); };
    for (std::size_t i = 0; i < half.size(); ++i) {
        const std::uint32_t here = half[i], next = half[(i + 1) % half.size()];
        const std::uint32_t a0 = a[2 * i], a1 = a[2 * i + 1], a2 = a[(2 * i + 2) % a.size()];
        add(a0, a1, here);
        add(a1, next, here);
        add(a1, a2, next);
    }
}

void CageBuilder::fan(const Row& ring, const dvec3& middle)
{
    const std::uint32_t centre = vertex(middle);
    for (std::size_t i = 0; i < ring.size(); ++i)
        face({ring[i], ring[(i + 1) % ring.size()], centre});
}

void CageBuilder::ladder(const Row& row)
{
    for (std::size_t i = 0, last = row.size() - 1; i + 1 < last - i; ++i)
        face({row[i], row[i + 1], row[last - i - 1], row[last - i]});
}

std::size_t CageBuilder::find_face(const Row& corners) const
{
    for (std::size_t f = 0; f < faces_.size(); ++f)
        if (std::is_permutation(faces_[f].begin(), faces_[f].end(), corners.begin(), corners.end()))
            return f;
    throw std::logic_error("CageBuilder: there is no face of these corners");
}

CageBuilder::Row CageBuilder::extrude(const Row& corners, const std::function<dvec3(const dvec3&)>& moved)
{
    const std::size_t f = find_face(corners);
    const Row border = faces_[f];
    Row end;
    for (const std::uint32_t v : border)
        end.push_back(vertex(moved(positions_[v])));
    faces_[f] = end;
    closed_band(border, end);
    return end;
}

void CageBuilder::remove_face(const Row& corners) { faces_.erase(faces_.begin() + std::ptrdiff_t(find_face(corners))); }

void CageBuilder::crease_row(const Row& row, float sharpness)
{
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
        crease(row[i], row[i + 1], sharpness);
}

void CageBuilder::crease_ring(const Row& ring, float sharpness)
{
    crease_row(ring, sharpness);
    crease(ring.back(), ring.front(), sharpness);
}

void CageBuilder::mirror()
{
    std::vector<std::uint32_t> image(positions_.size());
    for (std::uint32_t v = 0, count = std::uint32_t(image.size()); v < count; ++v) {
        const dvec3 p = positions_[v];
        image[v] = p.z == 0 ? v : vertex({p.x, p.y, -p.z});
    }
    for (std::size_t f = 0, count = faces_.size(); f < count; ++f) {
        Row mirrored;
        for (const std::uint32_t v : faces_[f])
            mirrored.push_back(image[v]);
        std::reverse(mirrored.begin(), mirrored.end());
        if (mirrored.size() == 4) // 3 2 1 0 becomes 2 1 0 3: cut along the image of the diagonal
            std::rotate(mirrored.begin(), mirrored.begin() + 1, mirrored.end());
        faces_.push_back(mirrored);
    }
    for (std::size_t e = 0, count = creases_.size(); e < count; ++e) {
        const CreaseEdge crease = creases_[e];
        if (image[crease.a] != crease.a || image[crease.b] != crease.b)
            creases_.push_back({image[crease.a], image[crease.b], crease.sharpness});
    }
}

Mesh CageBuilder::mesh() const
{
    Mesh mesh;
    mesh.positions = positions_;
    mesh.creases = creases_;
    for (const Row& f : faces_) {
        mesh.triangles.push_back(f.size() == 3 ? uvec3(f[0], f[1], f[2]) : uvec3(f[0], f[1], f[3]));
        if (f.size() == 4)
            mesh.triangles.push_back({f[1], f[2], f[3]});
    }
    return mesh;
}

} // namespace limn
