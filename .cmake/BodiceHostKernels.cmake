# Kernels of collision are a fifth of a first build, and a machine runs those of one instruction set.
option(BODICE_KERNELS_FOR_HOST "Compile kernels for this processor: those of other processors are scalar and slow" OFF)

# bodice_find_host_kernels(<out>): sets out to the instruction set that this machine's kernels have, as Highway names
# it, or to nothing where kernels are compiled for all processors.
function(bodice_find_host_kernels out)
  set(${out} "" PARENT_SCOPE)
  if(NOT BODICE_KERNELS_FOR_HOST OR CMAKE_CROSSCOMPILING)
    return()
  endif()
  try_run(ran compiled "${PROJECT_BINARY_DIR}/host_kernels" "${PROJECT_SOURCE_DIR}/.cmake/host_kernels.cpp"
    LINK_LIBRARIES hwy::hwy
    RUN_OUTPUT_VARIABLE name)
  if(compiled AND ran EQUAL 0)
    string(STRIP "${name}" name)
    set(${out} "${name}" PARENT_SCOPE)
  endif()
endfunction()
