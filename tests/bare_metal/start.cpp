// SPDX-License-Identifier: Apache-2.0
// From reset to the program: FPU on, memory as the linker script says, static constructors.
#include <cstdint>

#include "tests/bare_metal/machine.hpp"

extern "C" {
extern std::uint32_t data_begin, data_end, data_source, bss_begin, bss_end, stack_top;
using Constructor = void (*)();
extern Constructor init_begin, init_end;

[[noreturn]] void fault() {
  plumb::bare_metal::write("fault\n");
  plumb::bare_metal::leave(plumb::bare_metal::kFault);
}

[[noreturn]] void reset() {
  auto* const coprocessor_access = reinterpret_cast<volatile std::uint32_t*>(0xE000ED88);
  *coprocessor_access = *coprocessor_access | (0xFU << 20);
  __asm__ volatile("dsb\n isb");
  const std::uint32_t* from = &data_source;
  for (std::uint32_t* to = &data_begin; to < &data_end;) *to++ = *from++;
  for (std::uint32_t* to = &bss_begin; to < &bss_end;) *to++ = 0;
  for (const Constructor* next = &init_begin; next < &init_end; ++next) (*next)();
  plumb::bare_metal::leave(plumb::bare_metal::run_program());
}
}

union Vector {
  const void* stack;
  void (*handler)();
};
// Stack, reset, NMI, hard fault, memory, bus and usage fault.
[[gnu::section(".vectors"), gnu::used]] const Vector vectors[] = {
    {.stack = &stack_top}, {.handler = reset}, {.handler = fault}, {.handler = fault},
    {.handler = fault},    {.handler = fault}, {.handler = fault}};
