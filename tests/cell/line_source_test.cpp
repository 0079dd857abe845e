// SPDX-License-Identifier: Apache-2.0
#include "cell/line_source.hpp"
#include "cell/table_file.hpp"

#include "cell/measurements.hpp"
#include "program/file.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

std::string numbered(int lines) {
  std::string out;
  for (int i = 1; i <= lines; ++i) out += std::to_string(i) + "," + std::string(i % 97, 'x') + "\n";
  return out;
}

TEST(LineSource, GivesTheFileInWholeLinesWithTheirNumbersAndItsHash) {
  const Folder folder;
  for (const std::string end : {"", "the last line has no line break"}) {
    const std::string text = numbered(60000) + end;
    LineSource source(folder.put("long.csv", text));
    std::string all, block;
    int blocks = 0;
    for (; source.next(block); ++blocks) {
      EXPECT_EQ(std::to_string(source.first_line()), block.substr(0, block.find(',')));
      all += block;
      EXPECT_TRUE(block.ends_with('\n') || all.size() == text.size());
      EXPECT_LT(block.size(), LineSource::kBlock + (1 << 19));
    }
    EXPECT_GT(blocks, 2);
    EXPECT_TRUE(all == text);
    EXPECT_EQ(source.sha256(), sha256(text));
    EXPECT_EQ(source.size(), text.size());
  }
}

TEST(LineSource, RefusesALineOfMoreThanAMegabyteButNotOneOfThatLength) {
  const Folder folder;
  const std::string longest(LineSource::kLongestLine, '1');
  const auto read = [&](const std::string& text) {
    LineSource source(folder.put("t.csv", text));
    std::string block;
    while (source.next(block)) {
    }
  };
  for (const auto& before : {std::string(), numbered(3), numbered(40000)})
    for (const std::string end : {"", "\n", "\n1,x\n"}) {
      const int line = before.empty() ? 1 : before.size() < 1000 ? 4 : 40001;
      EXPECT_EQ(summary(problems_of([&] { read(before + longest + end); })), Summary{});
      EXPECT_EQ(summary(problems_of([&] { read(before + longest + "1" + end); })),
                Summary{"E-CSV-LINE " + std::to_string(line) + ":0"});
    }
}

TEST(LineSource, ADeviceWithoutEndIsAnError) {
  EXPECT_EQ(summary(problems_of([] { read_table("/dev/zero"); })), Summary{"E-CSV-LINE 1:0"});
}

TEST(LineSource, TheWrongBytesAndCellsOfALongFileKeepTheirPlaces) {
  const Folder folder;
  std::string text = "q1_deg,x_mm\n";
  for (int i = 2; i <= 200000; ++i) text += i == 150000 ? "1,x\n" : "1.25,100.5\n";
  EXPECT_EQ(summary(problems_of([&] { read_table(folder.put("t.csv", text)); })),
            Summary{"E-CSV-NUMBER 150000:3"});
  text[text.size() - 3] = '\xFF';
  EXPECT_EQ(summary(problems_of([&] { read_table(folder.put("t.csv", text)); })),
            Summary{"E-CSV-UTF8 200000:9"});
}

}  // namespace
}  // namespace plumb::offline
