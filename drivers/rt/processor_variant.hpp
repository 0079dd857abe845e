// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rt/check.hpp"

namespace plumb::drivers::rt {

/// The Debian package has this program twice: /usr/bin/plumb-rt runs on every x86-64 processor, and
/// /usr/libexec/plumb/x86-64-v3/plumb-rt is the same code compiled for AVX2. Both compute the same
/// bits; the second one takes less time.
///
/// Replaces this process by the second one if that exists, if the processor and the operating
/// system can run it, and unless the environment says PLUMB_RT_VARIANT=baseline. Returns if it does
/// not; a program that cannot be started is no error either, since this one does the same. To be
/// called before anything else: the process keeps its number, and nothing that is open.
void become_best_variant(char** arguments);

/// Where become_best_variant() looks: ../libexec/plumb/x86-64-v3/plumb-rt beside the folder of the
/// running program. Empty if the system does not say where that is.
std::filesystem::path v3_program();

/// Whether the machine code that runs is the best that the processor can: check "machine_code".
Check machine_code_check();

}  // namespace plumb::drivers::rt
