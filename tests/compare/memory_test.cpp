// SPDX-License-Identifier: Apache-2.0
// What a reading more costs in memory: a million of them must fit.
#include <gtest/gtest.h>

#include "noise/change_points.hpp"
#include "residual_cases.hpp"
#include "tests/heap_calls.hpp"

namespace plumb::offline::compare {
namespace {

long bytes_of_search(int poses) {
  ResidualCase at(11, poses);
  at.add_noise(1e-5);
  const StepMotions motions = at.motions();
  return tests::heap_bytes_of([&] { EXPECT_TRUE(change_points(motions).steps.empty()); });
}

TEST(MemoryOfAReading, TheSearchForJumpsKeepsNoSumsOfEveryVisit) {
  const long more = bytes_of_search(4000) - bytes_of_search(2000);
  EXPECT_LT(more / 2000, 400);  // four thousand, if every part of the arm had sums of its own
}

long bytes_of_motions(int poses) {
  const ResidualCase at(11, poses);
  const Series series = at.in_order();
  return tests::heap_bytes_of(
      [&] { EXPECT_EQ(StepMotions(at.state, at.measured, series).size(), poses); });
}

TEST(MemoryOfAReading, TheMotionsOfAVisitTakeAVectorForEachJointAndFewMore) {
  const long more = bytes_of_motions(4000) - bytes_of_motions(2000);
  EXPECT_LT(more / 2000, (6 + 5) * 24);  // the frame of the tool stood there as well
}

}  // namespace
}  // namespace plumb::offline::compare
