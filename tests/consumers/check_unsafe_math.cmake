# Flags that give up IEEE arithmetic must stop a build: at configuring where CMake can see them, else at compiling.
set(header "${SOURCE}/.cmake/require_ieee_math.hpp")
function(compile expected)
  execute_process(COMMAND "${COMPILER}" ${ARGN} -include "${header}" -x c++ -fsyntax-only /dev/null
                  RESULT_VARIABLE failed ERROR_VARIABLE why)
  if(expected STREQUAL "passes" AND failed)
    message(SEND_ERROR "${ARGN} does not compile:\n${why}")
  elseif(expected STREQUAL "fails" AND NOT why MATCHES "bodice is being compiled with")
    message(SEND_ERROR "${ARGN} is let through")
  endif()
endfunction()
compile(passes -O3)
compile(passes -O3 -fno-math-errno -fno-trapping-math)
compile(fails -O3 -ffast-math)
compile(fails -O3 -ffinite-math-only)

function(configure_must_fail name before_ours)
  file(WRITE "${SCRATCH}/${name}/CMakeLists.txt"
       "cmake_minimum_required(VERSION 3.25)\nproject(parent LANGUAGES CXX)\n${before_ours}\n"
       "add_subdirectory(\"${SOURCE}\" bodice)\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -S "${SCRATCH}/${name}" -B "${SCRATCH}/${name}/build" -G "${GENERATOR}"
                  "-DCMAKE_CXX_COMPILER=${COMPILER}" -DCMAKE_BUILD_TYPE=Release
                  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE why)
  if(NOT why MATCHES "is forbidden: remove it")
    message(SEND_ERROR "`${before_ours}` is let through by bodice:\n${why}")
  endif()
endfunction()
configure_must_fail(flags "set(CMAKE_CXX_FLAGS_RELEASE \"-O3 -ffast-math\")")
configure_must_fail(options "add_compile_options(-Ofast)")

