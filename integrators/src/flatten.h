#pragma once

/// Puts all that a function calls into that function. Not under the sanitizers: their checks make a piece of this size take ten minutes to compile.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define KOKSMA_FLATTEN
#else
#define KOKSMA_FLATTEN [[gnu::flatten]]
#endif
