# SPDX-License-Identifier: Apache-2.0
# Bare metal on a Cortex-M7 with the double-precision FPU. Programs run on qemu's mps2-an500, where an instruction
# takes 128 ns of virtual time, three ticks of its clock, so that they can be counted one by one.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m7)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

string(CONCAT CMAKE_CXX_FLAGS_INIT
  "-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard -ffunction-sections -fdata-sections "
  "-fno-threadsafe-statics -fno-use-cxa-atexit -Wno-psabi")
set(CMAKE_EXE_LINKER_FLAGS_INIT
    "-nostartfiles -Wl,--gc-sections -Wl,--no-warn-rwx-segments -T${CMAKE_CURRENT_LIST_DIR}/../mps2_an500.ld")
set(CMAKE_CROSSCOMPILING_EMULATOR
    qemu-system-arm -M mps2-an500 -icount shift=7 -display none -monitor none -serial none -no-reboot
    -semihosting-config enable=on,target=native -kernel)

# Headers without code are the host's. Flatbuffers' stand next to the host's libc, so only they are
# let in, by a link.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/headers)
file(CREATE_LINK /usr/include/flatbuffers ${CMAKE_BINARY_DIR}/headers/flatbuffers SYMBOLIC)
set(FLATBUFFERS_INCLUDE ${CMAKE_BINARY_DIR}/headers)
