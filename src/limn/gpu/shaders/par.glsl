// What the passes of parallel adaptive refinement share (par_refiner.h). Bits of a triangle: the edges that are split, and two more.
#include "limn/gpu/shaders/terrain_lists.glsl"

const uint FIRST_LEG = 1u;
const uint SECOND_LEG = 2u;
const uint HYPOTENUSE = 4u;
const uint FRESH = 8u;  // its edges were not tested yet
const uint MARKS = 16u; // its hypotenuse has to be split with one of its legs

// Places in `arguments`.
const uint TEST = 0u;
const uint MARK = 1u;
const uint SCATTER = 2u;
const uint COUNT = 3u;
const uint SCAN = 4u;
const uint FILL = 5u;
const uint PIECES_COUNT = 9u; // as in terrain_pieces.glsl
