#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace limn {

/// Allocates large arrays in pages of 2 MiB where the system grants them: arrays that are read here and there would spend much of
/// their time on the translation of addresses otherwise. Small ones are allocated as usual.
template <class T> class HugePageAllocator {
public:
    using value_type = T;

    HugePageAllocator() = default;
    template <class U> HugePageAllocator(const HugePageAllocator<U>&) {}

    T* allocate(std::size_t n)
    {
        if (n > (std::size_t(-1) - page) / sizeof(T))
            throw std::bad_alloc();
        const std::size_t bytes = (n * sizeof(T) + page - 1) / page * page;
        void* memory = is_large(n) ? std::aligned_alloc(page, bytes) : std::malloc(n * sizeof(T));
        if (!memory)
            throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
        if (is_large(n))
            madvise(memory, bytes, MADV_HUGEPAGE); // a hint: ordinary pages do as well
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) { std::free(memory); }

    friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }

private:
    static constexpr std::size_t page = std::size_t(1) << 21;
    static bool is_large(std::size_t n) { return n * sizeof(T) >= page; }
};

/// A vector for arrays of many megabytes.
template <class T> using HugePageVector = std::vector<T, HugePageAllocator<T>>;

} // namespace limn
