// SPDX-License-Identifier: Apache-2.0
// A refit ends where a calibration from the start ends, and a nearby one keeps what it was near to.
#include "diagnose/refit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

#include "arm/predicted_points.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

/// An arm with two effects, one of which the first fit knows.
struct Refitted : testing::Test {
  static void SetUpTestSuite() {
    BlindRequest request;
    request.poses = 90;
    request.fresh_poses = 1;
    request.effects = {"gear_harmonics:J2:3", "gear_harmonics:J3:3"};
    request.outlier_share = 0.03;
    request.seed = 4;
    blind = new BlindCase(make_blind_case(request));
    const Cell cell = cell_with({gear(1)});
    first = new Calibration(calibrate(cell, blind->measured.measured, rows()));
  }
  static void TearDownTestSuite() {
    delete first;
    delete blind;
  }
  static EffectEntry gear(int joint) { return entry_of("gear_harmonics", {joint}); }
  static std::vector<int> rows() {
    std::vector<int> out(static_cast<std::size_t>(blind->measured.measured.size()));
    std::iota(out.begin(), out.end(), 0);
    return out;
  }
  static Calibration with(const std::vector<EffectEntry>& effects, Refit how) {
    return refitted(blind->cell, blind->measured.measured, rows(), cell_with(effects).effects,
                    *first, how);
  }
  /// The cell with these effects beside its own.
  static Cell cell_with(const std::vector<EffectEntry>& effects) {
    Cell out = blind->cell;
    out.effects.insert(out.effects.end(), effects.begin(), effects.end());
    return out;
  }
  /// RMS error at the poses that no fit here leaves out [m].
  static double left_by(const Calibration& fit) {
    const Measurements& m = blind->measured.measured;
    const std::vector<int> some = without_outliers(rows(), with({}, Refit::kFully).outliers);
    const Rows3 error = pick(m, some).p_M - predict_points(fit.state, pick(m, some));
    return std::sqrt(error.squaredNorm() / static_cast<double>(error.size()));
  }
  static double value(const Calibration& fit, const std::string& name) {
    for (const Estimate& estimate : fit.estimates)
      if (estimate.name == name) return estimate.value;
    ADD_FAILURE() << "no " << name;
    return NAN;
  }
  /// Both fits have the same numbers, each as near as a tenth of its standard deviation.
  static void expect_alike(const Calibration& a, const Calibration& b) {
    ASSERT_EQ(a.estimates.size(), b.estimates.size());
    for (const Estimate& estimate : a.estimates)
      EXPECT_NEAR(value(b, estimate.name), estimate.value, 0.1 * estimate.std) << estimate.name;
  }
  static BlindCase* blind;
  static Calibration* first;
};
BlindCase* Refitted::blind = nullptr;
Calibration* Refitted::first = nullptr;

TEST_F(Refitted, EndsWhereACalibrationFromTheStartEnds) {
  for (const auto& effects : {std::vector<EffectEntry>{}, {gear(2)}, {gear(1), gear(2)}}) {
    const Cell cell = cell_with(effects);
    expect_alike(with(effects, Refit::kFully), calibrate(cell, blind->measured.measured, rows()));
  }
}

TEST_F(Refitted, OfTheSameEffectsIsTheSameFit) {
  expect_alike(with({gear(1)}, Refit::kFully), *first);
  expect_alike(with({gear(1)}, Refit::kNearby), *first);
}

TEST_F(Refitted, NearbyNeverTakesBackAPoseThatWasLeftOutAndFitsTheSameGeometry) {
  ASSERT_FALSE(first->outliers.empty());
  const Calibration near = with({gear(1), gear(2)}, Refit::kNearby);
  std::set<Eigen::Index> out_near;
  for (const Outlier& outlier : near.outliers) out_near.insert(outlier.row);
  for (const Outlier& outlier : first->outliers)
    EXPECT_TRUE(out_near.contains(outlier.row)) << outlier.row;
  const auto geometry = [](const Calibration& fit) {
    std::vector<std::string> out;
    for (const Parameter& p : fit.parameters)
      if (!p.of_effect()) out.push_back(p.name);
    return out;
  };
  EXPECT_EQ(geometry(near), geometry(*first));
}

TEST_F(Refitted, WithAnEffectThatIsThereLeavesLess) {
  for (const Refit how : {Refit::kNearby, Refit::kFully}) {
    const Calibration both = with({gear(1), gear(2)}, how);
    EXPECT_LT(left_by(both), 0.8 * left_by(*first));
    EXPECT_GT(left_by(with({}, how)), 1.2 * left_by(*first));
  }
}

TEST_F(Refitted, ThatIsRefusedForAnythingButItsConvergenceStaysRefused) {
  const std::vector<int> few{0, 1, 2};
  EXPECT_THROW(
      refitted(blind->cell, blind->measured.measured, few, cell_with({gear(1)}).effects, *first),
      Failure);
}

}  // namespace
}  // namespace plumb::offline
