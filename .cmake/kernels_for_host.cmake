# A notice of `cmake --install`, and a reason for `cpack` to stop: kernels of one processor are slow on others.
set(sentence "bodice: these libraries have kernels of this processor alone, and are slow on others")
if(CPACK_BODICE_KERNELS_FOR_HOST)
  message(FATAL_ERROR "${sentence}: configure with -DBODICE_KERNELS_FOR_HOST=OFF and build, then make packages.")
elseif(BODICE_KERNELS_FOR_HOST)
  message(NOTICE "${sentence}: configure with -DBODICE_KERNELS_FOR_HOST=OFF for all.")
endif()
