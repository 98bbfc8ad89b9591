# Kernels of one processor are no packages: cpack stops with a sentence. An installation is made with a notice.
#   -DBUILD=<build folder> -DCPACK=<program> -DSCRATCH=
execute_process(COMMAND "${CPACK}" -G DEB --config "${BUILD}/CPackConfig.cmake" -B "${SCRATCH}" -D CPACK_COMPONENTS_ALL=python
                  -D CPACK_BODICE_KERNELS_FOR_HOST=ON
                RESULT_VARIABLE failed OUTPUT_VARIABLE out ERROR_VARIABLE why)
if(NOT failed OR NOT "${out}${why}" MATCHES "kernels of this processor")
  message(SEND_ERROR "cpack makes packages of kernels for one processor:\n${out}${why}")
endif()
file(STRINGS "${BUILD}/CMakeCache.txt" host REGEX "^BODICE_KERNELS_FOR_HOST:")
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD}" --component runtime --prefix "${SCRATCH}/prefix"
                OUTPUT_VARIABLE out ERROR_VARIABLE why COMMAND_ERROR_IS_FATAL ANY)
if(host MATCHES "=ON$" AND NOT "${out}${why}" MATCHES "kernels of this processor")
  message(SEND_ERROR "an installation with kernels for one processor does not say so:\n${out}${why}")
elseif(NOT host MATCHES "=ON$" AND "${out}${why}" MATCHES "kernels of this processor")
  message(SEND_ERROR "an installation with all kernels is announced as one for one processor:\n${out}${why}")
endif()
