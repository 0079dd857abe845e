// SPDX-License-Identifier: Apache-2.0
// One look with the whole library and all scans: how long it takes, and how that grows.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "diagnose/diagnosis.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/yardstick.hpp"

namespace plumb::offline {
namespace {

BlindCase case_of(int poses) {
  BlindRequest request;
  request.poses = poses;
  request.fresh_poses = 1;
  request.effects = {"joint_compliance:J2:5"};
  return make_blind_case(request);
}

/// Best of three, less the calibration that every verb makes.
double seconds_of_a_look(const BlindCase& blind) {
  double best = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double start = tests::processor_s();
    const Diagnosis d = diagnose(blind.cell, blind.measured.measured, {});
    EXPECT_EQ(d.finding, Finding::kMissing);
    EXPECT_GT(d.regressors, 200.0);
    best = std::min(best, tests::processor_s() - start);
  }
  return best;
}

TEST(DiagnoseTime, StaysWithinTheMarks) {
  const double small = seconds_of_a_look(case_of(1500));
  const double large = seconds_of_a_look(case_of(12000));
  std::printf("1,500 poses %.2f s, 12,000 poses %.2f s, calibration included\n", small, large);
  EXPECT_LE(large, 6.0 * small) << "eight times the poses, of which a quarter choose";
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("memory, simulation included: %.0f MB\n",
              static_cast<double>(usage.ru_maxrss) / 1024.0);
  // Marks of processor time, all threads together: twice what an idle machine takes.
  const double slower = tests::times_slower();
  EXPECT_LE(small, 1.2 * slower);
  EXPECT_LE(large, 6.0 * slower);
  EXPECT_LE(usage.ru_maxrss, 500 * 1024);
}

}  // namespace
}  // namespace plumb::offline
