# SPDX-License-Identifier: Apache-2.0
# 64-bit Windows: Debian's MinGW-w64, and wine to run what was built. The libraries of the compiler are linked into each
# program and DLL, so that these need nothing that Windows does not have.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(cross_triple x86_64-w64-mingw32)
set(CMAKE_C_COMPILER ${cross_triple}-gcc-posix)
set(CMAKE_CXX_COMPILER ${cross_triple}-g++-posix)
set(CMAKE_RC_COMPILER ${cross_triple}-windres)

# Of the host's packages only what is headers alone may be seen: flatbuffers through a folder of its own, for beside it
# lie the headers of Linux; Eigen by its package.
set(cross_headers ${CMAKE_CURRENT_LIST_DIR}/../../build/headers-mingw64)
file(MAKE_DIRECTORY ${cross_headers}/include)
if(NOT EXISTS ${cross_headers}/include/flatbuffers)
  file(CREATE_LINK /usr/include/flatbuffers ${cross_headers}/include/flatbuffers SYMBOLIC)
endif()
set(CMAKE_FIND_ROOT_PATH ${cross_headers} /usr/${cross_triple})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)

set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
set(CMAKE_SHARED_LINKER_FLAGS_INIT "-static")
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
