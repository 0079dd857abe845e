// SPDX-License-Identifier: Apache-2.0
// Real measurements: what is missing from a UR10's geometric model, by joint and cycles a turn. The
// files lie beside the checkout; without them the tests are skipped.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "diagnose/diagnosis.hpp"
#include "fit/cell_data.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

class Ur10Diagnosis : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(folder() / "cell.toml")) GTEST_SKIP() << "no " << folder();
  }
  static fs::path folder() { return PLUMB_SHARED_DATA; }
  static Cell cell(const char* series) {
    Cell out = read_cell(folder() / "cell.toml");
    out.measurement.files = {folder() / series};
    return out;
  }
};

TEST_F(Ur10Diagnosis, SeriesBNamesAGearRippleAndFallsBelowTheMark) {
  Cell b = cell("series_B.csv");
  const Measurements measured = read_cell_measurements(b);
  const long seeds = tests::scaled(1);
  for (long seed = 1; seed <= std::min(5L, seeds); ++seed) {
    b.measurement.seed = static_cast<std::uint64_t>(seed);
    const Diagnosis d = diagnose(b, measured, {.apply = true, .tell = {}});
    std::printf("B, seed %ld: %s\n  %s\n", seed, d.text.c_str(), d.text_after.c_str());
    EXPECT_EQ(d.finding, Finding::kMissing);
    EXPECT_EQ(d.candidates.front().entry.name, "gear_ripple");
    EXPECT_FALSE(d.candidates.front().cycles.empty());
    EXPECT_GT(d.before.mean, 0.37e-3);
    EXPECT_LE(d.after.mean, 0.15e-3);
  }
}

}  // namespace
}  // namespace plumb::offline
