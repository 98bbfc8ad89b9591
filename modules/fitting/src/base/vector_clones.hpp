// BODICE_CLONES compiles a function for several instruction sets; the best one is chosen when the program
// starts. Loops in it must not call functions compiled under other flags, which would not be inlined.
#pragma once

// GCC 12 vectorizes these loops only with -fno-math-errno and -fno-trapping-math. modules/CMakeLists.txt sets
// them for this layer, because clones ignore them as a pragma or an attribute.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define BODICE_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define BODICE_CLONES
#endif
