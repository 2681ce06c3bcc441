# Cross-compiles for 64-bit ARM with Debian's crossbuild-essential-arm64, against the Debian root
# MMS_SYSROOT that packaging/build_arm64.sh makes. qemu-user-static runs the build's programs.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(MMS_SYSROOT "$ENV{MMS_SYSROOT}" CACHE PATH "Debian root with the libraries for arm64")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES MMS_SYSROOT)
if(NOT EXISTS ${MMS_SYSROOT}/usr/include)
  message(FATAL_ERROR "no Debian root in MMS_SYSROOT='${MMS_SYSROOT}': see packaging/build_arm64.sh")
endif()
set(CMAKE_SYSROOT ${MMS_SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static -L ${MMS_SYSROOT})
