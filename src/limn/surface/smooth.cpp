#include "limn/surface/smooth.h"

#include "limn/base/parallel.h"
#include "limn/surface/tangent.h"

namespace limn {
namespace {

constexpr std::size_t grain = 2048;

TangentFrame frame_of(const Surface& surface, std::size_t v)
{
    return {dvec3(surface.e1[v]), dvec3(surface.e2[v]), dvec3(surface.normals[v])};
}

void set_directions(Surface& surface, std::size_t v, const TangentFrame& basis, const PlaneRotation& r)
{
    surface.e1[v] = vec3(r.c * basis.u + r.s * basis.v);
    surface.e2[v] = vec3(r.c * basis.v - r.s * basis.u);
}

class Smoother {
public:
    Smoother(Surface& surface, const Neighbours& neighbours, std::span<const double> areas)
        : surface_(surface), neighbours_(neighbours), weights_(areas.begin(), areas.end())
    {
        for (std::size_t v = 0; v < surface.unreliable.size(); ++v)
            if (surface.unreliable[v])
                weights_[v] = 0;
    }

    void normals(int passes)
    {
        std::vector<dvec3> n(surface_.normals.begin(), surface_.normals.end());
        diffuse(n, passes, [](std::uint32_t, std::uint32_t, const dvec3& value) { return value; });
        for (dvec3& normal : n)
            normal = unit_or_zero(normal);
        replace_normals(surface_, n);
    }

    void curvature(int passes)
    {
        std::vector<SecondForm> forms(surface_.k1.size());
        for (std::size_t v = 0; v < forms.size(); ++v)
            forms[v] = {surface_.k1[v], 0, surface_.k2[v]};
        diffuse(forms, passes, [&](std::uint32_t from, std::uint32_t to, const SecondForm& f) {
            return rotate(f, transport(frame(from), frame(to)));
        });
        parallel_each(forms.size(), grain, [&](std::size_t v) {
            if (has_frame(v))
                set_curvature(v, principal_frame(forms[v]));
        });
    }

    void derivative(int passes)
    {
        std::vector<dvec4> tensors(surface_.derivative.begin(), surface_.derivative.end());
        diffuse(tensors, passes, [&](std::uint32_t from, std::uint32_t to, const dvec4& d) {
            return rotate(d, transport(frame(from), frame(to)));
        });
        parallel_each(tensors.size(), grain, [&](std::size_t v) {
            if (has_frame(v))
                surface_.derivative[v] = vec4(tensors[v]);
        });
    }

private:
    static void accumulate(dvec3& sum, double w, const dvec3& x) { sum += w * x; }
    static void accumulate(dvec4& sum, double w, const dvec4& x) { sum += w * x; }
    static void accumulate(SecondForm& sum, double w, const SecondForm& x) { sum.add(w, x); }

    template <class T, class Carry> void diffuse(std::vector<T>& values, int passes, Carry&& carry) const
    {
        std::vector<T> next(values.size());
        for (int pass = 0; pass < passes; ++pass) {
            parallel_each(values.size(), grain, [&](std::size_t v) { next[v] = mean(values, std::uint32_t(v), carry); });
            values.swap(next);
        }
    }

    template <class T, class Carry> T mean(const std::vector<T>& values, std::uint32_t v, Carry&& carry) const
    {
        double total = weights_[v];
        for (const std::uint32_t u : neighbours_.of(v))
            total += weights_[u];
        if (!(total > 0))
            return values[v];
        T sum = {};
        accumulate(sum, weights_[v] / total, values[v]);
        for (const std::uint32_t u : neighbours_.of(v))
            if (weights_[u] > 0)
                accumulate(sum, weights_[u] / total, carry(u, v, values[u]));
        return sum;
    }

    bool has_frame(std::size_t v) const { return surface_.e1[v] != vec3(0); }
    TangentFrame frame(std::size_t v) const { return frame_of(surface_, v); }

    void set_curvature(std::size_t v, const PrincipalFrame& principal)
    {
        set_directions(surface_, v, frame(v), principal.rotation);
        surface_.k1[v] = float(principal.k1);
        surface_.k2[v] = float(principal.k2);
        if (!surface_.derivative.empty())
            surface_.derivative[v] = vec4(rotate(dvec4(surface_.derivative[v]), principal.rotation));
    }

    Surface& surface_;
    const Neighbours& neighbours_;
    std::vector<double> weights_;
};

} // namespace

void replace_normals(Surface& surface, std::span<const dvec3> normals)
{
    parallel_each(normals.size(), grain, [&](std::size_t v) {
        if (normals[v] == dvec3(0))
            return;
        const TangentFrame basis = any_frame(normals[v]);
        if (surface.has_curvature())
            set_directions(surface, v, basis, transport(frame_of(surface, v), basis).inverse());
        surface.normals[v] = vec3(normals[v]);
    });
}

void smooth_surface(Surface& surface, const Neighbours& neighbours, std::span<const double> areas, const SmoothPasses& passes)
{
    Smoother smoother(surface, neighbours, areas);
    if (passes.normals > 0)
        smoother.normals(passes.normals);
    if (passes.curvature > 0 && surface.has_curvature())
        smoother.curvature(passes.curvature);
    if (passes.derivative > 0 && surface.has_derivative())
        smoother.derivative(passes.derivative);
}

} // namespace limn
