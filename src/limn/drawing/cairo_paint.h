#pragma once

#include "limn/drawing/painting.h"

struct _cairo;

namespace limn {

/// Paints everything but the paper onto a Cairo surface whose user space is the page in page units.
void paint(_cairo* cairo, const Painting& painting);

} // namespace limn
