// SPDX-License-Identifier: Apache-2.0
// What is missing in an arm that touches sockets, simulated with kinematics of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "diagnose/diagnosis.hpp"
#include "fit/cell_data.hpp"
#include "fit/fit_cell.hpp"
#include "tests/cases/artefact_readings.hpp"
#include "tests/cell/support.hpp"

namespace plumb::offline {
namespace {

struct Touching {
  /// The sockets of the plan, or, if `read` says so, other artefacts.
  explicit Touching(const SocketPlan& plan, const std::optional<ArtefactPlan>& read = {})
      : arm(plan) {
    const auto file = folder.put("cell.toml", arm.cell_toml());
    folder.put("measurements.csv", read ? artefact_readings(arm, *read) : arm.measurements_csv());
    cell = read_cell(file);
    cell.measurement.sigma_m = read ? read->sigma_m : plan.play_m;
    measured = read_cell_measurements(cell);
  }
  Folder folder;
  SocketArm arm;
  Cell cell;
  MeasurementFiles measured;
};

bool is_load(const std::string& effect) {
  return effect == "gravity_free" || effect == "joint_compliance" || effect == "link_flexure";
}

TEST(TouchedPointsDiagnosis, FindsThatJointsYieldAndSaysTheErrorThatTheFitSays) {
  Touching s({.seed = 21,
              .touches = 25,
              .play_m = 10e-6,
              .yields_rad_per_Nm = 8e-6,
              .known_distance = true});
  const Diagnosis d = diagnose(s.cell, s.measured, {});
  ASSERT_FALSE(d.candidates.empty());
  EXPECT_TRUE(is_load(d.candidates.front().entry.name)) << d.text;
  const Fit fit = fit_cell(s.cell, s.measured, {});
  // Both leave out single readings that stand out.
  const double held_m = fit.held_without_outliers.mean;
  EXPECT_NEAR(d.before.mean, held_m, 0.02 * held_m);
  EXPECT_LT(d.candidates.front().alone.mean, d.before.mean);
}

TEST(TouchedPointsDiagnosis, FindsNothingWhereNothingIsHidden) {
  Touching s({.seed = 22, .touches = 25, .known_distance = true});
  const Diagnosis d = diagnose(s.cell, s.measured, {});
  EXPECT_EQ(d.finding, Finding::kComplete) << d.text;
  EXPECT_TRUE(std::any_of(d.not_testable.begin(), d.not_testable.end(),
                          [](const Testable& t) { return t.effect == "tracker"; }));
}

/// One number a row names the effect as well, where there are enough rows.
TEST(ArtefactDiagnosis, FindsThatJointsYieldAndNothingWhereNothingIsHidden) {
  using Kind = ArtefactPlan::Kind;
  for (const Kind kind : {Kind::kPlane, Kind::kBall, Kind::kDistance}) {
    SCOPED_TRACE(static_cast<int>(kind));
    const ArtefactPlan plan{.kind = kind, .artefacts = 8, .readings = 40, .sigma_m = 10e-6};
    Touching yielding({.seed = 23, .yields_rad_per_Nm = 8e-6}, plan);
    const Diagnosis d = diagnose(yielding.cell, yielding.measured, {});
    ASSERT_FALSE(d.candidates.empty());
    EXPECT_NE(d.finding, Finding::kComplete) << d.text;
    EXPECT_TRUE(is_load(d.candidates.front().entry.name)) << d.text;
    Touching rigid({.seed = 23}, plan);
    const Diagnosis none = diagnose(rigid.cell, rigid.measured, {});
    EXPECT_EQ(none.finding, Finding::kComplete) << none.text;
  }
}

}  // namespace
}  // namespace plumb::offline
