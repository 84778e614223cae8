#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "limn/drawing/drawing.h"

namespace limn::test {

/// A stroke along a curve for t in [0,1].
inline Stroke stroke_along(LineType type, int points, const std::function<dvec2(double)>& curve, const std::function<double(double)>& ink = nullptr)
{
    Stroke stroke;
    stroke.type = type;
    for (int i = 0; i < points; ++i) {
        const double t = double(i) / (points - 1);
        const dvec2 p = curve(t);
        stroke.points.push_back(p);
        stroke.world.push_back({p.x * 0.01, -p.y * 0.01, t});
        stroke.ink.push_back(ink ? float(ink(t)) : 1.0f);
        stroke.faces.push_back(std::uint32_t(i));
    }
    return stroke;
}

inline Stroke closed_stroke(LineType type, int points, const dvec2& centre, const dvec2& radii)
{
    Stroke stroke = stroke_along(type, points + 1, [&](double t) { return centre + radii * dvec2(std::cos(2 * M_PI * t), std::sin(2 * M_PI * t)); });
    stroke.closed = true;
    stroke.points.pop_back();
    stroke.world.pop_back();
    stroke.ink.pop_back();
    stroke.faces.pop_back();
    return stroke;
}

/// 640 x 480 with every kind of thing a drawing can hold: closed and open, fading, hidden, cornered and tiny strokes.
inline Drawing sample_drawing()
{
    Drawing drawing;
    drawing.camera.size = {640, 480};
    Region silhouette;
    silhouette.name = "silhouette";
    silhouette.colour = vec3(0.93f, 0.95f, 1.0f);
    silhouette.rings = {closed_stroke(LineType::contour, 90, {300, 250}, {210, 150}).points, closed_stroke(LineType::contour, 40, {360, 300}, {60, 45}).points};
    drawing.regions.push_back(silhouette);
    for (int k = 0; k < 4; ++k)
        drawing.strokes.push_back(stroke_along(
            LineType::highlight, 40, [&](double t) { return dvec2(180 + 200 * t, 140 + 14 * k + 12 * std::sin(6 * t + k)); }, [](double t) { return t; }));
    for (int k = 0; k < 9; ++k)
        drawing.strokes.push_back(stroke_along(
            LineType::suggestive, 60, [&](double t) { return dvec2(140 + 300 * t, 210 + 15 * k + 20 * std::sin(4 * t + 0.3 * k)); },
            [&](double t) { return std::clamp(1.4 * std::sin(M_PI * t) - 0.1 * k * t, 0.0, 1.0); }));
    Stroke box;
    box.type = LineType::crease;
    box.points = {{470, 60}, {600, 60}, {600, 170}, {530, 190}, {470, 150}};
    box.closed = true;
    drawing.strokes.push_back(box);
    drawing.strokes.push_back(stroke_along(LineType::border, 5, [](double t) { return dvec2(470 + 130 * t, 400 + 60 * (t > 0.5)); }));
    drawing.strokes.push_back(closed_stroke(LineType::contour, 180, {300, 250}, {210, 150}));
    drawing.strokes.push_back(closed_stroke(LineType::contour, 80, {360, 300}, {60, 45}));
    drawing.strokes.push_back(closed_stroke(LineType::contour, 9, {60, 60}, {4, 4}));
    drawing.strokes.push_back(stroke_along(LineType::contour, 150, [](double t) { return dvec2(40 + 30 * std::cos(9 * t), 420 * t + 30); }));
    Stroke hidden = stroke_along(LineType::contour, 60, [](double t) { return dvec2(120 + 360 * t, 380 - 200 * t * t); });
    hidden.visible = false;
    drawing.strokes.push_back(hidden);
    return drawing;
}

/// The sample before a shaded ball.
inline Drawing sample_with_background()
{
    Drawing drawing = sample_drawing();
    drawing.regions.clear();
    drawing.background = Image({640, 480}, 3, 1.0f);
    for (int y = 0; y < 480; ++y)
        for (int x = 0; x < 640; ++x) {
            const double u = (x + 0.5 - 300) / 210, v = (y + 0.5 - 250) / 150, r2 = u * u + v * v;
            if (r2 < 1)
                for (int c = 0; c < 3; ++c)
                    drawing.background.at(x, y)[c] = float(0.25 + 0.6 * std::sqrt(1 - r2) - 0.04 * c);
        }
    return drawing;
}

} // namespace limn::test
