// Replaces the program's operator new: arrays of megabytes come in pages of 2 MiB where the system grants them. A run over a
// large model touches most of its memory once, and in pages of 4 KiB a third of its time goes into the kernel's page faults.

#include <cstdlib>
#include <new>

#include <malloc.h>
#include <sys/mman.h>

namespace {

constexpr std::size_t page = std::size_t(1) << 21;

/// Arrays from 8 MiB on go back to the system when they are freed, smaller ones stay for the next view of a turntable. The
/// allocator's own limit would grow with what was freed, and a large model would take a third more memory.
[[maybe_unused]] const bool tuned = [] { return mallopt(M_MMAP_THRESHOLD, 8 << 20) == 1 && mallopt(M_TRIM_THRESHOLD, 32 << 20) == 1; }();

void* allocate(std::size_t bytes)
{
    if (bytes < page)
        return std::malloc(bytes > 0 ? bytes : 1);
    if (bytes > std::size_t(-1) - page)
        return nullptr;
    const std::size_t whole = (bytes + page - 1) / page * page;
    void* memory = std::aligned_alloc(page, whole);
    if (memory)
        madvise(memory, whole, MADV_HUGEPAGE); // a hint: ordinary pages do as well
    return memory;
}

} // namespace

void* operator new(std::size_t bytes)
{
    for (;;) {
        if (void* memory = allocate(bytes))
            return memory;
        const std::new_handler handler = std::get_new_handler();
        if (!handler)
            throw std::bad_alloc();
        handler();
    }
}

void* operator new[](std::size_t bytes) { return operator new(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
