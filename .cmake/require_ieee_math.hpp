// Included ahead of every file of bodice by the build: certificates and determinism need IEEE arithmetic, and
// flags that give it up can reach a file on more roads than CMake can see.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "bodice is being compiled with -ffast-math or a part of it: remove that flag for its folder"
#endif
