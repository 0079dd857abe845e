// SPDX-License-Identifier: Apache-2.0
// The examples of the reference pages are what the programs read.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "cell/table_file.hpp"

namespace plumb::offline {
namespace {

std::string page(const std::string& name) {
  std::ifstream file(std::string(PLUMB_SOURCE_DIR) + "/docs/" + name);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// What stands between the fences of one language.
std::vector<std::string> examples(const std::string& text, const std::string& language) {
  const std::string fence = "```" + language + "\n";
  std::vector<std::string> out;
  for (std::size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
    at += fence.size();
    const std::size_t end = text.find("```", at);
    out.push_back(text.substr(at, end - at));
    at = end;
  }
  return out;
}

TEST(ReferencePages, EveryCellFileOnThemIsRead) {
  const auto cells = examples(page("cell-file.md"), "toml");
  ASSERT_GE(cells.size(), 3U);
  for (const auto& text : cells) EXPECT_NO_THROW((void)parse_cell(text, "cell.toml")) << text;
}

TEST(ReferencePages, TheFirstCellFileSaysWhatThePageSays) {
  const Cell cell = parse_cell(examples(page("cell-file.md"), "toml").front(), "cell.toml");
  EXPECT_EQ(cell.joints(), 3);
  EXPECT_EQ(cell.serial, "F08-1234");
  EXPECT_DOUBLE_EQ(cell.tolerance_m, 1e-4);
  EXPECT_TRUE(cell.mechanics[1].parallel_next);
  EXPECT_DOUBLE_EQ(*cell.mechanics[1].link_mass_kg, 220.0);
  EXPECT_EQ(cell.effects.size(), 3U) << "geometry, compliance, ripple";
}

TEST(ReferencePages, EveryMeasurementFileOnThemIsRead) {
  const auto files = examples(page("measurements.md"), "csv");
  ASSERT_FALSE(files.empty());
  for (const auto& text : files) {
    const Table table = parse_table(text, "measurements.csv");
    EXPECT_EQ(table.rows(), 3);
    EXPECT_NE(table.find("x"), nullptr);
  }
}

TEST(ReferencePages, AKeyThatThePageDoesNotNameIsRefused) {
  std::string text = examples(page("cell-file.md"), "toml").front();
  text.replace(text.find("tolerance_mm"), 12, "tolerance_um");
  EXPECT_THROW((void)parse_cell(text, "cell.toml"), Failure);
}

}  // namespace
}  // namespace plumb::offline
