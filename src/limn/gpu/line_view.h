#pragma once

#include "limn/base/image.h"
#include "limn/camera/camera.h"
#include "limn/gpu/line_extraction.h"

namespace limn::gpu {

/// Widths of lines in pixels, by kind: contours, suggestive contours, highlights.
struct LineWidths {
    float contour = 2, suggestive = 2, highlight = 2;
};

/// Draws the segments of a LineExtractor where they are, on the device: hidden by the surface, with round ends, joined without gaps or
/// dark spots. Needs a Context.
class LineRenderer {
public:
    /// @param lines  must outlive this
    explicit LineRenderer(const LineExtractor& lines);

    /// Queues the drawing of the surface's depth into a framebuffer, which is cleared to the farthest before.
    void draw_depth(const Framebuffer& target, const Camera& camera) const;

    /// Queues the drawing of the lines that the last view found, by the commands on the device; nothing is read back.
    /// The camera should be the one that they were found for.
    /// @param depth   draw_depth of the same camera and size
    /// @param target  of that size, cleared to 0; the first colour picture gets the ink in [0,1]: red contours, green suggestive contours,
    ///                blue highlights
    void draw(const Framebuffer& target, const Framebuffer& depth, const Camera& camera, const LineWidths& widths = {}) const;

private:
    const LineExtractor& lines_;
    Program depth_program_, line_program_;
    VertexArray array_;
};

/// The ink of the lines seen by a camera, read back: images of one channel, rows from the top.
struct LineView {
    Image contours, suggestive, highlights;
};

/// Finds and draws the lines of one view. Waits for the device.
/// @throws as LineExtractor, Error::Device when the picture is larger than the device allows.
LineView draw_lines(LineExtractor& lines, const LineRenderer& renderer, const Camera& camera, const ClusterRequest& request, const LineWidths& widths = {});

} // namespace limn::gpu
