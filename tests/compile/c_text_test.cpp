// SPDX-License-Identifier: Apache-2.0
#include "compile/c_text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <regex>

#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

TEST(CIdentifier, ComesFromTheNameOfTheFile) {
  for (const auto& [file, name] :
       std::vector<std::pair<std::string, std::string>>{{"arm.h", "arm"},
                                                        {"out/Cell_7.h", "Cell_7"},
                                                        {"arm-4.left.h", "arm_4_left"},
                                                        {"7axis.h", "model_7axis"},
                                                        {"__arm__.h", "arm"},
                                                        {"a - b.h", "a_b"},
                                                        {"Öl.h", "l"},
                                                        {"東.h", "model"},
                                                        {".h", "h"},
                                                        {"", "model"}})
    EXPECT_EQ(c_identifier(file), name) << file;
}

TEST(CIdentifier, IsNeverReservedWhateverTheFileIsCalled) {
  tests::Random random(1);
  for (int i = 0; i < 20000; ++i) {
    std::string file;
    for (int k = random.below(12); k >= 0; --k)
      file += static_cast<char>(random.below(2) == 0 ? 1 + random.below(255) : "_-/.9a"[k % 6]);
    const std::string name = c_identifier(file);
    EXPECT_TRUE(std::regex_match(name, std::regex("[A-Za-z][A-Za-z0-9_]*"))) << name;
    EXPECT_EQ(name.find("__"), std::string::npos) << name;
    EXPECT_NE(name.back(), '_') << name;
  }
}

TEST(CCommentText, NeitherBeginsNorEndsACommentNorBreaksTheLine) {
  EXPECT_EQ(c_comment_text("Zelle 4 — 東"), "Zelle 4 — 東");
  EXPECT_EQ(c_comment_text("a */ int x; /* b"), "a * / int x; / * b");
  EXPECT_EQ(c_comment_text("*/*/*"), "* / * / *");
  EXPECT_EQ(c_comment_text("a\nb\r\tc\x7F"), "a b  c ");
  EXPECT_EQ(c_comment_text("left\u202Eright\u2066\u200F\u061C\u2028"), "left right    ");
  EXPECT_EQ(c_comment_text("*\x01/"), "* /");
}

TEST(CCommentText, LetsNoPairThroughWhateverItGets) {
  tests::Random random(2);
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (int k = random.below(20); k > 0; --k) text += "*/*/ \n\\?a"[random.below(9)];
    const std::string out = c_comment_text(text);
    EXPECT_EQ(out.find("*/"), std::string::npos);
    EXPECT_EQ(out.find("/*"), std::string::npos);
    EXPECT_EQ(out.find('\n'), std::string::npos);
  }
}

TEST(CNumber, ReadsBackToTheSameBitsAndIsADoubleInC) {
  tests::Random random(3);
  const auto holds = [](double x) {
    const std::string text = c_number(x);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)),
              std::bit_cast<std::uint64_t>(x))
        << text;
    EXPECT_NE(text.find_first_of(".e"), std::string::npos) << text;
  };
  for (const double x : {0.0, -0.0, 1.0, -3.0, 0.1, 1e16, 1e300, 5e-324, 0x1.fffffffffffffp1023})
    holds(x);
  for (long i = 0; i < tests::scaled(100000); ++i) {
    const double x = std::bit_cast<double>(random.bits());
    if (x - x == 0.0) holds(x);
  }
}

TEST(CTable, HoldsEveryNumberInOrderInLinesOfAHundredColumns) {
  std::vector<double> numbers;
  for (int i = 0; i < 60; ++i) numbers.push_back(i / 7.0);
  for (const std::size_t row : {1UL, 7UL, 60UL}) {
    const std::string text = c_table("t", numbers, row);
    EXPECT_EQ(text.rfind("static const double t[60] = {\n", 0), 0U) << text;
    for (std::size_t from = 0; from < text.size();) {
      const std::size_t end = text.find('\n', from);
      EXPECT_LE(end - from, 100U);
      from = end + 1;
    }
    const char* at = text.c_str() + text.find('{') + 1;
    for (const double x : numbers) {
      char* behind = nullptr;
      EXPECT_EQ(std::strtod(at, &behind), x);
      at = behind + 1;
    }
  }
}

}  // namespace
}  // namespace plumb::offline
