// Sums within a work-group of 256 threads, in 16 rows of 16: few barriers, which are slow where a processor stands in for the device.
shared uint group_own[256];
shared uint group_rows[16];

/// What the threads before this one have, and what all have together. Every thread of the group has to call it.
uint sum_before(const uint own, out uint all)
{
    uint lane = gl_LocalInvocationIndex;
    group_own[lane] = own;
    barrier();
    if (lane < 16u) {
        uint row = 0u;
        for (uint k = 0u; k < 16u; ++k)
            row += group_own[16u * lane + k];
        group_rows[lane] = row;
    }
    barrier();
    uint before = 0u;
    all = 0u;
    for (uint row = 0u; row < 16u; ++row) {
        before += row < lane / 16u ? group_rows[row] : 0u;
        all += group_rows[row];
    }
    for (uint k = 16u * (lane / 16u); k < lane; ++k)
        before += group_own[k];
    return before;
}
