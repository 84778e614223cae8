// Included where `uint last_of_run(const uint i)` tells the rank of the last map of a run; so it has no guard against a second time.

// The run that holds a map, among those of [first, end), whose last ranks rise and reach it: in as many steps as their number has binary digits.
FORMULA uint run_of_rank(const uint first, const uint end, const uint rank)
{
    uint low = first;
    uint high = end - 1u;
    while (low < high) {
        uint middle = (low + high) >> 1u;
        if (last_of_run(middle) >= rank)
            high = middle;
        else
            low = middle + 1u;
    }
    return low;
}
