#pragma once

namespace limn {

/// The cross-section of a bead, which slicers agree on: a box of its height that ends in half circles (a stadium). One that is narrower than
/// high stands upright. mm and mm².
double bead_area(double width, double height);

/// The width of a bead of an area, which inverts bead_area: area / height + height (1 - pi/4) from a circle on; below that, the width of the stadium that
/// stands upright. 0 for an area of 0. @param height  above 0
double bead_width(double area, double height);

/// Of a round thread. @param diameter  mm
double thread_area(double diameter);

} // namespace limn
