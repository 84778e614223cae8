// Opens a context and says which; for tests that take the driver away.
#include <cstdio>

#include "limn/base/error.h"
#include "limn/gpu/context.h"

int main()
{
    try {
        const limn::gpu::Context context;
        std::printf("%s\n", context.info().renderer.c_str());
        return 0;
    } catch (const limn::Error& error) {
        std::printf("%s\n", error.what());
        return 1;
    }
}
