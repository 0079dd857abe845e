// SPDX-License-Identifier: Apache-2.0
// The number that the image on the board must print, on this machine.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/bare_metal/cycle_hash.hpp"
#include "tests/rt/cycle_model.hpp"

namespace plumb::bare_metal {
namespace {

TEST(BareMetal, BitsAreTheSameAsOnThisMachine) {
  const format::Model model = tests::cycle_model();
  const Corrector corrector(model);
  const auto just = [](auto cycle) { cycle(); };
  const std::uint64_t hash = hash_of_cycles(corrector, just, just);
  std::printf("%d cycles, seed %d: %016llx\n", kCycles, static_cast<int>(kSeed),
              static_cast<unsigned long long>(hash));
  EXPECT_EQ(hash, kHash);
}

}  // namespace
}  // namespace plumb::bare_metal
