#include "limn/subdivision/contour_crossings.h"

#include <algorithm>

#include "limn/subdivision/bezier_roots.h"
#include "limn/subdivision/contour_polynomial.h"

namespace limn {
namespace {

/// Crossings are kept this far away from the ends of their edge.
constexpr double least = 1e-7;
/// Levels below the refined face at which the pieces of an edge end towards an extraordinary vertex: always, and where a crossing is nearer.
constexpr int first_levels = 4, most_levels = 8;

/// A part of an edge: the side of a polynomial, or of a triangle that is still many.
struct EdgePart {
    const FacePatches* face;
    const PatchClass::Node* node;
    int side;
    double begin, end;
    std::array<double, 11> along; ///< of a polynomial
    bool is_patch() const { return node->kind == PatchClass::Kind::patch; }
};

class EdgeSearch {
public:
    EdgeSearch(const Eye& eye, std::vector<double>& crossings) : eye_(eye), crossings_(crossings) {}

    /// Appends the parts of a triangle's side, in order.
    void collect(const FacePatches& face, const PatchClass::Node& node, int side, double begin, double end, int levels, std::vector<EdgePart>& parts) const
    {
        if (node.kind == PatchClass::Kind::patch) {
            parts.push_back({&face, &node, side, begin, end, contour_along_side(face.anchor(), face.patch(node), side, eye_)});
        } else if (node.kind == PatchClass::Kind::corner || levels == 0) {
            parts.push_back({&face, &node, side, begin, end, {}});
        } else {
            const double middle = 0.5 * (begin + end);
            const PatchClass::Node* children = &face.patches().nodes[node.first_child];
            collect(face, children[side], 0, begin, middle, levels - 1, parts);
            collect(face, children[(side + 1) % 3], 2, middle, end, levels - 1, parts);
        }
    }
    /// @param before, after  whether the surface faces the eye at the ends
    void search(const std::vector<EdgePart>& parts, bool before, bool after, int levels)
    {
        bool now = before;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const EdgePart& part = parts[i];
            if (part.is_patch()) {
                if ((part.along[0] >= 0) != now) // by rounding
                    crossings_.push_back(part.begin);
                roots_.clear();
                append_sign_changes(part.along, roots_);
                for (const double root : roots_)
                    crossings_.push_back(part.begin + root * (part.end - part.begin));
                now = part.along[10] >= 0;
                continue;
            }
            const bool last = i + 1 == parts.size(), known = last || parts[i + 1].is_patch();
            const bool next = last ? after : parts[i + 1].along[0] >= 0;
            if (known && now == next)
                continue;
            if (part.node->kind == PatchClass::Kind::corner || levels == most_levels) {
                if (known)
                    crossings_.push_back(0.5 * (part.begin + part.end));
            } else {
                std::vector<EdgePart> finer;
                collect(*part.face, *part.node, part.side, part.begin, part.end, 1, finer);
                search(finer, now, known ? next : now, levels + 1);
            }
            now = known ? next : now;
        }
        if (now != after)
            crossings_.push_back(parts.back().end);
    }

private:
    const Eye& eye_;
    std::vector<double>& crossings_;
    std::vector<double> roots_;
};

} // namespace

void append_crossings(const LimitShape& shape, const Eye& eye, std::uint32_t h, const std::array<bool, 2>& faces_eye, std::vector<double>& crossings)
{
    const std::size_t before = crossings.size();
    const std::uint32_t face = h / 3, k = h % 3;
    const FacePatches first = shape.patches(4 * face + k), second = shape.patches(4 * face + (k + 1) % 3);
    EdgeSearch search(eye, crossings);
    std::vector<EdgePart> parts;
    search.collect(first, first.patches().nodes[0], 0, 0, 0.5, first_levels, parts);
    search.collect(second, second.patches().nodes[0], 2, 0.5, 1, first_levels, parts);
    search.search(parts, faces_eye[0], faces_eye[1], first_levels);
    for (std::size_t i = before; i < crossings.size(); ++i)
        crossings[i] = std::clamp(crossings[i], least, 1 - least);
    std::sort(crossings.begin() + std::ptrdiff_t(before), crossings.end());
}

} // namespace limn
