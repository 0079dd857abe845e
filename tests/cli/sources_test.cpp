// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "sandbox.hpp"

namespace fs = std::filesystem;

namespace {

bool is_code(const std::string& text) {
  if (text.size() < 3 || text[1] != '-' || std::string("EWN").find(text[0]) == std::string::npos)
    return false;
  return text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-") == std::string::npos;
}

/// Codes that stand in the sources as "E-...", "W-..." or "N-...".
std::set<std::string> codes_in_sources() {
  std::set<std::string> out;
  for (const char* half : {"offline", "drivers"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(PLUMB_SOURCES) / half)) {
      if (entry.path().extension() != ".cpp") continue;
      std::ifstream in(entry.path());
      for (std::string part; std::getline(in, part, '"');)
        if (is_code(part)) out.insert(part);
    }
  // With what the codes of a file's problems begin.
  for (const char* prefix : {"E-CELL", "E-RT", "E-TWIN"}) out.erase(prefix);
  return out;
}

std::set<std::string> explained() {
  const Sandbox box;
  std::set<std::string> out;
  const auto json = box.plumb({"explain", "--json"}).json();
  for (const auto& name : json.at("result").at("code")) out.insert(name.get<std::string>());
  return out;
}

TEST(Codes, EveryCodeOfTheSourcesIsExplained) {
  const auto known = explained();
  const auto used = codes_in_sources();
  std::printf("%zu codes in the sources, %zu explained\n", used.size(), known.size());
  EXPECT_GT(used.size(), 30U);
  for (const auto& code : used) EXPECT_TRUE(known.contains(code)) << code;
}

}  // namespace
