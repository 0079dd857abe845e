// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <fstream>
#include <iterator>
#include <string>

#include "import/imported_csv.hpp"
#include "import/importer.hpp"
#include "tests/import/temporary_file.hpp"

namespace plumb::offline {
namespace {

constexpr int kRows = 50000;
constexpr double kMostOfTheFile = 4.0;  // 2.5 as measured; texts and rows of their own took 7

/// "VmRSS", the memory in use, or "VmHWM", the most that was.
double memory_MB(const std::string& which) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(which + ":")) return std::stod(line.substr(which.size() + 1)) / 1024.0;
  return 0.0;
}

void forget_the_most() { std::ofstream("/proc/self/clear_refs") << 5; }

std::string long_log(char separator, char decimal) {
  std::string out =
      fmt::format("{}\n", fmt::join({"pose", "Timestamp", "q1_deg", "q2_deg", "q3_deg", "q4_deg",
                                     "q5_deg", "q6_deg", "x_mm", "y_mm", "z_mm", "temp_degC"},
                                    std::string(1, separator)));
  for (int i = 0; i < kRows; ++i) {
    fmt::format_to(std::back_inserter(out), "P{}{}2022-10-{:02} {:02}:{:02}:{:02}", i / 3,
                   separator, 1 + i / 86400, i / 3600 % 24, i / 60 % 60, i % 60);
    for (int k = 0; k < 10; ++k)
      fmt::format_to(std::back_inserter(out), "{}-{}{}{:06}", separator, 20 + k, decimal,
                     i * 7919L % 1000000);
    out += '\n';
  }
  return out;
}

/// The most memory that reading and writing takes, as a multiple of the file.
double memory_of(const std::string& bytes) {
  const tests::TemporaryFolder folder;
  const auto file = folder.put("log.txt", bytes);
  const double size_MB = static_cast<double>(bytes.size()) / (1 << 20);
  ::malloc_trim(0);  // what other tests have freed
  forget_the_most();
  const double before = memory_MB("VmRSS");
  const Imported data = import_file(file, {});
  std::size_t written = 0;
  check_imported(data);
  write_imported(data, [&](std::string_view block) { written += block.size(); });
  EXPECT_EQ(data.rows(), kRows);
  EXPECT_GT(written, bytes.size() / 2);
  return (memory_MB("VmHWM") - before) / size_MB;
}

TEST(ImportOfALongFile, TakesLittleMoreMemoryThanTheFile) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const double points = memory_of(long_log(',', '.')), commas = memory_of(long_log(';', ','));
  std::printf("%.2f times the file, with decimal commas %.2f\n", points, commas);
  EXPECT_LT(points, kMostOfTheFile);
  EXPECT_LT(commas, kMostOfTheFile);
#else
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
}

}  // namespace
}  // namespace plumb::offline
