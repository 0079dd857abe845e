// SPDX-License-Identifier: Apache-2.0
#include "rt/check_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt/folder_text.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

class CheckSums : public testing::Test {
 protected:
  std::string sums() const { return folder.text("SHA256SUMS"); }
  Problem problem(const std::string& text) const {
    return tests::problem_of([&] { verify_sums(folder.folder, text, {model()}); });
  }
  fs::path model() const { return folder.folder / "robot.plumb"; }
  void change(const std::string& name) const {
    std::ofstream(folder.folder / name, std::ios::app) << "x";
  }
  /// What another program says of the folder.
  bool sha256sum_agrees() const {
    const std::string command =
        "cd " + folder.folder.string() + " && sha256sum --quiet --strict -c SHA256SUMS 2>/dev/null";
    return std::system((command + " >/dev/null").c_str()) == 0;
  }
  const tests::Deployed folder;
};

TEST_F(CheckSums, EveryFileThatChangedOrIsGoneIsFoundByNameAndNoOther) {
  EXPECT_EQ(problem(sums()).code, "");
  for (const char* const name : {"rt.toml", "robot.plumb", "targets.csv"}) {
    const tests::Deployed other;
    std::ofstream(other.folder / name, std::ios::app) << "x";
    for (const bool gone : {false, true}) {
      if (gone) fs::remove(other.folder / name);
      for (const SummedFile& file : read_sums(other.folder, other.text("SHA256SUMS")))
        EXPECT_EQ(file.state, file.name != name ? SummedFile::State::kAsListed
                              : gone            ? SummedFile::State::kMissing
                                                : SummedFile::State::kOther);
      const Problem found =
          tests::problem_of([&] { verify_sums(other.folder, other.text("SHA256SUMS"), {}); });
      EXPECT_EQ(found.code, "E-RT-SUMS");
      EXPECT_NE(found.message.find(name), std::string::npos) << found.message;
      EXPECT_NE(found.help.find("plumb-rt seal"), std::string::npos) << found.help;
    }
  }
}

TEST_F(CheckSums, AFolderInThePlaceOfAFileIsAMissingFile) {
  fs::remove(model());
  fs::create_directory(model());
  EXPECT_NE(problem(sums()).message.find("robot.plumb is missing"), std::string::npos);
}

TEST_F(CheckSums, TheOrderOfTheLinesAndHowTheyMarkTheirFilesChangeNothing) {
  std::vector<std::string> lines;
  std::istringstream in(sums());
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::sort(lines.begin(), lines.end());
  do {
    std::string text;
    for (const std::string& line : lines) text += line + "\n\n";
    text[64] = ' ';
    text[65] = '*';
    EXPECT_EQ(problem(text).code, "");
    EXPECT_EQ(listed_sums(folder.folder, text), listed_sums(folder.folder, sums()));
  } while (std::next_permutation(lines.begin(), lines.end()));
}

TEST_F(CheckSums, ALineThatIsNoSumAndAListThatLacksAFileAreRefused) {
  const std::string sum(64, 'a');
  for (const std::string& text :
       {std::string(), std::string("\n"), std::string("robot.plumb\n"), sum + "\n", sum + "  \n",
        sum + "a  robot.plumb\n", sum.substr(1) + "  robot.plumb\n",
        "A" + sum.substr(1) + "  robot.plumb\n", sums() + "# remark\n"}) {
    EXPECT_EQ(problem(text).code, "E-RT-SUMS") << text;
    EXPECT_EQ(tests::problem_of([&] { std::ignore = listed_sums(folder.folder, text); }).code,
              "E-RT-SUMS");
  }
  const std::string others = sums().substr(0, sums().find('\n') + 1);
  const std::string listed = others.substr(66, others.size() - 67);
  for (const char* const name : {"rt.toml", "robot.plumb", "targets.csv"}) {
    if (listed == name) continue;
    const auto found =
        tests::problem_of([&] { verify_sums(folder.folder, others, {folder.folder / name}); });
    EXPECT_NE(found.message.find(std::string("does not list ") + name), std::string::npos);
  }
}

/// Between the look and the reading a file may have become another one.
TEST_F(CheckSums, WhatWasReadIsJudgedByItsOwnSumNotByTheFile) {
  const std::string sum = sha256(tests::whole_text(model()));
  change("robot.plumb");
  refuse_other(folder.folder, sums(), model(), sum);
  const auto found = tests::problem_of(
      [&] { refuse_other(folder.folder, sums(), model(), sha256(tests::whole_text(model()))); });
  EXPECT_EQ(found.code, "E-RT-SUMS");
}

TEST_F(CheckSums, HoweverAFileIsNamedItsNameInTheListIsOne) {
  const fs::path below = folder.folder / "below";
  fs::create_directory(below);
  const fs::path before = fs::current_path();
  fs::current_path(below);
  for (const fs::path& own : {folder.folder, folder.folder / "", fs::path(".."), below / ".."})
    for (const fs::path& file : {model(), below / "../robot.plumb", fs::path("../robot.plumb")})
      EXPECT_EQ(listed_name(own, file), "robot.plumb") << own << " " << file;
  fs::current_path(before);
}

TEST_F(CheckSums, WhatIsRenewedHoldsForAnotherProgramAndIsTheSameTheNextTime) {
  ASSERT_TRUE(sha256sum_agrees());
  change("rt.toml");
  ASSERT_FALSE(sha256sum_agrees());
  renew_sums(folder.folder, model(), Renew::kConfiguration);
  EXPECT_TRUE(sha256sum_agrees());
  change("targets.csv");
  change("robot.plumb");
  renew_sums(folder.folder, model(), Renew::kAll);
  EXPECT_TRUE(sha256sum_agrees());
  EXPECT_EQ(problem(sums()).code, "");
  const std::string once = sums();
  renew_sums(folder.folder, model(), Renew::kAll);
  EXPECT_EQ(sums(), once);
}

/// Whoever edits rt.toml does not accept a model that somebody else replaced meanwhile.
TEST_F(CheckSums, RenewingTheConfigurationAcceptsNothingElseAndThenWritesNothing) {
  change("rt.toml");
  for (const char* const name : {"robot.plumb", "targets.csv"}) {
    const std::string whole = tests::whole_text(folder.folder / name);
    change(name);
    const auto before = tests::folder_text(folder.folder);
    const Problem found =
        tests::problem_of([&] { renew_sums(folder.folder, model(), Renew::kConfiguration); });
    EXPECT_EQ(found.code, "E-RT-SUMS");
    EXPECT_NE(found.message.find(name), std::string::npos) << found.message;
    EXPECT_EQ(tests::folder_text(folder.folder), before);
    std::ofstream(folder.folder / name, std::ios::binary) << whole;
  }
}

TEST_F(CheckSums, AllIsRenewedFromAListThatIsGoneAndWithoutFilesThatAre) {
  fs::remove(folder.folder / "targets.csv");
  renew_sums(folder.folder, model(), Renew::kAll);
  EXPECT_EQ(sums().find("targets.csv"), std::string::npos);
  EXPECT_TRUE(sha256sum_agrees());
  fs::remove(folder.folder / "SHA256SUMS");
  EXPECT_TRUE(renew_sums(folder.folder, model(), Renew::kAll).empty());
  EXPECT_EQ(problem(sums()).code, "");
}

TEST_F(CheckSums, ASignedFolderIsDeployedAgainNotSealed) {
  std::ofstream(folder.folder / "SHA256SUMS.sig") << "x\n";
  change("rt.toml");
  const Problem found = problem(sums());
  EXPECT_EQ(found.help.find("plumb-rt seal"), std::string::npos) << found.help;
  EXPECT_NE(found.help.find("--sign"), std::string::npos) << found.help;
}

}  // namespace
}  // namespace plumb::drivers::rt
