// SPDX-License-Identifier: Apache-2.0
// Where diagnose finds structure that no effect explains, it offers formulas that can be pasted.
#include <gtest/gtest.h>

#include <cstdio>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

/// The words of a command behind "plumb ", as a shell takes them apart.
std::vector<std::string> words_of(const std::string& command) {
  const std::string plumb = "plumb ";
  EXPECT_EQ(command.substr(0, plumb.size()), plumb);
  FILE* shell = popen(("printf '%s\\n' " + command.substr(plumb.size())).c_str(), "r");
  std::string out;
  for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell)) out += static_cast<char>(c);
  pclose(shell);
  std::vector<std::string> words;
  for (std::size_t at = 0, end = 0; (end = out.find('\n', at)) != std::string::npos; at = end + 1)
    words.push_back(out.substr(at, end - at));
  return words;
}

std::vector<std::string> in_cell(std::vector<std::string> words) {
  words.insert(words.begin(), {"-C", "cell"});
  return words;
}

TEST(FormulaOffer, WorksWhenItsCommandIsPasted) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "unknown", "cell"}).exit, 0);
  const Ran ran = box.plumb(in_cell({"diagnose", "--json"}));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Json result = ran.json().at("result");
  ASSERT_EQ(result.at("verdict"), "unknown") << result.at("verdict_text");
  ASSERT_FALSE(result.at("formulas").empty());
  const Json& first = result.at("formulas").front();
  const double promised_mm = first.at("held_out_after_mm");
  EXPECT_LT(promised_mm, 0.5 * result.at("held_out_before_mm").get<double>());
  EXPECT_FALSE(first.at("curve").at("points").empty());
  bool said = false;
  for (const auto& block : result.at("blocks"))
    said = said ||
           (block.contains("words") &&
            block.at("words").get<std::string>().find(
                "A law that fits: " + first.at("formula").get<std::string>()) != std::string::npos);
  EXPECT_TRUE(said);
  auto words = words_of(first.at("command"));
  words.push_back("--json");
  const Ran added = box.plumb(in_cell(words));
  ASSERT_EQ(added.exit, 0) << added.err;
  EXPECT_NEAR(added.json().at("result").at("after").at("mean_mm").get<double>(), promised_mm,
              0.03 * promised_mm);
  EXPECT_NE(box.read("cell/cell.toml").find("effects.formula"), std::string::npos);
  const Json again = box.plumb(in_cell({"diagnose", "--json"})).json().at("result");
  EXPECT_NE(again.at("verdict"), "unknown") << again.at("verdict_text");
}

TEST(FormulaOffer, IsNotMadeWhereAnEffectOfTheLibraryIsMissing) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "compliance", "cell"}).exit, 0);
  const Json result = box.plumb(in_cell({"diagnose", "--json"})).json().at("result");
  EXPECT_TRUE(result.at("formulas").empty());
}

}  // namespace
