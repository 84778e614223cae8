#pragma once

#include "limn/gpu/block_scan.h"
#include "limn/gpu/model_buffers.h"
#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "limn/lines/cluster_extract.h"
#include "limn/lines/line_model.h"

namespace limn::gpu {

/// Contours, suggestive contours and highlights (M1, M3, M4 of the contour-lines specification) found by compute shaders: those of
/// extract_contours and extract_suggestive, in the same order, from the same formula texts. A face may differ where a quantity is within
/// rounding of zero.
///
/// A view takes four passes: quantities at the vertices; a bit for each face and kind of line; prefix sums of their number; and
/// for each segment a search for its bit. Nothing depends on the order in which the device works. Segments stay on the device, with commands
/// that draw them, and nothing is read back but by complete() and read().
///
/// Needs a Context.
class LineExtractor {
public:
    /// @param model  must outlive this; with normals; suggestive lines need its derivative of curvature
    /// @throws Error::Input for a model without normals, Error::Device where it does not fit.
    explicit LineExtractor(const LineModel& model);

    /// Queues the extraction. The first view waits for the device to learn how much room lines take, and makes twice as much; a later one
    /// does not wait, and where it finds more lines than there is room for, the last ones are missing until complete().
    /// @param request  `use` is not read
    /// @throws Error::Input when suggestive lines are wanted and the model has no derivative of curvature.
    void extract(const View& view, const ClusterRequest& request);

    /// Makes sure that all lines of the last view are there: waits for the device, and where there was too little room, makes it.
    /// @throws Error::Device where the device has no room.
    void complete();

    /// The lines of the last view (completed), each kind in the order of the faces. Waits for the device.
    /// @throws Error::Device when something went wrong there.
    ClusterLines read();

    const LineModel& model() const { return model_; }
    const ModelBuffers& geometry() const { return geometry_; }
    /// See shaders/segments.glsl: first all contours, then suggestive contours, then highlights.
    const Buffer& segments() const { return segments_; }
    /// Begins with three commands of glDrawArraysIndirect, one for each kind: six vertices for each segment, the first of segment i being 6 i.
    const Buffer& commands() const { return commands_; }
    std::size_t capacity() const { return capacity_; }     ///< segments that there is room for

private:
    void find(const View& view, const ClusterRequest& request) const;
    void fill() const;
    uvec4 count() const;

    const LineModel& model_;
    std::size_t face_blocks_, blocks_;
    Program vertices_program_, count_program_, commands_program_, fill_program_;
    ModelBuffers geometry_;
    Buffer e1_, e2_, derivatives_, creases_;
    Buffer values_, speeds_, found_, commands_, segments_;
    BlockScan scan_;
    std::size_t capacity_ = 0;
    bool measured_ = false; ///< a view was seen: there is room for twice its lines
};

} // namespace limn::gpu
