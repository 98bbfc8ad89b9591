# Toolchain file for 64-bit ARM with Debian's cross compiler, programs run by qemu. BODICE_ARM64_PACKAGES is a folder
# with Debian's arm64 packages unpacked in it; tests/arm64/run makes one, and states how all of it is used.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES BODICE_ARM64_PACKAGES)
if(NOT BODICE_ARM64_PACKAGES)
  set(BODICE_ARM64_PACKAGES "${CMAKE_SOURCE_DIR}/build/arm64-packages")
endif()
set(libraries "${BODICE_ARM64_PACKAGES}/usr/lib/aarch64-linux-gnu")
set(CMAKE_FIND_ROOT_PATH "${BODICE_ARM64_PACKAGES}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Libraries that others of them need are there as well.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,-rpath-link,${libraries}")
set(CMAKE_SHARED_LINKER_FLAGS_INIT "-Wl,-rpath-link,${libraries}")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu -E "LD_LIBRARY_PATH=${libraries}")
