# A project that embeds bodice and has no build type is warned: it would be compiled without optimization.
function(configure name wanted)
  file(WRITE "${SCRATCH}/${name}/CMakeLists.txt"
       "cmake_minimum_required(VERSION 3.25)\nproject(parent LANGUAGES CXX)\nadd_subdirectory(\"${SOURCE}\" bodice)\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -S "${SCRATCH}/${name}" -B "${SCRATCH}/${name}/build" -G "${GENERATOR}"
                  "-DCMAKE_CXX_COMPILER=${COMPILER}" ${ARGN}
                  OUTPUT_QUIET ERROR_VARIABLE out COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "[ \n]+" " " out "${out}")
  set(warned OFF)
  if(out MATCHES "CMAKE_BUILD_TYPE is empty, so that nothing is optimized")
    set(warned ON)
  endif()
  if(NOT warned STREQUAL wanted)
    message(SEND_ERROR "`${ARGN}`: is warned ${warned}, should be ${wanted}:\n${out}")
  endif()
endfunction()
configure(without ON)
configure(with OFF -DCMAKE_BUILD_TYPE=Release)
