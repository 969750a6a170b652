# What every target of Koksma has in common: C++20, and floating point that means what it says.

# koksma_target(<target>): usage requirements of a library or program of ours
function(koksma_target target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    target_compile_features(${target} INTERFACE cxx_std_20)
    target_compile_options(${target} INTERFACE -ffp-contract=off)
    return()
  endif()
  target_compile_features(${target} PUBLIC cxx_std_20)
  # One result for one input: a compiler may neither fuse a*b+c nor reassociate (kernels and ISAs must agree bit for bit).
  target_compile_options(${target} PUBLIC -ffp-contract=off PRIVATE -fno-math-errno -fno-trapping-math)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  if(KOKSMA_MASTER)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                           $<$<BOOL:${KOKSMA_WARNINGS_AS_ERRORS}>:-Werror>)
    # GCC 12 and 13 see overlapping copies in std::string's operator+ that are not there (GCC bug 105651).
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # And members of variants that move though they are not held (GCC bug 80635).
      target_compile_options(${target} PRIVATE -Wno-restrict -Wno-maybe-uninitialized)
    endif()
  endif()
endfunction()
