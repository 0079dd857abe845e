// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "import/joining.hpp"
#include "tests/import/imported_text.hpp"

namespace plumb::offline {
namespace {

using tests::imported_text;
using tests::in_short;
using tests::refusal_of;
using tests::remark_of;

struct Stamp {
  const char* header;
  const char* cells[2];
  const char* expected;
};

TEST(TimeColumns, StampsOfEveryKindCountFromTheFirst) {
  const Stamp table[] = {
      {"timestamp_ns", {"1710000000123456789", "1710000003201234566"}, "t_s=0|3.077778"},
      {"%time", {"1710000000123456789", "1710000002123456789"}, "t_s=0|2"},
      {"time", {"1710000000123456", "1710000002123456"}, "t_s=0|2"},
      {"timestamp_us", {"1710000000123456", "1710000002123456"}, "t_s=0|2"},
      {"timestamp [ms]", {"1710000000123", "1710000002623"}, "t_s=0|2.5"},
      {"timestamp_s", {"1710000000.25", "1710000002.5"}, "t_s=0|2.25"},
      {"Zeit", {"1710000000", "1710000060"}, "t_s=0|60"},
      {"time", {"2024-03-09T16:00:00Z", "2024-03-09T16:01:00Z"}, "t_s=0|60"},
      {"time", {"20240309T160000Z", "20240309T160001.5Z"}, "t_s=0|1.5"},
      {"time", {"2024-03-09 16:00:00.5", "2024-03-09 16:00:02"}, "t_s=0|1.5"},
      {"Zeit", {"29.02.2024 16:00", "01.03.2024 16:00"}, "t_s=0|86400"},
      {"Time", {"3/14/2024 4:00:00 PM", "3/14/2024 4:01:00 PM"}, "t_s=0|60"},
      {"time_s", {"12.5", "14.5"}, "t_s=12.5|14.5"},
      {"Time [ms]", {"12", "14"}, "t_ms=12|14"},
      {"t_s", {"1710000000", "1710000060"}, "t_s=1710000000|1710000060"},
  };
  for (const auto& row : table) {
    std::string text = std::string(row.header) + ",q1_deg,x_mm\n";
    for (const char* cell : row.cells) text += std::string(cell) + ",1,2\n";
    const std::string got = in_short(imported_text(text));
    EXPECT_NE((got + " ").find(row.expected + std::string(" ")), std::string::npos)
        << row.header << ": " << got;
  }
}

TEST(TimeColumns, NumbersWithoutAUnitAreAskedForIt) {
  EXPECT_EQ(refusal_of("time,q1_deg,x_mm\n1.5,1,2\n2.5,1,2\n").code, "E-IMPORT-UNIT");
  EXPECT_EQ(refusal_of("time_ns,q1_deg,x_mm\n100,1,2\n200,1,2\n").code, "E-IMPORT-UNIT");
  EXPECT_EQ(refusal_of("time_s,q1_deg,x_mm\n1.5,1,2\nlost,1,2\n").code, "E-IMPORT-NUMBER");
}

TEST(TimeColumns, SecondsAndNanosecondsAreOneStamp) {
  const std::pair<const char*, const char*> names[] = {
      {"secs", "nsecs"},
      {"sec", "nanosec"},
      {"header.stamp.sec", "header.stamp.nanosec"},
      {"field.header.stamp.secs", "field.header.stamp.nsecs"},
      {"timestamp_seconds", "timestamp_nanoseconds"}};
  for (const auto& [whole, parts] : names) {
    const Imported data =
        imported_text(std::string(whole) + "," + parts +
                      ",q1_deg\n1710000000,900000000,1\n1710000003,100000000,2\n");
    EXPECT_NE(in_short(data).find("t_s=0|2.2"), std::string::npos) << in_short(data);
    EXPECT_TRUE(data.left_out.empty());
    EXPECT_NE(remark_of(data, "N-IMPORT-TIME"), "");
  }
  ImportWishes wishes;
  wishes.map = {"secs=-,nsecs=-"};
  EXPECT_EQ(in_short(imported_text("secs,nsecs,q1_deg\n1,2,3\n", wishes)), "q1_deg=3");
}

TEST(TimeColumns, TwoFilesAreJoinedByWhenTheyWereWritten) {
  const Imported a = imported_text(
      "time,q1_deg\n2024-03-09T16:00:00Z,1\n2024-03-09T16:01:00Z,2\n2024-03-09T16:02:00Z,3\n");
  const Imported b = imported_text("time,x_mm\n2024-03-09T16:01:00Z,20\n2024-03-09T16:02:00Z,30\n");
  const Imported both = join(a, b, {.by = JoinBy::kTime, .max_gap_s = 1.0, .cell = nullptr});
  EXPECT_NE(in_short(both).find("q1_deg=2|3 x_mm=20|30"), std::string::npos) << in_short(both);
}

std::string joined(const std::vector<const char*>& first, const std::vector<const char*>& second,
                   std::string* remark = nullptr) {
  std::string a = "pose;q1_deg\n", b = "pose;x_mm\n";
  for (std::size_t i = 0; i < first.size(); ++i)
    a += std::string(first[i]) + ";" + std::to_string(i) + "\n";
  for (std::size_t i = 0; i < second.size(); ++i)
    b += std::string(second[i]) + ";" + std::to_string(10 * i) + "\n";
  try {
    const Imported both = join(imported_text(a), imported_text(b), {.by = JoinBy::kPose});
    if (remark != nullptr) *remark = remark_of(both, "N-IMPORT-NAMES");
    const std::string out = in_short(both);
    return out.substr(out.find("q1_deg"));
  } catch (const Failure& f) {
    if (remark != nullptr) *remark = f.problems().front().message;
    return f.problems().front().code;
  }
}

TEST(PoseNames, WritingThemDifferentlyMakesNoDifference) {
  std::string remark;
  EXPECT_EQ(joined({"P01", "P02", "P10"}, {"p10", "p1", "p2"}, &remark),
            "q1_deg=0|1|2 x_mm=10|20|0");
  EXPECT_NE(remark.find("'P01' is taken for 'p1'"), std::string::npos);
  EXPECT_EQ(joined({"p1", "p2"}, {"A::robot::p2", "A::robot::p1"}), "q1_deg=0|1 x_mm=10|0");
  EXPECT_EQ(joined({"Pose 1", "Pose 2"}, {"pose_2", "POSE-1"}), "q1_deg=0|1 x_mm=10|0");
  EXPECT_EQ(joined({"1", "2"}, {"002", "001"}), "q1_deg=0|1 x_mm=10|0");
  EXPECT_EQ(joined({"P09", "P10"}, {"P10", "P9"}), "q1_deg=0|1 x_mm=10|0");
  EXPECT_EQ(joined({"P1", "P2"}, {"P2", "P1"}, &remark), "q1_deg=0|1 x_mm=10|0");
  EXPECT_EQ(remark, "");
}

TEST(PoseNames, DifferentPosesStayDifferent) {
  std::string remark;
  EXPECT_EQ(joined({"P1", "p1", "P2"}, {"P1", "P3"}), "q1_deg=0 x_mm=0");
  EXPECT_EQ(joined({"1-1", "1-2"}, {"11", "12"}), "E-IMPORT-JOIN");
  EXPECT_EQ(joined({"A", "B"}, {"C", "D"}, &remark), "E-IMPORT-JOIN");
  EXPECT_NE(remark.find("'A', ..., here 'C'"), std::string::npos) << remark;
}

}  // namespace
}  // namespace plumb::offline
