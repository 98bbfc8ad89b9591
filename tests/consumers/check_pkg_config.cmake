cmake_minimum_required(VERSION 3.25)
# A C90 program is compiled by what pkg-config prints, and run: from a copy of the installation, which stands elsewhere,
# and from one with libraries a folder deeper, as Debian's do.
#   -DPREFIX=<where bodice is installed> -DLIBDIR=<CMAKE_INSTALL_LIBDIR of it> -DCAPI=modules/capi -DPROGRAM=<.c>
#   -DVERSION= -DCOMPILER=<C> -DFLAGS= -DSCRATCH=
find_program(pkg_config pkg-config)
if(NOT pkg_config)
  message(STATUS "skipped: pkg-config is not installed")
  return()
endif()
include("${CAPI}/pkg_config.cmake")
set(PROJECT_VERSION "${VERSION}")
set(CMAKE_INSTALL_INCLUDEDIR include)
file(REMOVE_RECURSE "${SCRATCH}")
file(GLOB libraries "${PREFIX}/${LIBDIR}/libbodice_frame.so*")
foreach(CMAKE_INSTALL_LIBDIR IN ITEMS "${LIBDIR}" lib/x86_64-linux-gnu)
  string(MAKE_C_IDENTIFIER "${CMAKE_INSTALL_LIBDIR}" name)
  set(root "${SCRATCH}/${name}")
  set(lib "${root}/${CMAKE_INSTALL_LIBDIR}")
  file(COPY "${PREFIX}/include" DESTINATION "${root}")
  file(COPY ${libraries} DESTINATION "${lib}")
  if(CMAKE_INSTALL_LIBDIR STREQUAL LIBDIR)
    file(COPY "${PREFIX}/${LIBDIR}/pkgconfig/bodice_frame.pc" DESTINATION "${lib}/pkgconfig")
  else()
    bodice_write_pc("${lib}/pkgconfig/bodice_frame.pc" bodice_frame)
  endif()
  set(ENV{PKG_CONFIG_LIBDIR} "${lib}/pkgconfig")  # nothing else is found
  execute_process(COMMAND "${pkg_config}" --cflags --libs bodice_frame OUTPUT_VARIABLE flags
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(options UNIX_COMMAND "${FLAGS} ${flags}")
  execute_process(COMMAND "${COMPILER}" -std=c90 -pedantic -Wall -Wextra -Werror "${PROGRAM}" ${options} -lm
                    "-Wl,-rpath,${lib}" -o "${root}/program" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${root}/program" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${pkg_config}" --modversion bodice_frame OUTPUT_VARIABLE version
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  if(NOT version STREQUAL VERSION)
    message(SEND_ERROR "pkg-config states version ${version} instead of ${VERSION}")
  endif()
endforeach()
