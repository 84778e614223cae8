#include "bench_processes.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "console.h"
#include "limn/base/error.h"
#include "limn/geometry/write_mesh.h"
#include "limn/surface/shapes.h"
#include "scratch_folder.h"

using namespace limn;

namespace {

struct Cost {
    double seconds = 0, megabytes = 0;
};

/// Runs a shell command without its output. @throws Error::Device when it fails.
Cost cost_of(const std::string& command)
{
    const Stopwatch watch;
    const pid_t child = fork();
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", ("exec " + command + " >/dev/null 2>&1").c_str(), nullptr);
        _exit(127);
    }
    int status = 0;
    rusage used = {};
    if (child < 0 || wait4(child, &status, 0, &used) < 0 || status != 0)
        throw Error::Device("a process that is measured failed: " + command);
    return {watch.total(), double(used.ru_maxrss) / 1000}; // of the largest process below it, where it starts others
}

bool is_installed(const std::string& program) { return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0; }

struct Peer {
    std::string name, command;
    std::vector<Cost> costs;
};

std::vector<Peer> peers(const std::string& model, const std::string& picture)
{
    const std::string limn = fmt::format("'{}' render '{}' -o '{}' --size 1280x720 --quiet", std::filesystem::read_symlink("/proc/self/exe").string(), model, picture);
    std::vector<Peer> all = {{"limn render", limn, {}}, {"limn render --lines contour,suggestive", limn + " --lines contour,suggestive", {}}};
    if (is_installed("f3d") && is_installed("xvfb-run"))
        all.push_back({"f3d (with its display)", fmt::format("xvfb-run -a f3d '{}' --output='{}' --resolution=1280,720", model, picture), {}});
    return all;
}

} // namespace

MarkdownTable bench_processes(const std::string& shape, std::size_t triangles, int runs)
{
    const ScratchFolder folder;
    write_mesh(make_shape({.name = shape, .triangles = triangles}).mesh, folder / "model.ply");
    std::vector<Peer> all = peers((folder / "model.ply").string(), (folder / "picture.png").string());
    for (int run = 0; run < runs; ++run)
        for (Peer& peer : all)
            peer.costs.push_back(cost_of(peer.command));
    MarkdownTable table({"process", "median (s)", "fastest (s)", "memory (MB)"});
    for (const Peer& peer : all) {
        std::vector<double> seconds;
        double memory = 0;
        for (const Cost& cost : peer.costs) {
            seconds.push_back(cost.seconds);
            memory = std::max(memory, cost.megabytes);
        }
        table.add({peer.name, fmt::format("{:.2f}", median(seconds)), fmt::format("{:.2f}", *std::min_element(seconds.begin(), seconds.end())), fmt::format("{:.0f}", memory)});
    }
    return table;
}
