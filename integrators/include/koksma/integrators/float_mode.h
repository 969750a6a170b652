#pragma once
// The host's floating-point state is the host's: a task sets what it needs and puts back what it found.

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace koksma {

/// Flush-to-zero and denormals-are-zero while alive: Embree asks for them, and no result may depend on the worker.
class FlushDenormals {
public:
#if defined(__SSE__)
    FlushDenormals() noexcept : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
    ~FlushDenormals() { _mm_setcsr(saved_); }
#else
    FlushDenormals() noexcept = default;
#endif
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    [[maybe_unused]] unsigned saved_ = 0;
};

}  // namespace koksma
