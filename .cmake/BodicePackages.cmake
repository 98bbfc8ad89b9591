# Debian packages of what is installed: `cpack -G DEB` in the build folder.
#   libbodice      the shared library of the C interface, for programs that use it
#   libbodice-dev  headers, the layers as static libraries, files for CMake and pkg-config
#   python3-bodice the Python package, over libbodice
#   bodice         the program
set(CPACK_PACKAGE_NAME bodice)
set(CPACK_PACKAGE_CONTACT "the authors of bodice <bodice@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libbodice)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libbodice-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libbodice (= ${PROJECT_VERSION})")
# What the static libraries of the layers need besides; the C interface needs none of it.
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libeigen3-dev, libtbb-dev, libspdlog-dev, libhwy-dev, libassimp-dev, libpng-dev")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)  # the loader's cache learns of libbodice
if(TARGET bodice_c)
  # Where Debian's python3 looks; `cmake --install` leaves it out, since no other Python does.
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/modules/capi/python/bodice" DESTINATION lib/python3/dist-packages
          COMPONENT python EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed"
          PATTERN "__pycache__" EXCLUDE)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-bodice)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.9), python3-numpy, libbodice (>= ${PROJECT_VERSION})")
endif()
if(TARGET bodice_cli)
  list(APPEND CPACK_COMPONENTS_ALL program)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME bodice)
endif()
set(CPACK_BODICE_KERNELS_FOR_HOST ${BODICE_KERNELS_FOR_HOST})
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_SOURCE_DIR}/.cmake/kernels_for_host.cmake")
include(CPack)
