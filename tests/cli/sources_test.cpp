// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "sandbox.hpp"

namespace fs = std::filesystem;

namespace {

/// Codes that stand in the sources as "E-...", "W-..." or "N-...".
std::set<std::string> codes_in_sources() {
  const std::regex code("\"([EWN]-[A-Z0-9]+(-[A-Z0-9]+)*)\"");
  std::set<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(PLUMB_SOURCES)) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream in(entry.path());
    std::ostringstream text;
    text << in.rdbuf();
    const std::string all = text.str();
    for (std::sregex_iterator it(all.begin(), all.end(), code), end; it != end; ++it)
      out.insert((*it)[1]);
  }
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
