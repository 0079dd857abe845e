// SPDX-License-Identifier: Apache-2.0
#include "twin/twin_file.hpp"

#include <gtest/gtest.h>

namespace plumb::offline::twin {
namespace {

TEST(TwinFile, ReadsBackWhatWasWritten) {
  const Hidden hidden{.seed = 42,
                      .effects = {"gear_ripple:J2=40urad", "drift=100um"},
                      .geometry_m = 0.1e-3,
                      .geometry_rad = 0.2e-3,
                      .noise_m = 25e-6,
                      .sensors = {"temp_elbow", "temp"}};
  const Hidden back = parse_hidden(write_hidden(hidden), "twin.toml");
  EXPECT_EQ(back.seed, hidden.seed);
  EXPECT_EQ(back.effects, hidden.effects);
  EXPECT_EQ(back.sensors, hidden.sensors);
  EXPECT_NEAR(back.geometry_m, hidden.geometry_m, 1e-15);
  EXPECT_NEAR(back.geometry_rad, hidden.geometry_rad, 1e-15);
  EXPECT_NEAR(back.noise_m, hidden.noise_m, 1e-15);
}

TEST(TwinFile, UnknownKeysAndImpossibleNumbersAreRefused) {
  for (const char* text :
       {"schema = \"twin/2\"", "schema = \"twin/1\"\nsead = 1", "schema = \"twin/1\"\nseed = 1.5",
        "schema = \"twin/1\"\nseed = -1", "schema = \"twin/1\"\n[tracker]\nnoise_um = 0",
        "schema = \"twin/1\"\n[arm]\ngeometry_um = -1", "no toml"}) {
    SCOPED_TRACE(text);
    EXPECT_THROW(parse_hidden(text, "twin.toml"), Failure);
  }
}

TEST(TwinFile, ASizeInSigmaIsTheSameEveryTime) {
  const Cell cell = make_demo("clean").cell;
  const Hidden hidden{.effects = {"gear_ripple:J2:5"}};
  const HiddenTruth a = truth_of(cell, hidden), b = truth_of(cell, hidden);
  ASSERT_EQ(a.sized.size(), 1U);
  ASSERT_TRUE(a.sized.front().size.has_value());
  EXPECT_EQ(a.sized.front().size, b.sized.front().size);
}

}  // namespace
}  // namespace plumb::offline::twin
