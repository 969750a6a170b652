#pragma once
// Memory for large arrays that are read here and there: on pages of 2 MiB where the system has them on request (Linux: transparent huge
// pages, "madvise" or "always"), so that a read seldom waits for its page's address. Elsewhere and for small arrays ordinary memory.

#include <cstddef>
#include <vector>

namespace koksma {

namespace detail {

/// @throws std::bad_alloc
[[nodiscard]] void* allocate_on_huge_pages(std::size_t bytes, std::size_t alignment);
void free_on_huge_pages(void* p, std::size_t bytes, std::size_t alignment) noexcept;

}  // namespace detail

/// An allocator, for standard containers.
template <class T>
struct HugePages {
    using value_type = T;
    HugePages() = default;
    template <class U>
    HugePages(const HugePages<U>&) noexcept {}
    [[nodiscard]] T* allocate(std::size_t n) { return static_cast<T*>(detail::allocate_on_huge_pages(n * sizeof(T), alignof(T))); }
    void deallocate(T* p, std::size_t n) noexcept { detail::free_on_huge_pages(p, n * sizeof(T), alignof(T)); }
    template <class U>
    bool operator==(const HugePages<U>&) const noexcept {
        return true;
    }
};

template <class T>
using LargeVector = std::vector<T, HugePages<T>>;

}  // namespace koksma
