// SPDX-License-Identifier: Apache-2.0
#include "noise/noise_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cell/random.hpp"
#include "noise/error_stats.hpp"
#include "noise/weights.hpp"

namespace plumb::offline {
namespace {

double normal(Random& random) {
  return std::sqrt(-2.0 * std::log(1.0 - random.unit())) * std::cos(2.0 * M_PI * random.unit());
}

Measurements repeats_of(int groups, int times, double sigma, std::uint64_t seed) {
  Random random(seed);
  Measurements m;
  const int n = groups * times;
  m.q = RowsN::Zero(n, 1);
  m.p_M.resize(n, 3);
  for (int i = 0; i < n; ++i) {
    m.replicate_group.push_back(i / times);
    for (int k = 0; k < 3; ++k) m.p_M(i, k) = i / times + sigma * normal(random);
  }
  return m;
}

TEST(NoiseFloor, RepeatsGiveTheirOwnSigmaAndTheMeanOfAThreeDimensionalNormal) {
  const NoiseFloor floor = noise_floor(Cell{}, repeats_of(2000, 3, 1e-5, 1));
  EXPECT_EQ(floor.source, NoiseFloor::Source::kRepeats);
  EXPECT_NEAR(floor.sigma_m, 1e-5, 2e-7);
  EXPECT_NEAR(floor.mean_m / floor.sigma_m, 1.596, 0.001);
  EXPECT_NEAR(floor.rms_m / floor.sigma_m, std::sqrt(3.0), 1e-12);
}

TEST(NoiseFloor, WithoutRepeatsTheStatedSigmaCountsAndWithoutBothNothingIsClaimed) {
  Cell cell;
  const Measurements m = repeats_of(50, 1, 1e-5, 1);
  EXPECT_EQ(noise_floor(cell, m).source, NoiseFloor::Source::kNone);
  cell.measurement.sigma_m = 2e-5;
  EXPECT_EQ(noise_floor(cell, m).sigma_m, 2e-5);
}

TEST(NoiseFloor, AFewBadReadingsDoNotChangeIt) {
  Measurements m = repeats_of(40, 2, 1e-5, 4);
  const double clean = noise_floor(Cell{}, m).sigma_m;
  m.p_M(7, 1) += 5e-2;
  m.p_M(40, 0) += 6e-4;
  EXPECT_NEAR(noise_floor(Cell{}, m).sigma_m, clean, 0.1 * clean);
  Measurements one = repeats_of(1, 20, 1e-5, 5);
  const double alone = noise_floor(Cell{}, one).sigma_m;
  one.p_M(3, 2) -= 1e-2;
  EXPECT_NEAR(noise_floor(Cell{}, one).sigma_m, alone, 0.1 * alone);
}

TEST(NoiseFloor, ABumpedReflectorBetweenFarRepeatsIsNoNoise) {
  // 200 rows: every pose is read twice in place, and once more after a bump of 0.3 mm.
  Measurements m = repeats_of(50, 4, 1e-5, 9);
  for (int i = 0; i < m.size(); ++i) {
    const int half = m.size() / 2;
    m.replicate_group[i] = (i % half) / 2;
    m.p_M.row(i) -= Eigen::RowVector3d::Constant(i / 4);
    if (i >= half) m.p_M(i, 2) += 3e-4;
  }
  EXPECT_NEAR(noise_floor(Cell{}, m).sigma_m, 1e-5, 1e-6);
}

/// Every pose is read twice in place, and twice more under another context, which moves it by
/// 0.1 mm; the rows of one pose follow each other.
Measurements under_two_contexts(std::uint64_t seed) {
  Measurements m = repeats_of(40, 4, 1e-5, seed);
  for (int i = 0; i < m.size(); ++i)
    if (i % 4 > 1) m.p_M(i, 2) += 1e-4;
  return m;
}

TEST(NoiseFloor, RepeatsAtOtherTemperaturesUnderOtherLoadsOrFromOtherSidesAreNoNoise) {
  for (const char* context : {"temperature", "payload", "direction", "step"}) {
    Measurements m = under_two_contexts(11);
    auto& c = m.context;
    for (RowsN* rows : {&c.temperature, &c.payload, &c.direction, &c.step}) {
      const bool is_one = (rows == &c.temperature && context == std::string("temperature")) ||
                          (rows == &c.payload && context == std::string("payload")) ||
                          (rows == &c.direction && context == std::string("direction")) ||
                          (rows == &c.step && context == std::string("step"));
      if (!is_one) continue;
      *rows = RowsN::Constant(m.size(), 2, 1.0);
      for (int i = 0; i < m.size(); ++i)
        if (i % 4 > 1) (*rows)(i, 1) = rows == &c.temperature ? 6.0 : -1.0;
    }
    const NoiseFloor floor = noise_floor(Cell{}, m);
    EXPECT_EQ(floor.source, NoiseFloor::Source::kRepeats) << context;
    EXPECT_NEAR(floor.sigma_m, 1e-5, 2e-6) << context;
  }
}

TEST(NoiseFloor, WithRepeatsAtOtherTemperaturesAloneNothingIsMeasured) {
  Measurements m = repeats_of(40, 2, 1e-5, 12);
  m.context.temperature.resize(m.size(), 1);
  for (int i = 0; i < m.size(); ++i) m.context.temperature(i, 0) = i % 2 == 0 ? 20.0 : 31.0;
  Cell cell;
  EXPECT_EQ(noise_floor(cell, m).source, NoiseFloor::Source::kNone);
  cell.measurement.sigma_m = 2e-5;
  EXPECT_EQ(noise_floor(cell, m).source, NoiseFloor::Source::kSigma);
  // A sensor that wanders by a tenth of a kelvin says nothing against it.
  for (int i = 0; i < m.size(); ++i) m.context.temperature(i, 0) = 20.0 + 0.1 * (i % 3);
  EXPECT_EQ(noise_floor(cell, m).source, NoiseFloor::Source::kRepeats);
}

TEST(NoiseFloor, SidesThatNobodyStatedSplitRepeatsOnlyIfEnoughAreLeft) {
  Measurements m = repeats_of(40, 2, 1e-5, 13);
  m.context.step.resize(m.size(), 1);
  for (int i = 0; i < m.size(); ++i) m.context.step(i, 0) = i % 2 == 0 ? 1.0 : -1.0;
  EXPECT_EQ(noise_floor(Cell{}, m).source, NoiseFloor::Source::kRepeats);
}

TEST(NoiseFloor, CopiesOfAReadingAndIgnoredRowsAreNoRepeats) {
  Measurements m = repeats_of(30, 2, 1e-5, 6);
  for (int i = 0; i < m.size(); i += 2) m.p_M.row(i + 1) = m.p_M.row(i);
  Cell cell;
  cell.measurement.sigma_m = 2e-5;
  EXPECT_EQ(noise_floor(cell, m).source, NoiseFloor::Source::kSigma);
  Measurements ignored = repeats_of(30, 2, 1e-5, 6);
  ignored.set.assign(60, SetMark::kIgnore);
  EXPECT_EQ(noise_floor(cell, ignored).source, NoiseFloor::Source::kSigma);
}

TEST(NoiseFloor, RepeatsRoundedToTheNoiseStillCount) {
  Measurements m = repeats_of(500, 3, 1e-5, 8);
  m.p_M = (m.p_M * 1e5).array().round().matrix() * 1e-5;  // to one sigma
  EXPECT_NEAR(noise_floor(Cell{}, m).sigma_m, 1.04e-5, 1e-6);
}

TEST(ErrorStats, AgreeWithNumbersDoneByHand) {
  const ErrorStats s = summarise({3.0, 1.0, 2.0, 4.0});
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(s.p95, 4.0);
  EXPECT_DOUBLE_EQ(s.max, 4.0);
  EXPECT_EQ(summarise({}).n, 0);
}

TEST(ExcessSigma, FindsWhatIsThereBesidesTheStatedNoiseAndNothingIfNothingIs) {
  Random random(3);
  const int n = 20000;
  Rows3 sigma(n, 3), quiet(n, 3), loud(n, 3);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) {
      sigma(i, k) = 1e-5 * (1.0 + random.unit());
      quiet(i, k) = 0.9 * sigma(i, k) * normal(random);
      loud(i, k) = sigma(i, k) * normal(random) + 1e-4 * normal(random);
    }
  Measurements measured;
  measured.q.resize(n, 6);
  EXPECT_EQ(excess_sigma(measured, quiet, sigma, 30), 0.0);
  EXPECT_NEAR(excess_sigma(measured, loud, sigma, 30), 1e-4, 2e-6);
}

}  // namespace
}  // namespace plumb::offline
