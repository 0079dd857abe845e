# SPDX-License-Identifier: Apache-2.0
# 32-bit ARM Linux: ARMv7-A with NEON and VFPv4, for example a Cortex-A7 or A15. This FPU can fuse a
# multiplication and an addition, so that a build that does is seen. For a Cortex-A9: -mfpu=neon.
set(CMAKE_SYSTEM_PROCESSOR armv7)
set(cross_triple arm-linux-gnueabihf)
set(cross_arch armhf)
set(cross_qemu qemu-arm)
set(CMAKE_CXX_FLAGS_INIT "-march=armv7-a -mfpu=neon-vfpv4 -mtune=cortex-a7 -Wno-psabi")
include(${CMAKE_CURRENT_LIST_DIR}/linux_cross.cmake)
