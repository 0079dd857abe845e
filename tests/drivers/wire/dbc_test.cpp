// SPDX-License-Identifier: Apache-2.0
// The text of a DBC file, line by line where it counts; dbc_peer.py reads it with other programs.
#include "bus_text/dbc.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumb::drivers {
namespace {

long count(const std::string& text, const std::string& part) {
  long out = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++out;
  return out;
}

void expect_lines(const std::string& dbc, std::initializer_list<const char*> lines) {
  for (const std::string line : lines)
    EXPECT_NE(("\n" + dbc).find("\n" + line + "\n"), std::string::npos) << line;
}

TEST(Dbc, AClassicPoseIsThreeFramesInIntelOrder) {
  expect_lines(
      write_dbc(default_layout(6, 0.004), "Line (F08-1234)"),
      {"BU_: controller plumb_rt", "BO_ 280 target_1: 8 controller",
       " SG_ x : 0|24@1- (1,0) [-8388607|8388607] \"um\" plumb_rt",
       " SG_ y : 24|24@1- (1,0) [-8388607|8388607] \"um\" plumb_rt",
       " SG_ counter : 48|8@1+ (1,0) [0|255] \"\" plumb_rt",
       " SG_ crc : 56|8@1+ (1,0) [0|255] \"\" plumb_rt", "BO_ 282 target_3: 8 controller",
       " SG_ rz : 24|24@1- (1,0) [-8388607|8388607] \"urad\" plumb_rt",
       "BO_ 304 corrected_1: 8 plumb_rt", "CM_ \"Line (F08-1234)\";", "BA_ \"BusType\" \"CAN\";",
       "BA_ \"GenMsgCycleTime\" BO_ 280 4;", "BA_ \"VFrameFormat\" BO_ 280 0;",
       "VAL_ 280 x -8388608 \"unknown\" ;",
       "VAL_ 320 state -8388608 \"unknown\" 0 \"init\" 1 \"sync\" 2 \"shadow\" 3 \"active\" "
       "4 \"hold\" 5 \"fault\" ;"});
}

TEST(Dbc, BigEndianValuesBeginAtTheirHighestBit) {
  BusLayout layout = default_layout(6, 0.004);
  layout.byte_order = ByteOrder::kBig;
  expect_lines(write_dbc(layout, ""),
               {" SG_ x : 7|24@0- (1,0) [-8388607|8388607] \"um\" plumb_rt",
                " SG_ y : 31|24@0- (1,0) [-8388607|8388607] \"um\" plumb_rt"});
}

TEST(Dbc, OffsetsAreTenthsOfMicrometres) {
  expect_lines(write_dbc(default_layout(6, 0.004, 0, CorrectionForm::kOffset), ""),
               {"BO_ 312 offset_1: 8 plumb_rt",
                " SG_ dx : 0|16@1- (0.1,0) [-3276.7|3276.7] \"um\" controller",
                " SG_ dz : 32|16@1- (0.1,0) [-3276.7|3276.7] \"um\" controller",
                "BO_ 313 offset_2: 8 plumb_rt",
                " SG_ drx : 0|16@1- (1,0) [-32767|32767] \"urad\" controller"});
}

TEST(Dbc, FdFramesAreMarkedAndExtendedOnesHaveBit31) {
  BusLayout layout = default_layout(6, 0.001);
  layout.can_format = CanFrame::Format::kFd;
  layout.id_kind = CanFrame::Id::kExtended;
  expect_lines(
      write_dbc(layout, ""),
      {"BO_ 2147483928 target: 32 controller",
       " SG_ rz : 160|32@1- (1,0) [-2147483647|2147483647] \"urad\" plumb_rt",
       " SG_ counter : 192|16@1+ (1,0) [0|65535] \"\" plumb_rt",
       " SG_ crc : 208|32@1+ (1,0) [0|4294967295] \"\" plumb_rt", "BA_ \"BusType\" \"CAN FD\";",
       "BA_ \"VFrameFormat\" BO_ 2147483928 15;", "BA_ \"GenMsgCycleTime\" BO_ 2147483928 1;"});
}

TEST(Dbc, EveryFrameAndValueOfTheLayoutIsThereOnce) {
  for (int joints = 1; joints <= 9; ++joints) {
    const BusLayout layout = default_layout(joints, 0.004, 3);
    const std::string dbc = write_dbc(layout, "");
    std::size_t frames = 0, values = 0;
    for (const MessageLayout& m : layout.messages) {
      frames += can_frames(layout, m);
      values += m.signals.size();
    }
    EXPECT_EQ(count(dbc, "\nBO_ "), static_cast<long>(frames));
    EXPECT_EQ(count(dbc, "\n SG_ "), static_cast<long>(values + 2 * frames));
  }
}

TEST(Dbc, NamesWithQuotesAndLineBreaksDoNotBreakIt) {
  const std::string dbc = write_dbc(default_layout(6, 0.004), "a\"b\\c\nd");
  expect_lines(dbc, {"CM_ \"a'b/c d\";"});
  EXPECT_EQ(std::count(dbc.begin(), dbc.end(), '"') % 2, 0);
}

}  // namespace
}  // namespace plumb::drivers
