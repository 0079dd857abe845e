// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

/// What a program on the bare board needs of its surroundings: a debugger or emulator that answers
/// semihosting calls [ARM DUI 0471, semihosting].
namespace plumb::bare_metal {

void write(const char* text) noexcept;
void write(std::uint64_t number, int base) noexcept;

/// What a board does after its reset; each image has its own. Its value is the exit status.
int run_program();

/// Ends the program; the emulator ends with the same status.
[[noreturn]] void leave(int status) noexcept;

enum Exit : int { kPassed = 0, kFailed = 1, kAllocated = 2, kThrown = 3, kFault = 4 };

}  // namespace plumb::bare_metal
