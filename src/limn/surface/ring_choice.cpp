#include "limn/surface/ring_choice.h"

#include <algorithm>
#include <map>
#include <random>

#include <tbb/enumerable_thread_specific.h>

#include "limn/base/parallel.h"
#include "limn/geometry/bounds.h"

namespace limn {
namespace {

constexpr std::size_t sample_size = 2000;
constexpr int widest = 6;
constexpr double wanted_error = 0.025;

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
        std::mt19937_64 random(1);
        for (std::size_t i = 0; i < sample_size; ++i)
            sample.push_back(std::uint32_t(random() % vertices));
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
};

using Collectors = tbb::enumerable_thread_specific<RingCollector>;

Trial run_trial(const JetContext& context, const std::vector<std::uint32_t>& sample, int rings, Collectors& collectors)
{
    struct Fit {
        double noise, reach, points, derivative;
    };
    const std::vector<Fit> fits = parallel_collect<Fit>(sample.size(), 256, [&](std::size_t begin, std::size_t end, std::vector<Fit>& out) {
        RingCollector& collector = collectors.local();
        Neighbourhoods hoods;
        hoods.clear();
        for (std::size_t i = begin; i < end; ++i) {
            collector.collect(sample[i], {rings, 18}, hoods.neighbour);
            hoods.close(sample[i]);
        }
        std::vector<Jet> jets(hoods.size());
        fit_jets({context.positions, context.normals, &hoods, true}, {4, false}, jets);
        for (std::size_t i = 0; i < jets.size(); ++i)
            if (jets[i].ok)
                out.push_back({jets[i].residual, jets[i].reach, double(hoods.start[i + 1] - hoods.start[i]), glm::length(jets[i].derivative)});
    });
    const auto median_of = [&](double Fit::*member) {
        std::vector<double> values;
        for (const Fit& fit : fits)
            values.push_back(fit.*member);
        return median(std::move(values));
    };
    return {median_of(&Fit::noise), median_of(&Fit::reach), median_of(&Fit::points), median_of(&Fit::derivative)};
}

/// Runs the trials that a choice asks for, each once.
class Trials {
public:
    explicit Trials(const JetContext& context)
        : context_(context), sample_(sample_vertices(context)),
          collectors_([&context] { return RingCollector(context.positions, context.neighbours); })
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

RingChoice result(Trials& trials, int rings)
{
    return {{{4, rings == 2}, rings}, 0, trials.at(rings).noise, trials.error(rings), true};
}

} // namespace

RingChoice predict_rings(const JetContext& context, int rings)
{
    Trials trials(context);
    return result(trials, rings);
}

RingChoice choose_rings(const JetContext& context)
{
    Trials trials(context);
    int best = 2;
    for (int rings = 2; rings < widest && trials.error(best) > wanted_error; ++rings)
        if (trials.error(rings) < trials.error(best))
            best = rings;
    return result(trials, best);
}

} // namespace limn
