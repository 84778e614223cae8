#include "peak_memory.h"

#include <fstream>
#include <string>

double peak_memory()
{
    // Not getrusage's figure, which a child inherits from the process that started it.
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kilobytes = 0; word == "VmHWM:" && status >> kilobytes)
            return 1024 * kilobytes;
    return 0;
}
