#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "console.h"

/// What a benchmark is asked for. What is empty or 0 is the benchmark's own choice.
struct BenchRequest {
    std::vector<std::size_t> sizes;  ///< triangles, or samples along a side of terrain; ascending
    std::vector<std::string> models; ///< shapes or landforms of `limn sample`, or files
    int views = 0;                   ///< or frames of a flight
    std::vector<double> bounds;      ///< of meshes of terrain, metres
    std::vector<int> edges;          ///< of square pictures, px
    int runs = 7;                    ///< of whole processes; 0: none
    std::filesystem::path figures;   ///< folder for the figures of the study; empty: none are made
    bool full = false;               ///< the whole protocol of the publication that it repeats, however long that takes
};

/// What it measured.
struct BenchResult {
    std::string text; ///< a section of markdown, with its title
    std::string json;
    std::string what; ///< "2 models", for the last line of the run
};

/// One of the benchmarks that `limn bench` can do.
struct Benchmark {
    const char* name;
    /// @throws limn::Error::Input for an unknown model, limn::Error::Device for a GPU that it needs and cannot have.
    BenchResult (*run)(const BenchRequest& request, Console& console);
};
