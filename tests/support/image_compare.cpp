#include "support/image_compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "limn/drawing/png.h"

namespace limn::test {
namespace {

constexpr int radius = 5;

std::array<double, 2 * radius + 1> window()
{
    std::array<double, 2 * radius + 1> weights = {};
    double sum = 0;
    for (int i = -radius; i <= radius; ++i)
        sum += weights[std::size_t(i + radius)] = std::exp(-i * i / (2 * 1.5 * 1.5));
    for (double& w : weights)
        w /= sum;
    return weights;
}

struct Plane {
    int width, height;
    std::vector<double> values;
    double at(int x, int y) const { return values[std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) + std::size_t(std::clamp(x, 0, width - 1))]; }
};

Plane luminance(const Image& image)
{
    Plane plane = {image.width, image.height, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float* s = image.at(x, y);
            plane.values.push_back(image.channels < 3 ? double(s[0]) : 0.299 * double(s[0]) + 0.587 * double(s[1]) + 0.114 * double(s[2]));
        }
    return plane;
}

/// Adds weight * from to a row.
void add_row(double* to, const double* from, int width, double weight)
{
    for (int x = 0; x < width; ++x)
        to[x] += weight * from[x];
}

/// Rows first, then columns; the border repeats its last pixel.
Plane blurred(const Plane& plane)
{
    static const auto weights = window();
    Plane across = plane, result = plane;
    std::fill(across.values.begin(), across.values.end(), 0.0);
    std::fill(result.values.begin(), result.values.end(), 0.0);
    std::vector<double> padded(std::size_t(plane.width) + 2 * radius);
    for (int y = 0; y < plane.height; ++y) {
        for (int x = -radius; x < plane.width + radius; ++x)
            padded[std::size_t(x + radius)] = plane.at(x, y);
        for (int k = 0; k <= 2 * radius; ++k)
            add_row(&across.values[std::size_t(y) * std::size_t(plane.width)], padded.data() + k, plane.width, weights[std::size_t(k)]);
    }
    for (int y = 0; y < plane.height; ++y)
        for (int k = 0; k <= 2 * radius; ++k) {
            const int from = std::clamp(y + k - radius, 0, plane.height - 1);
            add_row(&result.values[std::size_t(y) * std::size_t(plane.width)], &across.values[std::size_t(from) * std::size_t(plane.width)], plane.width, weights[std::size_t(k)]);
        }
    return result;
}

Plane product(const Plane& a, const Plane& b)
{
    Plane result = a;
    for (std::size_t i = 0; i < result.values.size(); ++i)
        result.values[i] *= b.values[i];
    return result;
}

/// The similarity at every pixel.
Plane similarity(const Image& a, const Image& b)
{
    if (a.size() != b.size())
        throw std::runtime_error("pictures of different size have no similarity");
    const Plane x = luminance(a), y = luminance(b);
    const Plane mx = blurred(x), my = blurred(y), xx = blurred(product(x, x)), yy = blurred(product(y, y)), xy = blurred(product(x, y));
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    Plane result = x;
    for (std::size_t i = 0; i < x.values.size(); ++i) {
        const double p = mx.values[i], q = my.values[i], vx = xx.values[i] - p * p, vy = yy.values[i] - q * q, cov = xy.values[i] - p * q;
        result.values[i] = (2 * p * q + c1) * (2 * cov + c2) / ((p * p + q * q + c1) * (vx + vy + c2));
    }
    return result;
}

double mean_of(const Plane& plane, int x0, int y0, int x1, int y1)
{
    double sum = 0;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            sum += plane.at(x, y);
    return sum / (double(x1 - x0) * double(y1 - y0));
}

} // namespace

double ssim(const Image& a, const Image& b) { return mean_of(similarity(a, b), 0, 0, a.width, a.height); }

double lowest_tile_ssim(const Image& a, const Image& b)
{
    constexpr int tile = 32;
    const Plane plane = similarity(a, b);
    double lowest = 1;
    for (int y = 0; y < a.height; y += tile)
        for (int x = 0; x < a.width; x += tile)
            lowest = std::min(lowest, mean_of(plane, x, y, std::min(x + tile, a.width), std::min(y + tile, a.height)));
    return lowest;
}

double largest_difference(const Image& a, const Image& b)
{
    if (a.size() != b.size() || a.channels != b.channels)
        return std::numeric_limits<double>::infinity();
    double largest = 0;
    for (std::size_t i = 0; i < a.samples.size(); ++i)
        largest = std::max(largest, std::abs(double(a.samples[i]) - double(b.samples[i])));
    return largest;
}

std::filesystem::path write_difference(const Image& a, const Image& b, const std::string& name)
{
    const int width = std::max(a.width, b.width), height = std::max(a.height, b.height);
    Image sheet({3 * width, height}, 3, 1.0f);
    const auto sample = [](const Image& image, int x, int y, int c) {
        return x < image.width && y < image.height ? image.at(x, y)[image.channels < 3 ? 0 : c] : 1.0f;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float p = sample(a, x, y, c), q = sample(b, x, y, c);
                sheet.at(x, y)[c] = p;
                sheet.at(width + x, y)[c] = q;
                sheet.at(2 * width + x, y)[c] = 1 - std::abs(p - q);
            }
    const auto folder = std::filesystem::temp_directory_path() / "limn-test-pictures";
    std::filesystem::create_directories(folder);
    write_png(sheet, folder / (name + ".png"));
    return folder / (name + ".png");
}

} // namespace limn::test
