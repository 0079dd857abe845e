// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/format/model.hpp"

namespace plumb::tests {

/// What must hold of every model that a reader lets through: it is consistent, and, its effects
/// being known, one cycle at one input is finite and within the guard's limits. seed: which input.
/// Aborts where a law is broken. Shares nothing with the reader's own check.
void require_sound(const format::Model& model, std::uint64_t seed);

/// And it is written and read back the same.
void require_written_and_read_back(const format::Model& model);

/// The models looked at so far; printed when the program ends.
struct LawTally {
  std::uint64_t read = 0;    // models that a reader let through
  std::uint64_t cycles = 0;  // of these, with effects that can be run
  ~LawTally();
};

}  // namespace plumb::tests
