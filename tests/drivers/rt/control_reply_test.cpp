// SPDX-License-Identifier: Apache-2.0
#include "rt/control_reply.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumb::drivers::rt {
namespace {

/// What an asker may have put into a request, and with it into the refusal.
const std::string kWords[] = {
    "",           "plain",         "two\nlines\r\n",      std::string("\0", 1),
    "\"quoted\"", "\\ and \x7f\t", "\xc3\xa9\xe2\x82\xac"};

TEST(ControlReply, IsOneLineWhateverItSaysAndSaysIt) {
  for (const std::string& words : kWords) {
    const std::string line = refusal("E-RT-SWAP", words);
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << words;
    EXPECT_EQ(line.back(), '\n');
    const Json read = Json::parse(line);
    EXPECT_EQ(read["ok"], false);
    EXPECT_EQ(read["error"]["code"], "E-RT-SWAP");
    EXPECT_EQ(read["error"]["message"], words);
  }
}

/// The thread that answers catches nothing: what it throws ends the program, and with it the
/// correction.
TEST(ControlReply, BytesThatAreNoTextAreReplacedAndTheRestStays) {
  for (const std::string bytes : {"\xff", "\xc3", "\xed\xa0\x80", "\xf8\x88\x80\x80\x80"}) {
    const std::string name = "/srv/before" + bytes + "after.plumb";
    for (const std::string& line :
         {refusal("E-READ", name), reply({{"ok", true}, {"result", {{"file", name}}}})}) {
      const Json read = Json::parse(line, nullptr, false);
      ASSERT_TRUE(read.is_object()) << line;
      EXPECT_NE(line.find("/srv/before"), std::string::npos) << line;
      EXPECT_NE(line.find("after.plumb"), std::string::npos) << line;
    }
  }
}

}  // namespace
}  // namespace plumb::drivers::rt
