// SPDX-License-Identifier: Apache-2.0
// Short judgements of the program: what is lost, times, numbers of a file, listed names, keys.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "program/problem.hpp"
#include "rt/listed_files.hpp"
#include "rt/lost_words.hpp"
#include "rt/packing_text.hpp"
#include "rt/record_settings.hpp"
#include "rt/trusted_keys.hpp"
#include "rt/utc.hpp"
#include "rt/whole_number.hpp"

namespace plumb::drivers::rt {
namespace {

TEST(LostWords, EveryBitHasAWordOfItsOwn) {
  std::set<std::string> words;
  Lost all = Lost::kNothing;
  for (int i = 0; i < kLostBits; ++i) {
    const auto one = static_cast<Lost>(1U << static_cast<unsigned>(i));
    const auto own = lost_words(one);
    ASSERT_EQ(own.size(), 1U) << i;
    EXPECT_TRUE(words.insert(own[0]).second) << own[0];
    all = all | one;
  }
  EXPECT_TRUE(lost_words(Lost::kNothing).empty());
  EXPECT_EQ(lost_words(all).size(), static_cast<std::size_t>(kLostBits));
}

TEST(LostWords, OfTwoSetsAreThoseOfEither) {
  for (int a = 0; a < kLostBits; ++a)
    for (int b = 0; b < a; ++b) {
      const auto one = static_cast<Lost>(1U << static_cast<unsigned>(a));
      const auto other = static_cast<Lost>(1U << static_cast<unsigned>(b));
      const auto both = lost_words(one | other);
      ASSERT_EQ(both.size(), 2U);
      EXPECT_STREQ(both[0], to_string(other)) << "in the order of their bits";
      EXPECT_STREQ(both[1], to_string(one));
    }
}

TEST(LostWords, OnlyARefusalHasAText) {
  EXPECT_EQ(refusal_text({}), "");
  std::set<std::string> texts;
  for (std::uint32_t exception = 1; exception <= 11; ++exception) {
    WriteRefusal refusal;
    refusal.first = 1200;
    refusal.count = 16;
    refusal.exception = exception;
    const std::string text = refusal_text(refusal);
    EXPECT_NE(text.find("registers 1200 to 1215"), std::string::npos) << text;
    EXPECT_TRUE(texts.insert(text).second) << text;
  }
}

TEST(PackingText, OnlyAPackingThatDiffersHasAText) {
  EXPECT_EQ(packing_text({}, {}), "");
  EXPECT_EQ(packing_text({.words = RegisterPacking::Words::kAll}, {}), "")
      << "a message that the layout does not have";
}

TEST(Utc, TheOrderOfTheTextsIsThatInTime) {
  std::string before = utc_second(0);
  EXPECT_EQ(before, "1970-01-01T00:00:00Z");
  for (std::int64_t s = 1; s < 4'000'000'000; s = s * 7 / 4 + 1) {
    const std::string text = utc_second(s);
    EXPECT_LT(before, text);
    EXPECT_TRUE(is_utc_second(text)) << text;
    EXPECT_EQ(utc_text(1000 * s + 7), text.substr(0, 19) + ".007Z");
    before = text;
  }
}

TEST(Utc, AKnownMomentHasItsText) {
  EXPECT_EQ(utc_second(951'827'696), "2000-02-29T12:34:56Z");
  EXPECT_EQ(utc_second(1'764'042'646), "2025-11-25T03:50:46Z");
}

TEST(Utc, WhatIsNoTimeIsNone) {
  const std::string good = "2026-11-25T03:50:46Z";
  ASSERT_TRUE(is_utc_second(good));
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string other = good;
    other[i] = 'x';
    EXPECT_FALSE(is_utc_second(other)) << other;
    EXPECT_FALSE(is_utc_second(good.substr(0, i))) << good.substr(0, i);
  }
  for (const char* text :
       {"2026-00-25T03:50:46Z", "2026-13-25T03:50:46Z", "2026-11-00T03:50:46Z",
        "2026-11-32T03:50:46Z", "2026-11-25T24:50:46Z", "2026-11-25T03:60:46Z",
        "2026-11-25T03:50:61Z", "2026-11-25T03:50:46.123Z", "2026-11-25 03:50:46Z"})
    EXPECT_FALSE(is_utc_second(text)) << text;
}

/// Reads `key = TEXT` as a whole number from 1 to 9, 5 if nothing is said.
int whole(const std::string& text) {
  TomlSource source("rt.toml", text, "E-RT");
  const toml::table root = source.parse();
  TomlTable table(root, "", source);
  int out = 5;
  read_whole(table, "key", {1, 9}, out);
  source.stop_on_errors();
  return out;
}

TEST(WholeNumber, IsReadWithinItsRangeAndNothingElseIs) {
  EXPECT_EQ(whole(""), 5);
  for (int value = 1; value <= 9; ++value)
    EXPECT_EQ(whole("key = " + std::to_string(value)), value);
  EXPECT_EQ(whole("key = 3.0"), 3);
  for (const char* text : {"0", "10", "-3", "2.5", "nan", "inf", "-inf", "1e300", "\"3\"", "true"})
    EXPECT_THROW(whole(std::string("key = ") + text), Failure) << text;
}

TEST(RecordSettings, AFileIsAtMostAQuarterOfTheWhole) {
  for (const int total : {0, 1, 40, 399, 400, 401, 100'000})
    for (const int file : {1, 100, 5000}) {
      RecordSettings settings;
      settings.max_file_mb = file;
      settings.max_total_mb = total;
      EXPECT_GT(settings.file_bytes(), 0U);
      EXPECT_LE(settings.file_bytes(), 1'000'000U * static_cast<std::uint64_t>(file));
      EXPECT_TRUE(total == 0 || 4 * settings.file_bytes() <= settings.total_bytes());
    }
}

TEST(ListedFiles, NamesInsideOfTheFolderAreListedInTheirOrder) {
  const std::string sum(64, 'a');
  EXPECT_THROW(listed_files("folder", ""), Failure) << "a list that is empty vouches for nothing";
  const auto names = listed_files(
      "folder", sum + "  rt.toml\n\n" + sum + " *models/arm.plumb\n" + sum + "  a b.dbc\n");
  EXPECT_EQ(names, (std::vector<std::string>{"rt.toml", "models/arm.plumb", "a b.dbc"}));
}

TEST(ListedFiles, ANameThatCouldLieOutsideOfTheFolderIsRefused) {
  const std::string sum(64, 'a');
  for (const char* name : {"/etc/passwd", "../other", "models/../../other", "models/../arm",
                           "./arm", "models/", ".", "..", "SHA256SUMS", "SHA256SUMS.sig"})
    EXPECT_THROW(listed_files("folder", sum + "  " + name + "\n"), Failure) << name;
  EXPECT_THROW(listed_files("folder", sum + "  a" + std::string(1, '\0') + "b\n"), Failure);
}

TEST(ListedFiles, ALineThatIsNoSumIsRefused) {
  const std::string sum(64, 'a');
  for (const std::string& line :
       {sum, sum + "  ", sum.substr(1) + "  rt.toml", "a" + sum + "  rt.toml",
        std::string(64, 'A') + "  rt.toml", std::string("rt.toml")})
    EXPECT_THROW(listed_files("folder", line + "\n"), Failure) << line;
}

TEST(TrustedKeys, AKeyThatAnyFileRevokesIsRevokedInEveryOrder) {
  KnownKey good{.name = "good", .key = {}}, bad = good, other = good;
  bad.name = "bad";
  bad.trust = KnownKey::Trust::kRevoked;
  other.name = "other";
  other.key.bytes[0] = 1;
  ASSERT_NE(other.key.id(), good.key.id());
  for (const std::vector<KnownKey>& keys : {std::vector{good, bad, other},
                                            {bad, good, other},
                                            {other, bad, good},
                                            {good, other, bad}}) {
    const TrustedKeys all{.keys = keys, .problems = {}};
    EXPECT_EQ(all.find(good.key.id())->trust, KnownKey::Trust::kRevoked);
    EXPECT_EQ(all.find(other.key.id())->trust, KnownKey::Trust::kTrusted);
    EXPECT_EQ(all.find("0123456789abcdef"), nullptr);
  }
}

TEST(TrustedKeys, AFaultOfRightsIsAProblemAndNoFaultIsNone) {
  EXPECT_TRUE(rights_problem("a.pub", "").empty());
  const auto problems = rights_problem("a.pub", "may be written by others");
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].code, "E-RT-KEYS");
}

}  // namespace
}  // namespace plumb::drivers::rt
