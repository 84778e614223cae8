#include "limn/gpu/pattern_numbers.h"

#include <fmt/format.h>

namespace limn::gpu {
namespace {

void pack_finish(const formulas::Finish& f, PatternNumbers& numbers)
{
    numbers.own[4] = vec4(f.colour, f.specular);
    numbers.own[5] = vec4(f.exponent, f.along, f.across, f.f0);
}

void pack(const LayerShader& s, PatternNumbers& numbers, std::vector<float>& tops)
{
    const formulas::LayerPattern& p = s.pattern;
    const formulas::LayerRow row = s.stack.row();
    numbers.own[0] = vec4(p.up, p.soft_low);
    numbers.own[1] = vec4(p.soft_high, p.bulge, p.variety, p.block);
    numbers.own[2] = vec4(p.across, 0);
    numbers.own[3] = vec4(row.bottom, row.height, float(row.count), float(tops.size()));
    tops.insert(tops.end(), s.stack.tops().begin(), s.stack.tops().end());
    pack_finish(s.finish, numbers);
}

void pack(const BrickShader& s, PatternNumbers& numbers, std::vector<float>&)
{
    const formulas::BrickPattern& p = s.pattern;
    numbers.own[0] = vec4(p.cell, p.joint);
    numbers.own[1] = vec4(p.bump, p.variety);
    numbers.own[2] = vec4(p.brick, 0);
    numbers.own[3] = vec4(p.mortar, 0);
    pack_finish(s.finish, numbers);
}

void pack(const ThreadShader& s, PatternNumbers& numbers, std::vector<float>&)
{
    const formulas::ThreadPattern& p = s.pattern;
    numbers.own[0] = vec4(p.hole, p.thread, p.specular, p.exponent);
    numbers.own[1] = vec4(p.colour, p.cone);
    numbers.own[2] = vec4(s.centre, p.gate);
}

void pack(const PatternLight& light, PatternNumbers& numbers)
{
    const formulas::Illumination& lit = light.lighting;
    numbers.to_light = vec4(lit.to_light, lit.radius);
    numbers.light = vec4(lit.light, light.place ? 1 : 0);
    numbers.up = vec4(lit.up, 0);
    numbers.above = vec4(lit.above, 0);
    numbers.below = vec4(lit.below, 0);
    numbers.lamp = vec4(light.place.value_or(vec3(0)), 0);
    numbers.intensity = vec4(light.intensity, 0);
    numbers.falloff = vec4(light.falloff, 0);
}

std::string macro(const char* name, int value) { return fmt::format("#define {} {}\n", name, value); }

struct KindText {
    PatternProgramText operator()(const LayerShader& s) const
    {
        return {"pattern_layers.frag", macro("LAYER_MODEL", s.pattern.model) + macro("LAYER_TABLE", !s.stack.tops().empty()) +
                                           macro("FINISH_MODEL", s.finish.model) + macro("CUSPS", cusps)};
    }
    PatternProgramText operator()(const BrickShader& s) const
    {
        return {"pattern_bricks.frag",
                macro("BRICK_AXES", s.pattern.axes) + macro("BRICK_BOND", s.pattern.bond) + macro("FINISH_MODEL", s.finish.model)};
    }
    PatternProgramText operator()(const ThreadShader& s) const { return {"pattern_thread.frag", macro("WOVEN", s.pattern.woven)}; }
    bool cusps;
};

} // namespace

PackedPatterns packed_patterns(const PatternPaint& paint, const Camera& camera, const dvec3& centre, double scale)
{
    PackedPatterns packed;
    for (const PaintedPattern& pattern : paint.patterns) {
        const PatternFrame& frame = pattern.frame;
        const formulas::PatternEye eye = PatternCamera(camera, centre, scale, frame).eye();
        PatternNumbers numbers = {};
        numbers.turn_x = vec4(frame.turn[0], frame.scale);
        numbers.turn_y = vec4(frame.turn[1], 0);
        numbers.turn_z = vec4(frame.turn[2], 0);
        numbers.shift = vec4(frame.shift, 0);
        numbers.eye = vec4(eye.place, float(eye.parallel));
        numbers.forward = vec4(eye.forward, 0);
        numbers.right = vec4(eye.right, 0);
        numbers.down = vec4(eye.down, 0);
        std::visit(
            [&](const auto& shader) {
                pack(shader.light, numbers);
                pack(shader, numbers, packed.tops);
            },
            pattern.lit.front());
        packed.numbers.push_back(numbers);
    }
    return packed;
}

PatternProgramText program_text(const PatternPaint& paint)
{
    PatternProgramText text = std::visit(KindText{paint.cusps}, paint.patterns.front().lit.front());
    text.macros += macro("TABLE_WIDTH", table_width) + macro("OWN_PATTERNS", paint.patterns.size() > 1) +
                   macro("PATTERN_KERNEL", paint.kernel) + macro("PATTERN_SAMPLED", !paint.samples.empty() && !paint.cusps);
    return text;
}

} // namespace limn::gpu
