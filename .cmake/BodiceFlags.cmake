# The flags of our own build, and those that no build may have.

option(BODICE_WARNINGS_AS_ERRORS "Fail on warnings (CI does; a newer compiler may know more of them)" OFF)
set(BODICE_SANITIZE "" CACHE STRING "Sanitizers for our own build, e.g. address,undefined or thread")

# Flags that let the compiler assume there is no NaN or Inf, or reorder sums, break the certificates of the MVEE
# solver and the determinism contract. Here they are named where they stand; what slips through (a parent's
# add_compile_options after us, the compiler's own configuration) meets require_ieee_math.hpp.
function(bodice_reject_unsafe_math_flags)
  get_directory_property(options COMPILE_OPTIONS)
  set(configs ${CMAKE_BUILD_TYPE} ${CMAKE_CONFIGURATION_TYPES})
  list(TRANSFORM configs TOUPPER)
  list(TRANSFORM configs PREPEND CMAKE_CXX_FLAGS_)
  set(places options CMAKE_CXX_FLAGS ${configs})
  foreach(place IN LISTS places)
    if("${${place}}" MATCHES "-(ffast-math|Ofast|ffinite-math-only|fassociative-math|funsafe-math-optimizations)")
      string(REPLACE "options" "add_compile_options" place "${place}")
      message(FATAL_ERROR "bodice: ${CMAKE_MATCH_0} is forbidden: remove it from ${place}. "
                          "Certificates and determinism need IEEE arithmetic.")
    endif()
  endforeach()
endfunction()

# Warnings and sanitizers live on a target that is linked PRIVATE and never
# exported, so that none of them reaches a project that embeds bodice.
function(bodice_define_build_flags)
  add_library(bodice_build_flags INTERFACE)
  set(include_first $<IF:$<CXX_COMPILER_ID:MSVC>,/FI,-include>)
  target_compile_options(bodice_build_flags INTERFACE
    "SHELL:${include_first} \"${PROJECT_SOURCE_DIR}/.cmake/require_ieee_math.hpp\"")
  if(NOT PROJECT_IS_TOP_LEVEL)
    return()
  endif()
  target_compile_options(bodice_build_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion
    -Wno-missing-field-initializers  # designated initializers leave the rest at their defaults on purpose
    # g++ 12 sees overlapping copies in `"text" + std::string` that are not there (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    # clang takes `double{f}` for a promotion that nobody asked for.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-double-promotion>)
  if(BODICE_WARNINGS_AS_ERRORS)
    target_compile_options(bodice_build_flags INTERFACE -Werror)
  endif()
  if(BODICE_SANITIZE)
    target_compile_options(bodice_build_flags INTERFACE
      -fsanitize=${BODICE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
      -g1)  # lines for the reports; tracking variables through the kernels takes g++ a quarter of an hour
    target_link_options(bodice_build_flags INTERFACE -fsanitize=${BODICE_SANITIZE})
  endif()
endfunction()
