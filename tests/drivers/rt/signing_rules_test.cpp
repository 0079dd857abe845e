// SPDX-License-Identifier: Apache-2.0
#include "rt/signing_rules.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "program/key_file.hpp"
#include "program/scratch_folder.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;
using Unsigned = SigningRules::Unsigned;

/// The settings of a machine, in a folder of its own.
class SigningRuleFiles : public testing::Test {
 protected:
  SigningRuleFiles() {
    fs::create_directories(keys);
    for (const fs::path& folder : {etc, keys}) ::chmod(folder.c_str(), 0755);
  }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(etc / file) << text;
    ::chmod((etc / file).c_str(), 0644);
  }
  SigningRules rules() const { return read_signing_rules(etc); }
  std::string code() const {
    return tests::problem_of([&] { std::ignore = rules(); }).code;
  }
  const ScratchFolder scratch{"plumb-etc-"};
  const fs::path etc = scratch.path() / "etc", keys = etc / "keys.d";
};

TEST_F(SigningRuleFiles, SignaturesAreDemandedAsSoonAsTheFolderOfKeysIsThere) {
  EXPECT_EQ(rules().unsigned_folders, Unsigned::kRefused) << "although it is empty";
  EXPECT_TRUE(rules().demanded());
  fs::remove(keys);
  EXPECT_EQ(rules().unsigned_folders, Unsigned::kNoKeys);
  EXPECT_FALSE(rules().demanded());
  fs::remove(etc);
  EXPECT_EQ(rules().unsigned_folders, Unsigned::kNoKeys);
}

/// Who can break keys.d must not have done away with the demand.
TEST_F(SigningRuleFiles, AFolderOfKeysThatCannotBeReadDemandsAllTheSame) {
  fs::remove(keys);
  fs::create_symlink("nowhere", keys);
  EXPECT_EQ(rules().unsigned_folders, Unsigned::kRefused);
  fs::remove(keys);
  std::ofstream(keys) << "a file";
  EXPECT_EQ(rules().unsigned_folders, Unsigned::kRefused);
}

TEST_F(SigningRuleFiles, SettingsThatOthersMayWriteWaiveNothing) {
  write("plumb-rt.toml", "unsigned = \"allowed\"\n");
  ASSERT_EQ(rules().unsigned_folders, Unsigned::kAllowed);
  for (const fs::path& open : {etc, keys})
    for (const mode_t mode : {0775U, 0757U}) {
      ::chmod(open.c_str(), mode);
      const SigningRules found = rules();
      EXPECT_TRUE(found.keys.keys.empty()) << open;
      EXPECT_EQ(found.keys.problems.size(), 1U) << open;
      if (open == etc) {
        EXPECT_EQ(found.unsigned_folders, Unsigned::kRefused) << mode;
      }
      ::chmod(open.c_str(), 0755);
    }
  ::chmod((etc / "plumb-rt.toml").c_str(), 0666);
  EXPECT_EQ(code(), "E-RT-KEYS");
}

TEST_F(SigningRuleFiles, OnlyTheWordAllowedAllows) {
  for (const auto& [text, wanted] :
       {std::pair{"", ""}, std::pair{"unsigned = \"refused\"\n", ""},
        std::pair{"unsigned = \"Allowed\"\n", "E-RT-RANGE"},
        std::pair{"unsigned = true\n", "E-RT-TYPE"}, std::pair{"unsigned = allowed\n", "E-TOML"},
        std::pair{"unsignd = \"allowed\"\n", "E-RT-KEY"}}) {
    write("plumb-rt.toml", text);
    EXPECT_EQ(code(), wanted) << text;
    if (std::string(wanted).empty()) {
      EXPECT_EQ(rules().unsigned_folders, Unsigned::kRefused) << text;
    }
  }
  fs::remove(etc / "plumb-rt.toml");
  fs::create_symlink("nowhere", etc / "plumb-rt.toml");
  EXPECT_NE(code(), "") << "settings that cannot be read are not those that are absent";
}

TEST_F(SigningRuleFiles, WhatIsWaivedIsSaidWithWhoWaivesItAndWhatIsRefusedNeedsNoWords) {
  SigningRules some;
  some.etc = "/etc/plumb";
  EXPECT_EQ(some.unsigned_note(), "");
  some.unsigned_folders = Unsigned::kAllowed;
  EXPECT_NE(some.unsigned_note().find("/etc/plumb/plumb-rt.toml"), std::string::npos);
  some.unsigned_folders = Unsigned::kNoKeys;
  EXPECT_NE(some.unsigned_note().find("no keys"), std::string::npos);
}

TEST_F(SigningRuleFiles, AKeyThatIsNoneIsAWarningOfAFolderThatRunsAndTheOthersCount) {
  std::ignore = write_new_keys(scratch.path() / "anna");
  write("keys.d/anna.pub",
        (std::ostringstream() << std::ifstream(scratch.path() / "anna.pub").rdbuf()).str());
  write("keys.d/broken.pub", "plumb-ed25519 AAAA\n");
  const SigningRules found = rules();
  EXPECT_EQ(found.keys.keys.size(), 1U);
  ASSERT_EQ(found.keys.problems.size(), 1U);
  const auto warnings = key_warnings(found);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].severity, Severity::kWarning);
  EXPECT_EQ(warnings[0].code, "W-RT-KEYS");
  EXPECT_EQ(warnings[0].message, found.keys.problems[0].message);
}

}  // namespace
}  // namespace plumb::drivers::rt
