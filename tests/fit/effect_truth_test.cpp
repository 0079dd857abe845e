// SPDX-License-Identifier: Apache-2.0
// Arms of the simulator, whose laws are written apart and are richer than the library's: adding the
// right effect must bring the calibrated arm nearer to the true one, on poses it never saw.
#include <gtest/gtest.h>

#include <cmath>

#include "arm/predicted_points.hpp"
#include "fit/calibrate.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr double kSigma_m = 20e-6;
constexpr double kHidden_sigmas = 5.0;

struct Hidden {
  const char* spec;  // of the simulator
  EffectEntry entry;
  const char* options = "";
};

EffectEntry effect(const std::string& name, std::vector<int> joints = {},
                   std::map<std::string, EffectEntry::Value> options = {}) {
  return {name, std::move(joints), std::move(options), {}};
}

std::vector<Hidden> hidden_effects() {
  return {{"joint_compliance:J2", effect("joint_compliance", {1})},
          {"joint_compliance:J3", effect("gravity_free", {2})},
          {"joint_compliance_soft:J2", effect("joint_compliance_soft", {1})},
          {"link_flexure:J2", effect("link_flexure", {1})},
          {"payload_compliance:J2", effect("payload_compliance", {1})},
          {"backlash_load:J2", effect("backlash_load", {1})},
          {"base_compliance", effect("base_compliance")},
          {"tool_sag", effect("tool_sag")},
          {"gear_harmonics:J3", effect("gear_harmonics", {2})},
          {"gear_ripple:J2", effect("gear_ripple", {1}, {{"cycles_per_turn", 20.0}}), "@cycles=20"},
          {"encoder_scale:J3", effect("encoder_scale", {2})},
          {"encoder_eccentricity:J2", effect("encoder_eccentricity", {1})},
          {"axis_wobble:J1", effect("axis_wobble", {0})},
          {"wrist_coupling", effect("wrist_coupling")},
          {"cross_compliance:J3", effect("cross_compliance", {2, 1})},
          {"reversal:J2", effect("reversal", {1})},
          {"settling_lag:J2", effect("settling_lag", {1})},
          {"thermal_growth", effect("thermal_growth")},
          {"drift", effect("drift")},
          {"tracker", effect("tracker")}};
}

std::string with_size(const std::string& spec) {
  const std::string sigmas = ":" + std::to_string(static_cast<int>(kHidden_sigmas));
  return spec + (spec.find(':') == std::string::npos ? ":" : "") + sigmas;
}

/// Per-axis RMS distance from the noise-free truth on fresh poses, in sigma.
double true_error(const Cell& cell, const BlindCase& blind) {
  std::vector<int> rows(static_cast<std::size_t>(blind.measured.measured.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<int>(i);
  const Calibration c = calibrate(cell, blind.measured.measured, rows);
  const auto& fresh = blind.fresh.measured;
  const Rows3 error = blind.fresh.true_p_M - predict_points(c.state, fresh);
  return std::sqrt(error.squaredNorm() / static_cast<double>(error.size())) / kSigma_m;
}

TEST(EffectAgainstTruth, TheRightEffectLowersTheTrueErrorOfArmsWithRicherLaws) {
  const long seeds = tests::scaled(2);
  int better = 0, cases = 0;
  for (const auto& [spec, entry, options] : hidden_effects()) {
    double before = 0.0, after = 0.0;
    for (long seed = 1; seed <= seeds; ++seed) {
      BlindRequest request;
      request.arm = seed % 2 == 0 ? BlindArm::kLight : BlindArm::kHeavy;
      request.effects = {with_size(spec) + options};
      request.sigma_m = kSigma_m;
      request.poses = 300;
      request.seed = static_cast<std::uint64_t>(seed);
      const BlindCase blind = make_blind_case(request);
      Cell cell = blind.cell;
      const double without = true_error(cell, blind);
      cell.effects.push_back(entry);
      const double with = true_error(cell, blind);
      better += with < without;
      ++cases;
      before += without / static_cast<double>(seeds);
      after += with / static_cast<double>(seeds);
    }
    std::printf("%-28s %5.2f -> %5.2f sigma\n", spec, before, after);
  }
  std::printf("%d of %d better\n", better, cases);
  EXPECT_GE(better, 0.97 * cases);
}

}  // namespace
}  // namespace plumb::offline
