#pragma once

#include <vector>

#include "limn/drawing/drawing.h"
#include "limn/lines/projector.h"
#include "limn/lines/segment.h"

namespace limn {

/// Appends the parts of a stroke that lie in the picture [0,w] x [0,h], enlarged by 2 % so that round ends at its border
/// stay outside. A stroke that lies inside is appended as it is.
void clip_to_picture(Stroke stroke, const ivec2& size, std::vector<Stroke>& out);

/// Removes what lies behind the eye or closer to it than a thousandth of the model's radius (perspective cameras only). A
/// cut end gets the id `none`.
void clip_to_near_plane(std::vector<Segment>& segments, const Projector& projector);

} // namespace limn
