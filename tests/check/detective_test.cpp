// SPDX-License-Identifier: Apache-2.0
#include "check/detective.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numeric>

#include "fit/calibrate.hpp"
#include "tests/check/scrambled.hpp"

namespace plumb::offline {
namespace {

using scrambled::Case;
using scrambled::Files;

/// RMS 3-D residual with frame and target placed by the calibration's own code.
double placed_rms(const Cell& cell, const Measurements& m) {
  std::vector<int> rows(m.size());
  std::iota(rows.begin(), rows.end(), 0);
  const Rows3 left = residuals(m, predict_points(place_nominal(cell, m, rows), m.q));
  return std::sqrt(left.squaredNorm() / m.size());
}

/// What --fix would make of the files.
Files fixed(const Files& files, const Case& c, const Convention& meant) {
  const Convention labels = labelled_convention(c.cell, c.measured);
  return {
      edited(files.cell, "cell.toml", cell_edit(c.cell, labels, meant)),
      edited(files.csv, c.measured.tables[0].header_line, measurement_edit(c.cell, labels, meant)),
      {}};
}

std::string words(const Cell& cell, const Detection& d) {
  return fmt::format("{}",
                     fmt::join(in_words(cell, d.present.convention, d.best.convention), "; "));
}

struct Timed {
  double total_ms = 0.0, most_ms = 0.0;
  Detection detect(const Case& c) {
    const auto start = std::chrono::steady_clock::now();
    Detection out = detect_convention(c.cell, c.measured);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    total_ms += took.count();
    most_ms = std::max(most_ms, took.count());
    return out;
  }
};

// A reading is right if the repaired files predict the points as well as the files before the
// scrambling did: what predicts the same points cannot be told apart by points.
TEST(Detective, NamesTheRightReadingOfScrambledFiles) {
  const long count = tests::scaled(160);
  const std::uint64_t seed = 20;
  std::printf("%ld scrambled cells, seed %d\n", count, static_cast<int>(seed));
  tests::Random random(seed);
  const scrambled::Folder folder;
  Timed timed;
  long right = 0;
  for (long i = 0; i < count; ++i) {
    const Files sound = scrambled::random_files(random);
    const Files broken = scrambled::scramble(sound, random);
    const Case c = opened(broken, folder.path());
    const Detection d = timed.detect(c);
    const Case repaired = opened(fixed(broken, c, d.best.convention), folder.path());
    const double rms = placed_rms(repaired.cell, repaired.measured);
    const Case before = opened(sound, folder.path());
    const double truth = placed_rms(before.cell, before.measured);
    if (std::abs(rms / truth - 1.0) < 0.02) {
      ++right;
      continue;
    }
    std::printf("%ld: done %s; found %s; %.4f mm instead of %.4f mm; %d joints, %d poses\n", i,
                fmt::format("{}", fmt::join(broken.done, ", ")).c_str(), words(c.cell, d).c_str(),
                rms * 1e3, truth * 1e3, c.cell.joints(), c.measured.size());
  }
  std::printf("right in %ld of %ld; %.1f ms each, at most %.1f ms\n", right, count,
              timed.total_ms / static_cast<double>(count), timed.most_ms);
  EXPECT_GE(static_cast<double>(right), 0.99 * static_cast<double>(count));
}

TEST(Detective, ChangesNothingInSoundFiles) {
  const long count = tests::scaled(160);
  const std::uint64_t seed = 21;
  std::printf("%ld sound cells, seed %d\n", count, static_cast<int>(seed));
  tests::Random random(seed);
  const scrambled::Folder folder;
  Timed timed;
  for (long i = 0; i < count; ++i) {
    const Case c = opened(scrambled::random_files(random), folder.path());
    const Detection d = timed.detect(c);
    EXPECT_FALSE(d.changed) << i << ": " << words(c.cell, d);
    EXPECT_EQ(d.best.convention, labelled_convention(c.cell, c.measured));
  }
  std::printf("%.1f ms each, at most %.1f ms\n", timed.total_ms / static_cast<double>(count),
              timed.most_ms);
}

}  // namespace
}  // namespace plumb::offline
