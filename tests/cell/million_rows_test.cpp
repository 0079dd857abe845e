// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "cell/measurement_reader.hpp"
#include "cell/measurements.hpp"
#include "cell/table_blocks.hpp"
#include "cell/table_file.hpp"
#include "support.hpp"
#include "tests/yardstick.hpp"

namespace plumb::offline {
namespace {

#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr int kRows = 1000000;
constexpr double kMost_s = 4.0;  // 1.3 s on an idle machine; the mark is 2 s
#else
constexpr int kRows = 20000;
constexpr double kMost_s = 60.0;
#endif
constexpr double kMostMemory_MB = 1000.0;

double peak_memory_MB() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1000.0;
  return 0.0;
}

std::string long_file(int rows) {
  std::string text = "pose,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,temp_degC\n";
  unsigned state = 1;
  const auto number = [&] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 4) * 1e-6 - 134.0;
  };
  for (int i = 0; i < rows; ++i) {
    fmt::format_to(std::back_inserter(text), "P{:07}", i / 3);
    for (int k = 0; k < 10; ++k) fmt::format_to(std::back_inserter(text), ",{:.6f}", number());
    text += '\n';
  }
  return text;
}

TEST(MillionRows, AreReadInSecondsAndInLessThanAGigabyte) {
  const Folder folder;
  const auto file = folder.put("long.csv", long_file(kRows));
  const double start = tests::processor_s();
  const auto m = read_measurements({file}, std::vector<bool>(6, true), Needs::kJointsAndPosition);
  const double taken = tests::processor_s() - start;
  std::printf("%d rows in %.2f s, at most %.0f MB\n", m.size(), taken, peak_memory_MB());
  EXPECT_EQ(m.size(), kRows);
  EXPECT_LT(taken, kMost_s * tests::times_slower());
  EXPECT_LT(peak_memory_MB(), kMostMemory_MB);
}

TEST(BlocksOfATable, AreItsRowsAndLeaveNoneOut) {
  const Folder folder;
  const auto file = folder.put("long.csv", long_file(30000));
  const Table whole = read_table(file);
  int rows = 0, blocks = 0;
  const std::string sum = read_blocks(file, [&](const Table& block) {
    ++blocks;
    EXPECT_LT(block.rows(), whole.rows());
    ASSERT_EQ(block.columns.size(), whole.columns.size());
    const auto first = static_cast<std::size_t>(rows);
    for (std::size_t i = 0; i < block.lines.size(); ++i) {
      ASSERT_EQ(block.lines[i], whole.lines[first + i]);
      ASSERT_EQ(block.columns[0].text[i], whole.columns[0].text[first + i]);
      ASSERT_EQ(block.columns[7].values[i], whole.columns[7].values[first + i]);
    }
    rows += block.rows();
  });
  EXPECT_EQ(rows, whole.rows());
  EXPECT_GT(blocks, 1);
  EXPECT_EQ(sum, whole.sha256);
}

TEST(BlocksOfATable, OneWithABadCellIsRefusedWithItsLine) {
  const Folder folder;
  const std::string text = long_file(30000);
  const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  const auto file = folder.put("long.csv", text + "P1,1,2,3,4,5,six,7,8,9,20\n");
  try {
    read_blocks(file, [](const Table&) {});
    FAIL() << "not refused";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.problems().front().code, "E-CSV-NUMBER");
    EXPECT_EQ(failure.problems().front().place->line, lines + 1);
  }
}

}  // namespace
}  // namespace plumb::offline
