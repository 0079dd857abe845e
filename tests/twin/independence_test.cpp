// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace plumb::offline::twin {
namespace {

/// The header that a line includes, or empty.
std::string included(const std::string& line) {
  if (line.find("#include") == std::string::npos) return "";
  const auto begin = line.find_first_of("\"<"), end = line.find_last_of("\">");
  return begin == std::string::npos ? "" : line.substr(begin + 1, end - begin - 1);
}

/// Of the runtime the twin may know how a pose is written, which the bus needs, and nothing that
/// computes with an arm; nor the fit, whose result it is to test.
bool is_foreign(const std::string& header) {
  if (header.starts_with("plumb/runtime/")) return header != "plumb/runtime/transform.hpp";
  for (const char* room : {"arm/", "solve/", "noise/", "fit/", "runs/", "catalogue/", "diagnose/",
                           "compile/", "show/"})
    if (header.starts_with(room)) return true;
  return header == "plumb/drivers/session.hpp" || header == "plumb/drivers/session_sync.hpp";
}

TEST(Independence, TheTwinUsesNoMathematicsOfTheRuntimeOrTheFit) {
  int files = 0;
  const auto room = std::filesystem::path(PLUMB_SOURCE_DIR) / "offline/twin";
  for (const auto& entry : std::filesystem::directory_iterator(room)) {
    std::ifstream text(entry.path());
    ++files;
    for (std::string line; std::getline(text, line);)
      EXPECT_FALSE(is_foreign(included(line))) << entry.path() << ": " << line;
  }
  EXPECT_GT(files, 20);
}

TEST(Independence, APlantedIncludeIsSeen) {
  EXPECT_TRUE(is_foreign(included("#include \"plumb/runtime/chain.hpp\"")));
  EXPECT_TRUE(is_foreign(included("#include <plumb/runtime/detail/effects/gear.hpp>")));
  EXPECT_TRUE(is_foreign(included("#include \"arm/parameter.hpp\"")));
  EXPECT_FALSE(is_foreign(included("#include \"plumb/runtime/transform.hpp\"")));
  EXPECT_FALSE(is_foreign(included("// arm/parameter.hpp")));
}

}  // namespace
}  // namespace plumb::offline::twin
