#include "limn/subdivision/contour_crossings.h"

#include <algorithm>

#include "limn/subdivision/bezier_roots.h"
#include "limn/subdivision/contour_polynomial.h"

namespace limn {
namespace {

/// Crossings are kept this far away from the ends of their edge.
constexpr double least = 1e-7;
/// Levels below the refined face at which the pieces of an edge end towards an extraordinary vertex.
constexpr int deepest = 8;

class EdgeWalk {
public:
    EdgeWalk(const LimitShape& shape, const Eye& eye, bool faces_eye, std::vector<double>& crossings) : shape_(shape), eye_(eye), faces_eye_(faces_eye), crossings_(crossings) {}

    void refined_side(std::uint32_t face, int side, double begin, double end)
    {
        face_ = face;
        anchor_ = shape_.anchor(face);
        const PatchTable& table = shape_.table();
        patches_ = &table.patch_class(table.class_of(face));
        walk(patches_->nodes[0], side, begin, end, 0);
    }
    void finish(bool faces_eye)
    {
        if (faces_eye != faces_eye_)
            crossings_.push_back(0.5 * (last_ + 1));
    }

private:
    void walk(const PatchClass::Node& node, int side, double begin, double end, int depth)
    {
        if (node.kind == PatchClass::Kind::patch) {
            piece(node, side, begin, end);
        } else if (node.kind == PatchClass::Kind::inner && depth < deepest) {
            const double middle = 0.5 * (begin + end);
            walk(patches_->nodes[node.first_child + std::size_t(side)], 0, begin, middle, depth + 1);
            walk(patches_->nodes[node.first_child + std::size_t((side + 1) % 3)], 2, middle, end, depth + 1);
        }
    }
    void piece(const PatchClass::Node& node, int side, double begin, double end)
    {
        const std::array<double, 11> along = contour_along_side(anchor_, shape_.patch(face_, node), side, eye_);
        if ((along[0] >= 0) != faces_eye_) // in what was left out before, or by rounding
            crossings_.push_back(0.5 * (last_ + begin));
        roots_.clear();
        append_sign_changes(along, roots_);
        for (const double root : roots_)
            crossings_.push_back(begin + root * (end - begin));
        faces_eye_ = along[10] >= 0;
        last_ = end;
    }

    const LimitShape& shape_;
    const Eye& eye_;
    bool faces_eye_;     ///< where the walk has got to
    double last_ = 0;
    std::vector<double>& crossings_;
    std::vector<double> roots_;
    std::uint32_t face_ = 0;
    dvec3 anchor_ = dvec3(0);
    const PatchClass* patches_ = nullptr;
};

} // namespace

void append_crossings(const LimitShape& shape, const Eye& eye, std::uint32_t h, const std::array<bool, 2>& faces_eye, std::vector<double>& crossings)
{
    const std::size_t before = crossings.size();
    const std::uint32_t face = h / 3, k = h % 3;
    EdgeWalk walk(shape, eye, faces_eye[0], crossings);
    walk.refined_side(4 * face + k, 0, 0, 0.5);
    walk.refined_side(4 * face + (k + 1) % 3, 2, 0.5, 1);
    walk.finish(faces_eye[1]);
    for (std::size_t i = before; i < crossings.size(); ++i)
        crossings[i] = std::clamp(crossings[i], least, 1 - least);
}

} // namespace limn
