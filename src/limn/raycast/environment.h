#pragma once

#include <vector>

#include "limn/base/image.h"

namespace limn {

/// Light from all directions: a picture whose columns go around the up axis and whose rows go from straight up to straight down. Its middle column is the
/// front, where cameras of azimuth 0 look from; to the right of it comes what is on the right of one who looks there. Each pixel is one even piece.
class EnvironmentMap {
public:
    /// @param picture  light in RGB, linear; what is not finite or below 0 is dark
    /// @throws Error::Input for an empty picture, one without three channels, and one that is dark all over
    explicit EnvironmentMap(const Image& picture);

    struct Drawn {
        vec3 direction; ///< unit, in the map's own axes: y up, z the front
        vec3 light;
        float density;  ///< chance of it by solid angle
    };
    /// A direction as often as its luminance is high. @param u  in the unit square
    Drawn draw(const vec2& u) const;
    vec3 light(const vec3& direction) const;
    /// Of any direction, as often as it is drawn: by solid angle and for each unit of its luminance.
    float density_of_luminance() const { return float(1 / rows_.back()); }
    /// Over what solid angle its light is spread: that of an even light of the same sums of luminance and of its square.
    float spread() const { return spread_; }
    /// What the side of a surface gets that gets the most: of luminance, per solid angle and cosine.
    float most_received() const { return most_; }

private:
    std::size_t pixel_of(const vec3& direction) const;

    int width_ = 0, height_ = 0;
    std::vector<vec3> light_;
    std::vector<double> rows_, columns_;    ///< luminance times solid angle: before each row, and before each pixel of its row; with the totals
    float most_ = 0, spread_ = 0;
};

/// Luminance of linear RGB (Rec. 709).
inline float luminance(const vec3& light) { return 0.2126f * light.x + 0.7152f * light.y + 0.0722f * light.z; }

/// Turns directions of the world into those of a map that stands upright in it. @param up  unit: y or z axis
glm::mat3 environment_axes(const vec3& up);

} // namespace limn
