#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/raycast/depth_edges.h"
#include "limn/raycast/outline_error.h"
#include "limn/subdivision/seed_silhouette.h"
#include "subdivision/exact_views.h"

namespace limn::test {
namespace {

/// The eye of a camera as the seed's search takes it.
Eye eye_of(const Camera& camera) { return {camera.orthographic ? dvec4(-camera.forward(), 0) : dvec4(camera.eye, 1)}; }

/// The control mesh with its vertices on the limit surface: what is drawn where nothing is done for outlines.
Mesh coarse_mesh(const ExactSubject& subject)
{
    Mesh mesh;
    mesh.positions = subject.pose().corners.positions;
    mesh.triangles = subject.topology().triangles;
    return mesh;
}

/// Errors of one view.
struct ViewErrors {
    OutlineError coarse, seed, exact;
    double gaps = 0; ///< px^2 more than 1 px inside the outline that the front faces of the exact mesh do not cover
};

/// Everything that outlines of a model are measured with.
class OutlineSubject {
public:
    explicit OutlineSubject(const Mesh& mesh)
        : exact_(mesh), control_(make_control_mesh(mesh)), surface_(make_seed_surface(control_.topology)), pose_(make_seed_pose(surface_, control_.positions)),
          closed_(std::find(control_.topology.twin.begin(), control_.topology.twin.end(), none) == control_.topology.twin.end()),
          reference_(reference_mesh(exact_, any_view(exact_.bounds(), 0)))
    {
    }
    const ExactSubject& exact() const { return exact_; }
    const Mesh& reference() const { return reference_; }

    ViewErrors measure(const Camera& camera) const
    {
        const OutlineMask wanted = outline_mask(reference_, camera);
        const Mesh exact = exact_silhouette(exact_.pose(), camera).mesh;
        const OutlineMask found = outline_mask(exact, camera);
        ViewErrors errors;
        errors.exact = compare_outlines(found, wanted);
        errors.coarse = compare_outlines(outline_mask(coarse_mesh(exact_), camera), wanted);
        errors.seed = compare_outlines(outline_mask(seed_silhouette(surface_, pose_, eye_of(camera)).mesh, camera), wanted);
        if (closed_)
            errors.gaps = uncovered(outline_mask(exact, camera, 8, MaskFaces::front), eroded(wanted, 8));
        return errors;
    }

private:
    ExactSubject exact_;
    ControlMesh control_;
    SeedSurface surface_;
    SeedPose pose_;
    bool closed_;
    Mesh reference_;
};

/// Means, and maxima over all views.
struct ModelErrors {
    double coarse = 0, seed = 0, exact = 0; ///< px^2: areas
    double most_coarse = 0, most_seed = 0, most_exact = 0, mean_exact = 0, gaps = 0; ///< px; gaps: px^2
    std::size_t worst_view = 0, widest_gap = 0;
};

ModelErrors measure(const OutlineSubject& subject, int views)
{
    std::vector<ViewErrors> each(std::size_t(views), ViewErrors{});
    parallel_each(each.size(), 1, [&](std::size_t i) { each[i] = subject.measure(any_view(subject.exact().bounds(), int(i))); });
    ModelErrors all;
    for (std::size_t i = 0; i < each.size(); ++i) {
        const ViewErrors& e = each[i];
        if (e.exact.most() > all.most_exact)
            all.worst_view = i;
        if (e.gaps > all.gaps)
            all.widest_gap = i;
        all.coarse += e.coarse.difference / views, all.seed += e.seed.difference / views, all.exact += e.exact.difference / views;
        all.most_coarse = std::max(all.most_coarse, e.coarse.most());
        all.most_seed = std::max(all.most_seed, e.seed.most());
        all.most_exact = std::max(all.most_exact, e.exact.most());
        all.mean_exact = std::max(all.mean_exact, e.exact.mean());
        all.gaps = std::max(all.gaps, e.gaps);
    }
    return all;
}

/// Checklist 31 and 39, at 1024 x 1024 pixels against a mesh that is within 0.05 px of the limit surface.
void check_outlines(const std::vector<NamedMesh>& models, int views)
{
    for (const auto& [name, mesh] : models) {
        const ModelErrors e = measure(OutlineSubject(mesh), views);
        EXPECT_LE(e.most_exact, 0.6) << name << ", view " << e.worst_view;
        EXPECT_LE(e.mean_exact, 0.1) << name;
        EXPECT_EQ(e.gaps, 0) << name << ", view " << e.widest_gap;
        EXPECT_LE(3 * e.seed, e.coarse) << name;
        fmt::print("{}: symmetric difference {:.1f} px^2 coarse, {:.1f} seed, {:.1f} exact; maximum {:.2f} px coarse, {:.2f} seed, {:.3f} exact, whose mean is up to {:.3f}\n", name,
                   e.coarse, e.seed, e.exact, e.most_coarse, e.most_seed, e.most_exact, e.mean_exact);
    }
}

TEST(Outline, IsThatOfTheLimitSurface)
{
    check_outlines(outline_models(), 2);
}
TEST(Outline, IsThatOfTheLimitSurfaceInManyViewsSlow)
{
    check_outlines(outline_models(), 100);
}

/// The reference's own error is under 0.05 px, told by one of a quarter of it.
TEST(Outline, IsHeldAgainstANearReference)
{
    for (const auto& [name, mesh] : outline_models()) {
        const ExactSubject subject(mesh);
        const Camera camera = any_view(subject.bounds(), 0);
        const OutlineMask found = outline_mask(reference_mesh(subject, camera), camera, 16), finer = outline_mask(reference_mesh(subject, camera, 0.0075), camera, 16);
        const OutlineError error = compare_outlines(found, finer);
        EXPECT_LE(error.most(), 0.125) << name; // two samples
        EXPECT_LE(error.mean(), 0.02) << name;
    }
}

} // namespace
} // namespace limn::test
