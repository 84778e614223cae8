#pragma once

namespace limn::gpu {

/// Faults that some drivers have (Mesa 22.3's software renderer has both), and that programs here walk around.
struct Quirks {
    /// A tessellated draw of more than 65,535 evaluated vertices comes out wrong: split it.
    bool small_tessellated_draws = false;
    /// What fragment shaders write to buffers is lost where the framebuffer has no depth. Framebuffer always has one.
    bool needs_depth = false;
};

/// Draws a few small pictures to find out. Needs a Context; a few milliseconds where the driver is sound.
Quirks find_quirks();

} // namespace limn::gpu
