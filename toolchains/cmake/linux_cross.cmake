# SPDX-License-Identifier: Apache-2.0
# Shared by the Linux targets: Debian's cross compiler, the packages that toolchains/sysroot has
# unpacked, and qemu to run what was built. Set before: cross_triple, cross_arch (Debian's), cross_qemu.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${cross_triple}-gcc)
set(CMAKE_CXX_COMPILER ${cross_triple}-g++)
set(CMAKE_LIBRARY_ARCHITECTURE ${cross_triple})

get_filename_component(cross_root "${CMAKE_CURRENT_LIST_DIR}/../../build/sysroot-${cross_arch}" ABSOLUTE)
if(NOT EXISTS ${cross_root}/.packages)
  message(FATAL_ERROR "no packages for ${cross_arch}: run toolchains/sysroot ${cross_arch}")
endif()
set(CMAKE_FIND_ROOT_PATH ${cross_root} /usr/${cross_triple})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} ${cross_root}/usr/lib/${cross_triple}/pkgconfig:${cross_root}/usr/share/pkgconfig)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${cross_root})

# Headers that differ between machines, such as a part of OpenSSL's.
string(APPEND CMAKE_C_FLAGS_INIT " -isystem ${cross_root}/usr/include/${cross_triple}")
string(APPEND CMAKE_CXX_FLAGS_INIT " -isystem ${cross_root}/usr/include/${cross_triple}")

set(cross_libraries ${cross_root}/usr/lib/${cross_triple})
set(CMAKE_EXE_LINKER_FLAGS_INIT "-L${cross_libraries} -Wl,-rpath-link,${cross_libraries}")
set(CMAKE_CROSSCOMPILING_EMULATOR
    "${cross_qemu};-L;/usr/${cross_triple};-E;LD_LIBRARY_PATH=${cross_libraries}:/usr/${cross_triple}/lib")
