// Where a cell of a grid of directions is in the order of its maps (the coherent shadow map specification, 2.6). x is the cell along theta, y along
// phi; ranks count from 0.
#pragma once

const int THETA_ZIGZAG = 0; // along theta at each phi, to and fro
const int THETA_LINEAR = 1; // along theta at each phi, always from the upper pole
const int PHI_ZIGZAG = 2;
const int PHI_LINEAR = 3;
const int HILBERT_CURVE = 4; // square grids of 2^k cells along a side

FORMULA uint swept_rank(const int along, const int at, const int length_along, const bool zigzag)
{
    int turned = zigzag && (at & 1) == 1 ? length_along - 1 - along : along;
    return uint(at) * uint(length_along) + uint(turned);
}

// Hilbert's curve in the plane (Skilling 2004, "Programming the Hilbert curve").
FORMULA uint hilbert_rank(const uint side, const ivec2 cell)
{
    uint x = uint(cell.x);
    uint y = uint(cell.y);
    for (uint bit = side >> 1u; bit > 1u; bit = bit >> 1u) {
        uint below = bit - 1u;
        if ((x & bit) != 0u)
            x = x ^ below;
        if ((y & bit) != 0u) {
            x = x ^ below;
        } else {
            uint exchanged = (x ^ y) & below;
            x = x ^ exchanged;
            y = y ^ exchanged;
        }
    }
    y = y ^ x;
    uint turned = 0u;
    for (uint bit = side >> 1u; bit > 1u; bit = bit >> 1u)
        if ((y & bit) != 0u)
            turned = turned ^ (bit - 1u);
    x = x ^ turned;
    y = y ^ turned;
    uint rank = 0u;
    for (uint bit = side >> 1u; bit > 0u; bit = bit >> 1u)
        rank = (rank << 2u) | ((x & bit) != 0u ? 2u : 0u) | ((y & bit) != 0u ? 1u : 0u);
    return rank;
}

FORMULA uint rank_of_cell(const int order, const ivec2 cells, const ivec2 cell)
{
    if (order == HILBERT_CURVE)
        return hilbert_rank(uint(cells.x), cell);
    if (order == PHI_ZIGZAG || order == PHI_LINEAR)
        return swept_rank(cell.y, cell.x, cells.y, order == PHI_ZIGZAG);
    return swept_rank(cell.x, cell.y, cells.x, order == THETA_ZIGZAG);
}
