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
  set(variables options CMAKE_CXX_FLAGS ${configs})
  foreach(variable IN LISTS variables)
    if("${${variable}}" MATCHES "-(ffast-math|Ofast|ffinite-math-only|fassociative-math|funsafe-math-optimizations)")
      string(REPLACE "options" "add_compile_options" variable "${variable}")
      message(FATAL_ERROR "bodice: ${CMAKE_MATCH_0} is forbidden: remove it from ${variable}. "
                          "Certificates and determinism need IEEE arithmetic.")
    endif()
  endforeach()
endfunction()

# Half of a small file's compile time goes into Eigen and the standard library. Our own build reads them once, as
# precompiled headers. Compiler caches pass over files that use one, so a compiler launcher switches them off, and
# so do sanitizers: their builds then show that each file includes what it uses.
set(precompile OFF)
if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CXX_COMPILER_LAUNCHER
   AND NOT BODICE_SANITIZE)
  set(precompile ON)
endif()
option(BODICE_PRECOMPILE "Precompile heavy headers (our own build with g++)" ${precompile})

# bodice_precompile(<target> [FROM <other>] [AND <headers...>]): precompiles what most files include, and these headers, or
# takes what <other> has precompiled with the same flags. Where there is no <other>, nothing is precompiled.
function(bodice_precompile target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FROM" "AND")
  if(NOT BODICE_PRECOMPILE OR (arg_FROM AND NOT TARGET ${arg_FROM}))
    return()
  endif()
  # A compiler takes a precompiled header only before any other file, so this one brings the guard along.
  set_target_properties(${target} PROPERTIES BODICE_GUARD_IS_PRECOMPILED ON)
  if(arg_FROM)
    target_precompile_headers(${target} REUSE_FROM ${arg_FROM})
    return()
  endif()
  target_precompile_headers(${target} PRIVATE "${PROJECT_SOURCE_DIR}/.cmake/require_ieee_math.hpp"
    <Eigen/Geometry> <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <memory> <numeric>
    <optional> <span> <sstream> <string> <string_view> <unordered_map> <utility> <vector> ${arg_AND})
endfunction()

# Most of a small file's compile time goes into headers and templates that its neighbors need as well. As one file, a
# folder of sources takes less than half the processor time (geodesic: 14 s alone, 6 s together). A changed file then
# compiles with all its neighbors, and no longer shows that it includes what it uses: with a compiler launcher, which
# makes small files cheap, each file stands alone, and a weekly command builds so (CONTRIBUTING.md).
set(unity OFF)
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(unity ON)
endif()
option(BODICE_UNITY "Compile each folder of sources as one file (our own build)" ${unity})

# bodice_unite(<target> <root> [TOGETHER] <sources...>): compiles the sources of each folder below root, and of the folders
# in it, as one file; TOGETHER, where names of no two folders meet: all of them. Kernels stay alone, since they are compiled
# once for each instruction set. So does what needs oneTBB or spdlog: in one object with the rest of the engine it would
# make libbodice_frame need them, too. JSON would be part of every program.
function(bodice_unite target root)
  cmake_parse_arguments(PARSE_ARGV 2 arg "TOGETHER" "" "")
  if(NOT BODICE_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS arg_UNPARSED_ARGUMENTS)
    if(source MATCHES "/kernels[a-z0-9_]*[.]cpp$|/(tbb_executor|log_sinks|json(_text)?)[.]cpp$")
      continue()
    endif()
    set(folder "")
    if(NOT arg_TOGETHER)
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${root}" OUTPUT_VARIABLE folder)
      cmake_path(GET folder PARENT_PATH folder)
      string(REGEX REPLACE "/.*" "" folder "${folder}")
    endif()
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${target}_${folder}")
  endforeach()
endfunction()

# bodice_unite_program(<target> [<files>]): the same for a test or a bench, all files of which are one program; with a number, so
# many files at a time.
function(bodice_unite_program target)
  if(NOT BODICE_UNITY)
    return()
  endif()
  set(files 0)
  if(ARGC GREATER 1)
    set(files ${ARGV1})
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${files})
endfunction()

# Warnings and sanitizers live on a target that is linked PRIVATE and never
# exported, so that none of them reaches a project that embeds bodice.
function(bodice_define_build_flags)
  add_library(bodice_build_flags INTERFACE)
  set(include_first $<IF:$<CXX_COMPILER_ID:MSVC>,/FI,-include>)
  set(guard "SHELL:${include_first} \"${PROJECT_SOURCE_DIR}/.cmake/require_ieee_math.hpp\"")
  target_compile_options(bodice_build_flags INTERFACE
    "$<$<NOT:$<BOOL:$<TARGET_PROPERTY:BODICE_GUARD_IS_PRECOMPILED>>>:${guard}>")
  # x86 code is for processors without fused multiply-add, apart from kernels, which ask for it. ARM and WebAssembly
  # compilers would fuse whatever they can, and fits would differ from machine to machine.
  if((EMSCRIPTEN OR CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64|ARM64)$") AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(bodice_build_flags INTERFACE -ffp-contract=off)
  endif()
  if(EMSCRIPTEN)
    set(older_libcxx "SHELL:-include \"${PROJECT_SOURCE_DIR}/modules/capi/web/older_libcxx.hpp\"")
    target_compile_options(bodice_build_flags INTERFACE "${older_libcxx}" -fexceptions)
    option(BODICE_WEB_VECTORS "WebAssembly with vectors (SIMD128)" ON)
    if(BODICE_WEB_VECTORS)
      target_compile_options(bodice_build_flags INTERFACE -msimd128)
    endif()
  endif()
  if(NOT PROJECT_IS_TOP_LEVEL)
    return()
  endif()
  set(warnings -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wdouble-promotion
      -Wno-missing-field-initializers)  # designated initializers leave the rest at their defaults on purpose
  target_compile_options(bodice_build_flags INTERFACE
    "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:${warnings}>"
    # g++ 12 sees overlapping copies in `"text" + std::string` that are not there (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    # clang takes `double{f}` for an implicit promotion, although it is written out.
    $<$<CXX_COMPILER_ID:Clang,AppleClang>:-Wno-double-promotion>)
  if(BODICE_PRECOMPILE)
    target_compile_options(bodice_build_flags INTERFACE -Wno-stringop-overflow -Wno-array-bounds)
  endif()
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64|ARM64)$" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # g++ 10.1 changed how pairs are passed there, and notes each of them. No older binary is linked.
    target_compile_options(bodice_build_flags INTERFACE -Wno-psabi)
  endif()
  if(BODICE_WARNINGS_AS_ERRORS)
    target_compile_options(bodice_build_flags INTERFACE -Werror)
  endif()
  if(BODICE_SANITIZE)
    target_compile_options(bodice_build_flags INTERFACE
      -fsanitize=${BODICE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
      -fno-sanitize=null,object-size  # AddressSanitizer finds these, too; each check of a pointer costs compiling
      -g1)  # lines for the reports; tracking variables through the kernels takes g++ a quarter of an hour
    target_link_options(bodice_build_flags INTERFACE -fsanitize=${BODICE_SANITIZE})
  endif()
endfunction()
