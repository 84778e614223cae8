#include "bench_pattern.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>

#include <fmt/format.h>

#include "band_energy.h"
#include "bench_table.h"
#include "bench_truth.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/drawing/png.h"
#include "limn/pattern/filament.h"
#include "pattern_figures.h"
#include "pattern_frames.h"
#include "pattern_subjects.h"
#include "slicer_truth.h"

using namespace limn;

namespace {

using Method = PatternMethod;

constexpr double zooms[] = {1.0 / 20, 1.0 / 10, 1.0 / 5, 1.0 / 2, 1, 2, 5, 10, 20}; // periods a pixel
constexpr double first_moire = 0.5, last_moire = 20, moire_step = 1.1892071150027;  // a quarter of an octave
constexpr double below = 0.9;                                                       // of the pattern's frequency

struct Way {
    Method method;
    const char* name;
    Method reference; ///< of its own kernel
};

constexpr Way ways[] = {
    {Method::gauss, "filter", Method::gauss_reference},   {Method::box, "filter, square", Method::box_reference},
    {Method::seed, "seed", Method::box_reference},        {Method::even, "50 even", Method::gauss_reference},
    {Method::four, "4 samples", Method::pixel_reference}, {Method::derivative, "smoothstep", Method::pixel_reference},
    {Method::centre, "centre", Method::pixel_reference},
};
constexpr std::size_t way_count = std::size(ways), seed_way = 2;

double cpu_ns()
{
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e9 * double(now.tv_sec) + double(now.tv_nsec);
}

/// What is seen: encoded, no lighter than white.
vec3 seen(const vec3& linear) { return glm::min(encoded_colour(linear), vec3(1)); }

double rmse(const std::vector<vec3>& a, const std::vector<vec3>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const vec3 d = seen(a[i]) - seen(b[i]);
        sum += double(glm::dot(d, d));
    }
    return std::sqrt(sum / (3 * double(a.size())));
}

struct Measures {
    double error = 0, ns = 0; ///< encoded; a pixel
};

/// Every way on one subject: errors once, times as medians of runs that take turns.
std::vector<Measures> measure(const PatternSubject& subject, int runs)
{
    std::map<Method, std::vector<vec3>> references;
    for (const Method reference : {Method::gauss_reference, Method::box_reference, Method::pixel_reference})
        references[reference] = {};
    std::vector<Method> wanted = {Method::gauss_reference, Method::box_reference, Method::pixel_reference};
    parallel_each(wanted.size(), 1, [&](std::size_t k) { references.at(wanted[k]) = subject.draw(wanted[k]); });
    std::vector<Measures> measures(way_count);
    std::vector<std::vector<double>> times(way_count);
    for (int run = 0; run < runs; ++run)
        for (std::size_t k = 0; k < way_count; ++k) {
            const double start = cpu_ns();
            const std::vector<vec3> picture = subject.draw(ways[k].method);
            times[k].push_back((cpu_ns() - start) / double(picture.size()));
            if (run == 0)
                measures[k].error = rmse(picture, references.at(ways[k].reference));
        }
    for (std::size_t k = 0; k < way_count; ++k)
        measures[k].ns = median(times[k]);
    return measures;
}

/// Band energy of what is not the pattern's mean.
double moire(const PatternSubject& subject, Method method, int edge, double frequency)
{
    const std::vector<vec3> picture = subject.draw(method), mean = subject.mean();
    if (picture.size() != std::size_t(edge) * std::size_t(edge))
        throw Error::Input("bench pattern: a surface does not fill its picture");
    std::vector<float> luminance;
    for (std::size_t i = 0; i < picture.size(); ++i)
        luminance.push_back(glm::dot(seen(picture[i]) - seen(mean[i]), vec3(0.2126f, 0.7152f, 0.0722f)));
    return band_energy(luminance, edge, below * frequency);
}

struct Moire {
    std::map<Method, double> from_half, from_one; ///< sums over the sweep
};

constexpr Method moire_methods[] = {Method::gauss, Method::box,        Method::seed,  Method::even,
                                    Method::four,  Method::derivative, Method::centre};

struct PatternBench {
    int edge = 64, moire_edge = 128, runs = 7;
};

struct Tables {
    MarkdownTable errors, times, summary, moire;
    FrameTimes frames;
    TruthTables truth;
    SlicerTable slicer;
};

constexpr int truth_width = 280; ///< of a picture beside rays, pixels

std::vector<std::string> zoom_header(std::initializer_list<const char*> first)
{
    std::vector<std::string> row(first.begin(), first.end());
    for (const double zoom : zooms)
        row.push_back(zoom < 1 ? fmt::format("{:.0f} px", 1 / zoom) : fmt::format("{:.0f}/px", zoom));
    return row;
}

/// Errors and times over the zoom sweep.
void add_sweep(const PatternBench& bench, Console& console, Tables& tables)
{
    std::vector<std::vector<std::vector<Measures>>> all; // zoom, subject, way
    std::vector<std::string> names;
    for (const double zoom : zooms) {
        console.progress(fmt::format("{:.2g} periods a pixel", zoom), 0.6 * double(all.size()) / double(std::size(zooms)));
        all.emplace_back();
        names.clear();
        for (const auto& subject : pattern_subjects(zoom, bench.edge, false)) {
            all.back().push_back(measure(*subject, bench.runs));
            names.push_back(subject->name());
        }
    }
    for (std::size_t s = 0; s < names.size(); ++s) {
        std::vector<double> ns(way_count), worst_share(way_count);
        for (std::size_t k = 0; k < way_count; ++k) {
            std::vector<std::string> errors = {names[s], ways[k].name}, times = {names[s], ways[k].name};
            std::vector<double> series;
            for (const auto& zoom : all) {
                errors.push_back(fmt::format("{:.4f}", zoom[s][k].error));
                times.push_back(fmt::format("{:.0f}", zoom[s][k].ns));
                series.push_back(zoom[s][k].ns);
                worst_share[k] = std::max(worst_share[k], zoom[s][k].error / zoom[s][seed_way].error);
            }
            tables.errors.add(errors);
            tables.times.add(times);
            ns[k] = median(series);
        }
        std::vector<std::string> row = {names[s]};
        for (const std::size_t k : {std::size_t(0), std::size_t(1)}) {
            double least = 1e30;
            for (const auto& zoom : all)
                least = std::min(least, zoom[s][seed_way].ns / zoom[s][k].ns);
            row.push_back(fmt::format("{:.1f}", ns[seed_way] / ns[k]));
            row.push_back(fmt::format("{:.1f}", least));
            row.push_back(fmt::format("{:.2f}", worst_share[k]));
        }
        tables.summary.add(row);
    }
}

void add_moire(const PatternBench& bench, Console& console, Tables& tables)
{
    std::vector<Moire> all;
    std::vector<std::string> names;
    std::vector<double> sweep;
    for (double f = first_moire; f < last_moire * 1.001; f *= moire_step)
        sweep.push_back(f);
    for (const double f : sweep) {
        console.progress(fmt::format("moiré, {:.2g} periods a pixel", f),
                         0.6 + 0.4 * std::log(f / first_moire) / std::log(last_moire / first_moire));
        const auto subjects = pattern_subjects(f, bench.moire_edge, true);
        all.resize(subjects.size());
        names.clear();
        for (std::size_t s = 0; s < subjects.size(); ++s) {
            names.push_back(subjects[s]->name());
            double energies[std::size(moire_methods)] = {};
            parallel_each(std::size(moire_methods), 1,
                          [&](std::size_t k) { energies[k] = moire(*subjects[s], moire_methods[k], bench.moire_edge, f); });
            for (std::size_t k = 0; k < std::size(moire_methods); ++k) {
                all[s].from_half[moire_methods[k]] += energies[k];
                if (f > 0.999)
                    all[s].from_one[moire_methods[k]] += energies[k];
            }
        }
    }
    for (std::size_t s = 0; s < names.size(); ++s)
        for (const bool half : {true, false}) {
            const std::map<Method, double>& sums = half ? all[s].from_half : all[s].from_one;
            std::vector<std::string> row = {names[s], half ? "1/2" : "1"};
            for (const Method method : moire_methods)
                row.push_back(fmt::format("{:.3f}", sums.at(method) / sums.at(Method::seed)));
            row.push_back(fmt::format("{:.2g}", sums.at(Method::seed)));
            tables.moire.add(row);
        }
}

std::string text_of(const SlicerTable& sliced)
{
    if (sliced.slicer.empty())
        return "Prints beside a slicer's: prusa-slicer is not installed, so nothing was compared.\n";
    return fmt::format("Parts as {} lays them, in layers of {} mm and beads 0.45 mm wide: its beads as rays meet them, as above, and "
                       "beside them the models of layers on the part, "
                       "and *G-code*: the same file drawn by `limn render`:\n\n{}\n",
                       sliced.slicer, sliced_layer, sliced.errors.text());
}

std::string text_of(const PatternBench& bench, const Tables& tables)
{
    return fmt::format(
        "## Patterns\n\n`limn bench pattern`, version {}, {}, one thread for times. Bricks with bevels and print layers on a leaning "
        "plane, thread on a sphere, without "
        "its outline and poles; {} x {} pixels in perspective, from 20 pixels a period to 20 periods a pixel in the middle. *filter*: the "
        "analytic filter, a Gauss "
        "kernel of 0.5 px; *square*: of 2 x 2 pixels; *seed*: the seed's 50 samples over 2 x 2 pixels (its generator from 1 on, inversion "
        "of the pipeline in its cheaper "
        "form); *50 even*: the R2 sequence under the Gauss kernel; *4 samples*: one rotated grid a pixel; *smoothstep*: edges as wide as "
        "the derivative, normals at "
        "the centre.\n\nAgainst the seed: times are CPU time of pattern and shading without finding the surface, over the sweep's median "
        "and at its least; errors as "
        "the largest share of the seed's over the sweep:\n\n{}\n"
        "RMSE (encoded, 1 is white) against 1,024 stratified samples of each way's own kernel (of one pixel where it has none):\n\n{}\n"
        "Nanoseconds a pixel, medians of {} runs:\n\n{}\n"
        "Moiré: energy at up to {} of the pattern's lowest frequency, of what is not the pattern's mean, on {} x {} pixels without "
        "perspective, summed from half a period or "
        "one period a pixel to {:.0f} in quarters of an octave; as a share of the seed's, and the seed's:\n\n{}\n"
        "Milliseconds a frame, all threads: on the processor (rays, the filter, one sample a pixel), and on the device ({}) with the "
        "filter, with outlines of 4 samples, and "
        "with the seed's 50 samples for every pixel; frames a second are those of the device's filter:\n\n{}\n"
        "Prints beside the truth: the model's slices as real steps, flat or with the round edge of a single wall's beads, met by {} rays a "
        "pixel of the same kernel, under the same "
        "light, its disc, sky and floor with what hides them; {} px wide, a studio's light, grey PETG. FLIP (Andersson et al. 2020; 0 is "
        "equal, {:.0f} px a degree) of each model, and "
        "the highlight's length over its width, if there is a highlight:\n\n{}\n{}",
        LIMN_VERSION, machine_name(), bench.edge, bench.edge, tables.summary.text(), tables.errors.text(), bench.runs, tables.times.text(),
        below, bench.moire_edge, bench.moire_edge, last_moire, tables.moire.text(), tables.frames.device, tables.frames.table.text(),
        truth_side * truth_side, truth_width, 67.0, tables.truth.errors.text(), text_of(tables.slicer));
}

std::string json_of(const PatternBench& bench, const Tables& tables)
{
    const nlohmann::ordered_json json = {{"limn", LIMN_VERSION},
                                         {"command", "bench"},
                                         {"what", "pattern"},
                                         {"machine", machine_name()},
                                         {"edge", bench.edge},
                                         {"runs", bench.runs},
                                         {"summary", ::json_of(tables.summary)},
                                         {"rmse", ::json_of(tables.errors)},
                                         {"ns_a_pixel", ::json_of(tables.times)},
                                         {"moire", ::json_of(tables.moire)},
                                         {"device", tables.frames.device},
                                         {"ms_a_frame", ::json_of(tables.frames.table)},
                                         {"truth", ::json_of(tables.truth.errors)},
                                         {"slicer", tables.slicer.slicer},
                                         {"sliced", ::json_of(tables.slicer.errors)}};
    return json.dump(2) + "\n";
}

} // namespace

BenchResult bench_pattern(const BenchRequest& request, Console& console)
{
    PatternBench bench;
    if (request.edges.size() > 1)
        throw Error::Input("bench pattern: give one size with --edges");
    if (!request.edges.empty())
        bench.edge = request.edges.front();
    bench.runs = std::max(1, request.runs);
    if (!request.figures.empty())
        write_pattern_figures(request.figures, console);
    Tables tables = {
        MarkdownTable(zoom_header({"pattern", "way"})),
        MarkdownTable(zoom_header({"pattern", "way"})),
        MarkdownTable({"pattern", "filter: times faster", "at least", "error/seed's, at most", "square: times faster", "at least",
                       "error/seed's, at most"}),
        MarkdownTable({"pattern", "from", "filter", "square", "seed", "50 even", "4 samples", "smoothstep", "centre", "seed's energy"}),
        {},
        {},
        {}};
    add_sweep(bench, console, tables);
    add_moire(bench, console, tables);
    tables.frames = time_pattern_frames(std::max(1, request.runs / 2), console);
    tables.truth = compare_with_truth(truth_width, console);
    tables.slicer = compare_with_slicer(truth_width, console);
    if (!request.figures.empty())
        write_file((request.figures / "truth.png").string(), encode_png(tables.truth.strip, {}));
    return {text_of(bench, tables), json_of(bench, tables), counted(pattern_subjects(1, 8, true).size(), "pattern")};
}
