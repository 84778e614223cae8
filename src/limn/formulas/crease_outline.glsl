// The parts of a crease edge that are outline: where one of its two sides faces the eye and the other does not. Each side has its own
// normals, so each may turn once along the edge. One text for C++ and GLSL.
#pragma once

// Places along a crease.
const uint CREASE_START = 0u;
const uint CREASE_OWN_TURN = 1u;   // where the side of its own half-edge turns
const uint CREASE_OTHER_TURN = 2u; // where the side of the twin turns
const uint CREASE_END = 3u;

// The part between two neighbouring places, directed so that the front keeps to the right.
struct CreasePart {
    bool drawn;
    bool own_back; // the side of its own half-edge is turned away
    uint from;
    uint to;
};

// Part k of a crease: 0, 1 or 2 from its start; not drawn where it has fewer.
// own_start .. other_end: n.v of the two sides at the two ends of the edge. own_s, other_s: parameter from the start where the side turns;
// read only where it does.
FORMULA CreasePart crease_part(const int k, const float own_start, const float own_end, const float other_start, const float other_end,
                               const float own_s, const float other_s)
{
    bool own_back = own_start < 0.0f;
    bool other_back = other_start < 0.0f;
    bool own_turns = own_back != (own_end < 0.0f);
    bool other_turns = other_back != (other_end < 0.0f);
    bool other_first = other_turns && (!own_turns || other_s < own_s);
    int turns = (own_turns ? 1 : 0) + (other_turns ? 1 : 0);
    uint first = other_first ? CREASE_OTHER_TURN : CREASE_OWN_TURN;
    uint second = other_first ? CREASE_OWN_TURN : CREASE_OTHER_TURN;
    uint begin = k == 0 ? CREASE_START : (k == 1 ? first : second);
    uint end = k == turns ? CREASE_END : (k == 0 ? first : second);
    if (k >= 2 || (k == 1 && first == CREASE_OWN_TURN))
        own_back = own_back != own_turns;
    if (k >= 2 || (k == 1 && first == CREASE_OTHER_TURN))
        other_back = other_back != other_turns;
    // The half-edge has its own face to its left.
    CreasePart part = CreasePart(k <= turns && own_back != other_back, own_back, own_back ? begin : end, own_back ? end : begin);
    return part;
}
