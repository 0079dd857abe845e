// SPDX-License-Identifier: Apache-2.0
#include "cell/lost_points.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace plumb::offline {
namespace {

/// An arm of 2 m whose points lie around (2.5, -1, 0.5) m, seen in so many readings.
struct Seen {
  Cell cell;
  MeasurementFiles measured;
};

Seen seen(int readings) {
  Seen out;
  out.cell.nominal.joints.resize(2);
  for (auto& row : out.cell.nominal.joints) row.a = 1.0;
  auto& m = out.measured;
  m.q = RowsN::Zero(readings, 2);
  m.p_M.resize(readings, 3);
  for (int i = 0; i < readings; ++i) m.p_M.row(i) << 2.5 + 0.01 * i, -1.0 + 0.02 * (i % 7), 0.5;
  m.set.assign(static_cast<std::size_t>(readings), SetMark::kUnmarked);
  m.file.assign(static_cast<std::size_t>(readings), 0);
  Table table;
  table.file = "m.csv";
  table.lines.resize(static_cast<std::size_t>(readings));
  std::iota(table.lines.begin(), table.lines.end(), 2);
  m.tables.push_back(std::move(table));
  return out;
}

std::vector<int> ignored(Seen& seen) {
  ignore_lost_points(seen.cell, seen.measured);
  std::vector<int> out;
  for (int i = 0; i < seen.measured.size(); ++i)
    if (seen.measured.set[static_cast<std::size_t>(i)] == SetMark::kIgnore) out.push_back(i);
  return out;
}

TEST(LostPoints, AreExactlyTheTrackerOrOutOfEveryReach) {
  for (const Eigen::RowVector3d& point :
       {Eigen::RowVector3d(0.0, 0.0, 0.0), Eigen::RowVector3d(-0.0, 0.0, 0.0),
        Eigen::RowVector3d(-9.999, -9.999, -9.999), Eigen::RowVector3d(1000.0, 0.0, 0.0)}) {
    Seen some = seen(30);
    some.measured.p_M.row(4) = some.measured.p_M.row(11) = point;
    EXPECT_EQ(ignored(some), (std::vector<int>{4, 11})) << point;
    const auto& remarks = some.measured.tables.front().remarks;
    ASSERT_EQ(remarks.size(), 1U);
    EXPECT_EQ(remarks.front().code, "W-CSV-LOST");
    EXPECT_NE(remarks.front().message.find("lines 6, 13"), std::string::npos)
        << remarks.front().message;
  }
}

TEST(LostPoints, AreNoneThatTheArmMayReachNorMostOfThem) {
  Seen sound = seen(30);
  sound.measured.p_M.row(4) << 0.0, 0.0, 1e-6;   // beside the tracker
  sound.measured.p_M.row(5) << 2.5, -1.0, -4.0;  // far, and an arm with a long tool may be there
  sound.measured.p_M.row(6) << 0.1, -1.0, 0.0;
  EXPECT_TRUE(ignored(sound).empty());
  Seen broken = seen(30);
  for (int i = 0; i < 12; ++i) broken.measured.p_M.row(i).setZero();
  EXPECT_TRUE(ignored(broken).empty()) << "so many are another fault, which check looks for";
  Seen flat = seen(30);
  flat.measured.has_axis = {true, true, false};
  flat.measured.p_M.row(3).setZero();
  EXPECT_TRUE(ignored(flat).empty()) << "two coordinates may well be zero";
}

}  // namespace
}  // namespace plumb::offline
