// The frame side of bodice, all of it: proxies, poses, queries, responses. Made by modules/capi/amalgamation
// from the sources of bodice (MIT license) and the headers of Eigen 3.4 that they use (MPL 2.0,
// http://mozilla.org/MPL/2.0/).
//     c++ -std=c++20 -O2 -c bodice_frame.cpp
#if !defined(__cplusplus) || (__cplusplus < 202002L && !defined(_MSC_VER))
#error "bodice_frame.cpp needs C++20: compile it with -std=c++20"
#endif
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "bodice_frame.cpp is being compiled with -ffast-math or a part of it: remove that flag for this file"
#endif
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are parameters inside of this file alone
#endif
#include "bodice_frame.h"

#define EIGEN_DONT_VECTORIZE
#define EIGEN_NO_DEBUG
#define EIGEN_MPL2_ONLY
// A program that has an Eigen of its own does not meet this one.
#define Eigen bodice_eigen

#ifdef BODICE_WITH_JSON  // proxies may be JSON, too, by the library nlohmann/json
#include <nlohmann/json.hpp>
#endif

#if __has_include(<hwy/highway.h>) && !defined(BODICE_NO_HIGHWAY)
#define HWY_COMPILE_ONLY_STATIC
#define HWY_BROKEN_EMU128 1
// Unoptimized and under sanitizers Highway's assertions would need its library, which need not be here.
#ifndef HWY_IS_DEBUG_BUILD
#define HWY_IS_DEBUG_BUILD 0
#endif
#include <hwy/cache_control.h>
#include <hwy/highway.h>
// There is one instruction set, and so nothing to choose at run time.
#undef HWY_EXPORT
#undef HWY_DYNAMIC_DISPATCH
#define HWY_EXPORT(function) static_assert(true, "")
#define HWY_DYNAMIC_DISPATCH(function) HWY_STATIC_DISPATCH(function)
#else
