#include <koksma/scene/huge_pages.h>

#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace koksma::detail {

namespace {

constexpr std::size_t kPage = std::size_t{2} << 20;
/// Below, the rest of a page would be wasted.
constexpr std::size_t kLarge = kPage / 4;

}  // namespace

void* allocate_on_huge_pages(std::size_t bytes, std::size_t alignment) {
    if (bytes < kLarge) return ::operator new(bytes, std::align_val_t(alignment));
    const std::size_t whole = (bytes + kPage - 1) / kPage * kPage;
    void* p = std::aligned_alloc(kPage, whole);
    if (p == nullptr) throw std::bad_alloc();
#ifdef __linux__
    (void)madvise(p, whole, MADV_HUGEPAGE);  // a wish: where it is not granted, the pages are ordinary ones
#endif
    return p;
}

void free_on_huge_pages(void* p, std::size_t bytes, std::size_t alignment) noexcept {
    if (bytes < kLarge)
        ::operator delete(p, std::align_val_t(alignment));
    else
        std::free(p);
}

}  // namespace koksma::detail
