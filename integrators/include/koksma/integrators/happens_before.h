#pragma once
// Tells ThreadSanitizer what TBB orders: its library is not instrumented, so that fork and join look like nothing. Nothing in other builds.

#if defined(__SANITIZE_THREAD__)
#define KOKSMA_TSAN 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define KOKSMA_TSAN 1
#endif
#endif

#ifdef KOKSMA_TSAN
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace koksma {

/// What was written before announce() is seen after await() of the same object, as the caller knows from elsewhere.
class HappensBefore {
public:
    void announce() noexcept {
#ifdef KOKSMA_TSAN
        __tsan_release(&here_);
#endif
    }
    void await() noexcept {
#ifdef KOKSMA_TSAN
        __tsan_acquire(&here_);
#endif
    }

private:
    [[maybe_unused]] char here_ = 0;
};

}  // namespace koksma
