// The linear congruential generator of the procedural structures specification, 2.10: whole numbers below 65536.
#pragma once

FORMULA uint lcg_next(const uint state)
{
    return (3125u * state + 49u) & 0xFFFFu;
}

// In [0,1).
FORMULA float lcg_unit(const uint state)
{
    return float(state) / 65536.0f;
}
