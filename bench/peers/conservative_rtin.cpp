// Right-triangulated irregular networks with a true bound, found by brute force: an oracle for `limn bench terrain`, which runs this program where
// it finds it. It shares nothing with limn's terrain but the reader of the file: each triangle's greatest distance is taken over every
// sample under it in double, one triangle after the other, and raised to those of its children and of its partner in the diamond.
// Prints JSON: {"errors_ms": n, "triangles": [...]}.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "limn/base/file.h"

namespace {

struct Point {
    int x, y;
};

/// With its right angle at c, and a, b, c in one sense of rotation throughout.
struct Triangle {
    Point a, b, c;
    Point middle() const { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; }
    bool has_middle() const { return std::abs(a.x - b.x) > 1 || std::abs(a.y - b.y) > 1; }
    Triangle one() const { return {c, a, middle()}; }
    Triangle other() const { return {b, c, middle()}; }
};

class Grid {
public:
    Grid(std::vector<float> heights, int side) : heights_(std::move(heights)), side_(side), errors_(heights_.size(), 0) {}

    void find_errors()
    {
        int depth = 0;
        for (int cells = side_ - 1; cells > 1; cells /= 2)
            depth += 2;
        for (int level = depth; level >= 0; --level) // both triangles of a diamond are of one level, and done before any that is above them
            for (const Triangle& root : roots())
                visit(root, level);
    }
    std::size_t count(double bound) const { return count(roots()[0], bound) + count(roots()[1], bound); }

private:
    std::vector<Triangle> roots() const
    {
        const int last = side_ - 1;
        return {{{0, 0}, {last, last}, {last, 0}}, {{last, last}, {0, 0}, {0, last}}};
    }
    std::size_t index(const Point& p) const { return std::size_t(p.y) * std::size_t(side_) + std::size_t(p.x); }
    double height(const Point& p) const { return double(heights_[index(p)]); }

    void visit(const Triangle& t, int levels)
    {
        if (!t.has_middle())
            return;
        if (levels > 0) {
            visit(t.one(), levels - 1);
            visit(t.other(), levels - 1);
            return;
        }
        double& error = errors_[index(t.middle())];
        error = std::max(error, own_error(t));
        for (const Triangle& child : {t.one(), t.other()})
            if (child.has_middle())
                error = std::max(error, errors_[index(child.middle())]);
    }
    double own_error(const Triangle& t) const
    {
        const auto [low_x, high_x] = std::minmax({t.a.x, t.b.x, t.c.x});
        const auto [low_y, high_y] = std::minmax({t.a.y, t.b.y, t.c.y});
        const auto twice_area = [](const Point& p, const Point& q, const Point& r) { return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x); };
        const int whole = twice_area(t.a, t.b, t.c);
        double most = 0;
        for (int y = low_y; y <= high_y; ++y)
            for (int x = low_x; x <= high_x; ++x) {
                const Point p{x, y};
                const double u = double(twice_area(p, t.b, t.c)) / whole, v = double(twice_area(t.a, p, t.c)) / whole, w = 1 - u - v;
                if (u >= 0 && v >= 0 && w >= -1e-12)
                    most = std::max(most, std::abs(u * height(t.a) + v * height(t.b) + w * height(t.c) - height(p)));
            }
        return most;
    }
    std::size_t count(const Triangle& t, double bound) const
    {
        if (!t.has_middle() || !(errors_[index(t.middle())] > bound))
            return 1;
        return count(t.one(), bound) + count(t.other(), bound);
    }

    std::vector<float> heights_;
    int side_;
    std::vector<double> errors_;
};

std::vector<float> heights_of(const std::string& bytes)
{
    std::vector<float> heights(bytes.size() / sizeof(float));
    std::copy_n(bytes.data(), heights.size() * sizeof(float), reinterpret_cast<char*>(heights.data()));
    return heights;
}

} // namespace

/// conservative_rtin HEIGHTS SIDE BOUND...: SIDE x SIDE floats row by row, SIDE a power of two and one.
int main(int argc, char** argv)
{
    const int side = argc > 2 ? std::atoi(argv[2]) : 0;
    if (argc < 4 || side < 3 || ((side - 1) & (side - 2)) != 0) {
        fmt::print(stderr, "usage: conservative_rtin HEIGHTS SIDE BOUND..., SIDE a power of two and one\n");
        return 2;
    }
    std::vector<float> heights = heights_of(limn::read_file(argv[1]));
    if (heights.size() != std::size_t(side) * std::size_t(side)) {
        fmt::print(stderr, "conservative_rtin: {}: {} heights instead of {} x {}\n", argv[1], heights.size(), side, side);
        return 1;
    }
    Grid grid(std::move(heights), side);
    const auto start = std::chrono::steady_clock::now();
    grid.find_errors();
    nlohmann::json json;
    json["errors_ms"] = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    for (int i = 3; i < argc; ++i)
        json["triangles"].push_back(grid.count(std::atof(argv[i])));
    fmt::print("{}\n", json.dump());
    return 0;
}
