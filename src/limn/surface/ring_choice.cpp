#include "limn/surface/ring_choice.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <tbb/enumerable_thread_specific.h>

#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/geometry/bounds.h"

namespace limn {
namespace {

constexpr std::size_t sample_size = 2000;
constexpr int most_rings = 5;
constexpr int widest = 6; ///< for the size of the derivative: fewer rings inflate it
constexpr double wanted_error = 0.025, noisy_error = 0.1;
constexpr double most_turn = 0.7, coarse_turn = 1;
constexpr double detail_growth = 2.5;

/// Vertices with a normal, drawn with a fixed seed, ascending.
std::vector<std::uint32_t> sample_vertices(const JetContext& context)
{
    const std::size_t vertices = context.positions.size();
    std::vector<std::uint32_t> sample;
    if (vertices <= sample_size) {
        sample.resize(vertices);
        for (std::size_t v = 0; v < vertices; ++v)
            sample[v] = std::uint32_t(v);
    } else {
        Random random(1);
        for (std::size_t i = 0; i < sample_size; ++i)
            sample.push_back(random.below(std::uint32_t(vertices)));
        std::sort(sample.begin(), sample.end());
    }
    std::erase_if(sample, [&](std::uint32_t v) { return context.normals[v] == dvec3(0); });
    return sample;
}

double median(std::vector<double> values)
{
    if (values.empty())
        return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Medians over the sample for one number of rings; all 0 where no fit succeeded.
struct Trial {
    double noise = 0, reach = 0, points = 0, derivative = 0;
    double turn = 0; ///< |k1| times the reach: angle that the normal turns, radians
};

using Collectors = tbb::enumerable_thread_specific<RingCollector>;

Trial run_trial(const JetContext& context, const std::vector<std::uint32_t>& sample, int rings, Collectors& collectors)
{
    struct Fit {
        double noise, reach, points, derivative, turn;
    };
    const std::vector<Fit> fits = parallel_collect<Fit>(sample.size(), 256, [&](std::size_t begin, std::size_t end, std::vector<Fit>& out) {
        RingCollector& collector = collectors.local();
        Neighbourhoods hoods;
        hoods.clear();
        for (std::size_t i = begin; i < end; ++i) {
            collector.collect(sample[i], {.rings = rings}, hoods.neighbour);
            hoods.close(sample[i]);
        }
        std::vector<Jet> jets(hoods.size());
        fit_jets({context.positions, context.normals, &hoods, true}, {4, false}, jets);
        for (std::size_t i = 0; i < jets.size(); ++i)
            if (jets[i].ok)
                out.push_back({jets[i].residual, jets[i].reach, double(hoods.start[i + 1] - hoods.start[i]), glm::length(jets[i].derivative),
                               std::abs(jets[i].k1) * jets[i].reach});
    });
    const auto median_of = [&](double Fit::*member) {
        std::vector<double> values;
        for (const Fit& fit : fits)
            values.push_back(fit.*member);
        return median(std::move(values));
    };
    return {median_of(&Fit::noise), median_of(&Fit::reach), median_of(&Fit::points), median_of(&Fit::derivative), median_of(&Fit::turn)};
}

/// Runs the trials that a choice asks for, each once.
class Trials {
public:
    explicit Trials(const JetContext& context)
        : context_(context), sample_(sample_vertices(context)),
          collectors_([&context] { return RingCollector(context.positions, context.normals, context.neighbours); })
    {
        Bounds box;
        for (const std::uint32_t v : sample_)
            box.add(context.positions[v]);
        const double radius = box.radius();
        size_ = std::max(at(widest).derivative, radius > 0 ? 1 / (radius * radius) : 0);
    }

    const Trial& at(int rings)
    {
        if (!done_.contains(rings))
            done_[rings] = run_trial(context_, sample_, rings, collectors_);
        return done_[rings];
    }

    /// Predicted relative rms error of the derivative.
    double error(int rings)
    {
        const Trial& trial = at(rings);
        const double reach3 = trial.reach * trial.reach * trial.reach;
        return reach3 > 0 && size_ > 0 ? 400 * trial.noise / (reach3 * std::sqrt(trial.points)) / size_ : 0;
    }

private:
    const JetContext& context_;
    std::vector<std::uint32_t> sample_;
    Collectors collectors_;
    std::map<int, Trial> done_;
    double size_ = 0;
};

/// More than 2 rings see too much of a strongly curved surface for a height over the tangent plane.
bool allowed(Trials& trials, int rings) { return rings == 2 || trials.at(rings).turn <= most_turn; }

/// The fewest allowed rings with the wanted error, or those with the smallest error.
int best_rings(Trials& trials)
{
    int best = 2;
    for (int rings = 3; rings <= most_rings && trials.error(best) > wanted_error; ++rings)
        if (allowed(trials, rings) && trials.error(rings) < trials.error(best))
            best = rings;
    return best;
}

int most_allowed_rings(Trials& trials)
{
    int rings = most_rings;
    while (!allowed(trials, rings))
        --rings;
    return rings;
}

RingChoice clean_choice(Trials& trials, int rings)
{
    RingChoice choice;
    choice.setting = {{4, rings == 2}, rings};
    choice.position_noise = trials.at(rings).noise;
    choice.predicted_error = trials.error(rings);
    choice.reliable = choice.predicted_error <= noisy_error && trials.at(2).turn <= coarse_turn;
    return choice;
}

/// True where the heights stray from the fit because the surface has more detail than it, not because of noise: with one
/// more ring the deviation grows by (3/2)^5 then, and stays the same with noise. Wider support would only blur the detail.
bool lacks_resolution(Trials& trials)
{
    return trials.at(3).noise > detail_growth * trials.at(2).noise && trials.at(2).turn <= coarse_turn;
}

RingChoice noisy_choice(Trials& trials)
{
    RingChoice choice = clean_choice(trials, most_allowed_rings(trials));
    choice.setting.model = {3, false};
    choice.max_normals = true;
    choice.derivative_passes = choice.predicted_error <= 0.25 ? 4 : choice.predicted_error <= 1 ? 8 : 16;
    choice.predicted_error /= 1 + 0.5 * choice.derivative_passes;
    choice.reliable = choice.predicted_error <= noisy_error && trials.at(2).turn <= coarse_turn;
    return choice;
}

} // namespace

RingChoice predict_rings(const JetContext& context, int rings)
{
    Trials trials(context);
    return clean_choice(trials, rings);
}

RingChoice choose_rings(const JetContext& context)
{
    Trials trials(context);
    if (trials.error(2) > wanted_error && lacks_resolution(trials)) {
        RingChoice choice = clean_choice(trials, 2);
        choice.reliable = true;
        return choice;
    }
    const int best = best_rings(trials);
    return trials.error(best) <= noisy_error ? clean_choice(trials, best) : noisy_choice(trials);
}

} // namespace limn
