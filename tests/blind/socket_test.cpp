// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/blind/socket_findings.hpp"
#include "tests/blind/socket_marks.hpp"

namespace plumb::offline {
namespace {

using Kind = SocketWay::Kind;

/// A slice of docs/without-a-tracker.md.
TEST(Sockets, CalibrateAnArmAsTheirPageSays) {
  const SocketMarks marks = socket_marks({Kind::kKnownDistance, 200, 30e-6}, 6, 2050);
  EXPECT_EQ(marks.refused, 0);
  EXPECT_LT(marks.mean_m(), 0.10e-3);
  EXPECT_GE(marks.inside_share(), 0.85);
  EXPECT_GT(marks.numbers, 100);
}

TEST(Sockets, WithMorePlayLeaveMoreError) {
  const SocketMarks little = socket_marks({Kind::kSockets, 100, 10e-6}, 4, 2060);
  const SocketMarks much = socket_marks({Kind::kSockets, 100, 100e-6}, 4, 2060);
  EXPECT_GT(much.mean_m(), 1.2 * little.mean_m());
}

TEST(Sockets, PlanesAndWiresHoldTheTrueNumbersInTheirIntervals) {
  using Artefact = ArtefactPlan::Kind;
  for (const auto kind : {Artefact::kPlane, Artefact::kWire}) {
    const SocketMarks marks = socket_marks({Kind::kArtefacts, 200, 10e-6, kind}, 6, 2070);
    EXPECT_EQ(marks.refused, 0);
    EXPECT_GE(marks.inside_share(), 0.85);
    EXPECT_GT(marks.numbers, 100);
    if (kind == Artefact::kWire) {
      EXPECT_LT(marks.mean_m(), 0.05e-3);
    }
  }
}

TEST(SocketFindings, ALoadIsTheFirstCauseWhereItShowsAndNothingIsMadeUp) {
  const SocketFindings found =
      socket_findings({Kind::kArtefacts, 400, 10e-6, ArtefactPlan::Kind::kDistance}, 3, 2090);
  EXPECT_EQ(found.first, 3);
  EXPECT_EQ(found.wrong, 0);
  EXPECT_EQ(found.made_up, 0);
}

}  // namespace
}  // namespace plumb::offline
