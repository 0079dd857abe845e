# SPDX-License-Identifier: Apache-2.0
# 64-bit ARM Linux: any ARMv8-A, for example a Cortex-A53 or A72.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(cross_triple aarch64-linux-gnu)
set(cross_arch arm64)
set(cross_qemu qemu-aarch64)
# Atomics in line: the cycle needs no helper of libgcc that asks at run time what the CPU can.
set(CMAKE_CXX_FLAGS_INIT "-mno-outline-atomics")
include(${CMAKE_CURRENT_LIST_DIR}/linux_cross.cmake)
