// SPDX-License-Identifier: Apache-2.0
// The number that the image on the board must print, on this machine.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "plumb/format/reader.hpp"
#include "tests/bare_metal/cycle_hash.hpp"

namespace plumb::bare_metal {
namespace {

TEST(BareMetal, BitsAreTheSameAsOnThisMachine) {
  const auto read = format::read_model(std::filesystem::path(PLUMB_GOLDEN "/six_axis.plumb"));
  ASSERT_TRUE(std::holds_alternative<format::Model>(read));
  const Corrector corrector(std::get<format::Model>(read));
  const auto just = [](auto cycle) { cycle(); };
  const std::uint64_t hash = hash_of_cycles(corrector, just, just);
  std::printf("%d cycles, seed %d: %016llx\n", kCycles, static_cast<int>(kSeed),
              static_cast<unsigned long long>(hash));
  EXPECT_EQ(hash, kHash);
}

}  // namespace
}  // namespace plumb::bare_metal
