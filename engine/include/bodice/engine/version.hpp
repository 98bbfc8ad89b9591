// The version of bodice, and what a program that includes its C++ headers is compiled with.
#pragma once

#ifdef _MSVC_LANG  // there __cplusplus may say 1997
#define BODICE_LANGUAGE _MSVC_LANG
#else
#define BODICE_LANGUAGE __cplusplus
#endif
#if BODICE_LANGUAGE < 202002L
#error \
    "The C++ headers of bodice need C++20 (-std=c++20). Programs in C or C++17 include bodice.h or bodice.hpp."
#endif
#undef BODICE_LANGUAGE

/// Major, minor and patch, eight bits each; the same as in bodice.h.
#define BODICE_VERSION 0x000100

// These flags change the layout of types that headers share with the libraries. So each state of them has a
// function of its own, and a program that was compiled otherwise than bodice does not link.
#if defined(_GLIBCXX_DEBUG) && defined(EIGEN_DEFAULT_TO_ROW_MAJOR)
#define BODICE_LAYOUT built_with_GLIBCXX_DEBUG_and_EIGEN_DEFAULT_TO_ROW_MAJOR
#elif defined(_GLIBCXX_DEBUG)
#define BODICE_LAYOUT built_with_GLIBCXX_DEBUG
#elif defined(EIGEN_DEFAULT_TO_ROW_MAJOR)
#define BODICE_LAYOUT built_with_EIGEN_DEFAULT_TO_ROW_MAJOR
#else
#define BODICE_LAYOUT built_without_GLIBCXX_DEBUG_or_EIGEN_DEFAULT_TO_ROW_MAJOR
#endif

// Two versions of bodice in one program have nothing in common, since each has its own inline namespace.
namespace bodice::inline v0_1::engine::layout {

/// Does nothing. It is there for the linker.
void BODICE_LAYOUT() noexcept;

#if defined(__GNUC__)
[[gnu::used]] static void (*const linked)() noexcept = &BODICE_LAYOUT;
#else
inline void (*const linked)() noexcept = &BODICE_LAYOUT;
#endif

}  // namespace bodice::inline v0_1::engine::layout
