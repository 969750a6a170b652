// How shared maths is written: once as text, compiled as ordinary functions, and again for each instruction set.
//
// A header of shared maths looks like this (a toggle instead of #pragma once, after Google Highway's foreach_target):
//
//     #include <koksma/simd/maths.h>
//     #if defined(KOKSMA_FOO_H) == defined(KOKSMA_MATHS_TOGGLE)
//     #ifdef KOKSMA_FOO_H
//     #undef KOKSMA_FOO_H
//     #else
//     #define KOKSMA_FOO_H
//     #endif
//     KOKSMA_MATHS_BEGIN
//     template <class Real> Real twice(Real x) { return x + x; }
//     KOKSMA_MATHS_END
//     #endif
//
// and is listed in koksma/scene/all_maths.h. Seen from an ordinary source file it declares koksma::twice. A source file that wants packs
// begins with
//
//     #include <ordinary headers>
//     #define KOKSMA_SHARED_MATHS <koksma/scene/all_maths.h>
//     #undef HWY_TARGET_INCLUDE
//     #define HWY_TARGET_INCLUDE "this/file.cpp"
//     #include <koksma/simd/each_target.h>
//
// and everything after that is compiled once for each instruction set, with koksma::N_AVX2::twice and so on beside koksma::twice.

//
// GCC compiles implicit constructors, and friends defined in class templates, without the instruction set: members of shared
// structs have `{}` (zero) as their only default, and operators are free functions.

#include <koksma/simd/scalar.h>

#ifndef KOKSMA_MATHS_BEGIN
#define KOKSMA_MATHS_BEGIN namespace koksma {
#define KOKSMA_MATHS_END }
/// Text that only ordinary source files see: aliases for float, constants, functions of plain numbers.
#define KOKSMA_ORDINARY 1
#endif
