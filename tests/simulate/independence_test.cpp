// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace plumb::offline {
namespace {

// Included by `line`, or empty.
std::string included(const std::string& line) {
  static const std::regex include(R"re(^\s*#\s*include\s*["<]([^">]+)[">])re");
  std::smatch match;
  return std::regex_search(line, match, include) ? match[1].str() : "";
}

// The simulator may read cells and measurements and the plain structs of the chain; anything else
// of ours would be the code that it is there to test.
bool is_foreign(const std::string& header) {
  if (header.starts_with("plumb/")) return header != "plumb/format/model.hpp";
  for (const char* room : {"arm/", "solve/", "noise/", "fit/", "runs/", "catalogue/", "diagnose/",
                           "compile/", "show/", "cli/", "../"}) {
    if (header.starts_with(room)) return true;
  }
  return header.find("runtime") != std::string::npos;
}

TEST(Independence, TheSimulatorIncludesNothingOfTheRuntimeOrTheFit) {
  int files = 0;
  const std::filesystem::path room = std::filesystem::path(PLUMB_SOURCE_DIR) / "offline/simulate";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(room)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".txt") continue;
    ++files;
    std::ifstream text(entry.path());
    for (std::string line; std::getline(text, line);) {
      EXPECT_FALSE(is_foreign(included(line))) << entry.path() << ": " << line;
    }
  }
  EXPECT_GT(files, 20);
}

TEST(Independence, TheSimulatorLinksNothingOfTheRuntime) {
  std::ifstream file(std::filesystem::path(PLUMB_SOURCE_DIR) / "offline/simulate/CMakeLists.txt");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(text.find("plumb_runtime"), std::string::npos);
  EXPECT_EQ(text.find("Plumb::runtime"), std::string::npos);
}

TEST(Independence, APlantedIncludeIsSeen) {
  EXPECT_TRUE(is_foreign(included("#include \"plumb/runtime/chain.hpp\"")));
  EXPECT_TRUE(is_foreign(included("  # include <plumb/runtime/detail/effects/gear.hpp>")));
  EXPECT_TRUE(is_foreign(included("#include \"../../runtime/src/x.hpp\"")));
  EXPECT_TRUE(is_foreign(included("#include \"arm/arm_state.hpp\"")));
  EXPECT_FALSE(is_foreign(included("#include \"plumb/format/model.hpp\"")));
  EXPECT_FALSE(is_foreign(included("#include <vector>")));
}

}  // namespace
}  // namespace plumb::offline
