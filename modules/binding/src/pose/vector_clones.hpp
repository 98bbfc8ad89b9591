// One function compiled for several instruction sets, the best one chosen when the program starts. Loops that
// are to become vector code must not call functions compiled under other flags (they would not be inlined).
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define BODICE_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define BODICE_CLONES
#endif
