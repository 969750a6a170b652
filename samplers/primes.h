#pragma once
// The first 1024 primes, the bases of the Halton sequence.

#include <array>
#include <cstddef>
#include <cstdint>

namespace koksma {

inline constexpr std::size_t kPrimeCount = 1024;

namespace detail {
[[nodiscard]] constexpr std::array<std::uint16_t, kPrimeCount> make_primes() {
    constexpr std::uint32_t kEnd = 8162;  // 8161 is prime number 1024
    std::array<bool, kEnd> composite{};
    std::array<std::uint16_t, kPrimeCount> primes{};
    std::size_t count = 0;
    for (std::uint32_t p = 2; p < kEnd; ++p) {
        if (composite[p]) continue;
        primes[count++] = static_cast<std::uint16_t>(p);
        for (std::uint32_t q = p * p; q < kEnd; q += p) composite[q] = true;
    }
    return primes;
}
}  // namespace detail

inline constexpr std::array<std::uint16_t, kPrimeCount> kPrimes = detail::make_primes();
static_assert(kPrimes.front() == 2 && kPrimes.back() == 8161);

}  // namespace koksma
