// The version and the build of the library, for programs.
#include <cstdio>

#include <bodice.h>

namespace bodice::inline v0_1::collision {
/// The instruction set in use, declared as in the private simd/dispatch/kernels.hpp, with headers that it
/// needs.
const char* kernel_target();
}  // namespace bodice::collision

#define BODICE_TEXT_(x) #x
#define BODICE_TEXT(x) BODICE_TEXT_(x)

uint32_t bodice_version(void) {
  return BODICE_VERSION;
}

const char* bodice_build(void) {
  struct Line {
    char text[256];
    Line() {
      const char* compiler =
#if defined(__clang__)
          "clang " BODICE_TEXT(__clang_major__);
#elif defined(__GNUC__)
          "gcc " BODICE_TEXT(__GNUC__) "." BODICE_TEXT(__GNUC_MINOR__);
#else
          "another compiler";
#endif
      const char* checks =
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
          "sanitizers";
#elif defined(NDEBUG)
          "no assertions";
#else
          "assertions";
#endif
      std::snprintf(text, sizeof text, "bodice %d.%d.%d, ABI %d, %s, %d-bit, %s, kernels %s",
                    BODICE_VERSION >> 16, BODICE_VERSION >> 8 & 0xff, BODICE_VERSION & 0xff, BODICE_ABI,
                    compiler, static_cast<int>(8 * sizeof(void*)), checks,
                    bodice::collision::kernel_target());
    }
  };
  static const Line line;
  return line.text;
}
