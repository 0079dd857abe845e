// SPDX-License-Identifier: Apache-2.0
#include "tests/bare_metal/machine.hpp"

namespace plumb::bare_metal {
namespace {

constexpr int kWriteText = 0x04;
constexpr int kExitExtended = 0x20;
constexpr std::uint32_t kApplicationExit = 0x20026;

void call_host(int operation, const void* argument) noexcept {
  register int r0 __asm__("r0") = operation;
  register const void* r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

}  // namespace

void write(const char* text) noexcept { call_host(kWriteText, text); }

void write(std::uint64_t number, int base) noexcept {
  char digits[65];
  char* first = digits + 64;
  *first = '\0';
  const auto radix = static_cast<std::uint64_t>(base);
  do {
    *--first = "0123456789abcdef"[number % radix];
    number /= radix;
  } while (number != 0);
  write(first);
}

void leave(int status) noexcept {
  const std::uint32_t reason[] = {kApplicationExit, static_cast<std::uint32_t>(status)};
  call_host(kExitExtended, reason);
  for (;;) {
  }
}

}  // namespace plumb::bare_metal
