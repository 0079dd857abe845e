// SPDX-License-Identifier: Apache-2.0
// What is written, what is never overwritten, and what is left behind when it cannot be.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "sandbox.hpp"

namespace fs = std::filesystem;

namespace {

class Writing : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(box.plumb({"demo", "beam", "cell"}).exit, 0);
    ASSERT_EQ(box.plumb({"-C", "cell", "compile"}).exit, 0);
    box.write("dh.csv", "joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,0,500,0,0\nJ2,0,400,0,0\n");
  }

  /// Every verb that writes, to places where something stands already or nothing yet.
  static std::vector<std::vector<std::string>> writers() {
    return {
        {"demo", "beam", "cell"},
        {"new", "cell", "--dh", "dh.csv", "--convention", "standard"},
        {"-C", "cell", "simulate"},
        {"-C", "cell", "compile"},
        {"-C", "cell", "deploy", "-o", "cell"},
        {"-C", "cell", "dbc", "-o", "cell/cell.toml"},
        {"-C", "cell", "modbus-map", "-o", "cell/cell.toml"},
        {"-C", "cell", "report", "-o", "cell/cell.toml"},
        {"predict", "cell/robot.plumb", "--data", "cell/measurements.csv", "-o", "cell/cell.toml"},
        {"-C", "cell", "predict", "--as-measured", "-o", "cell/cell.toml"},
        {"correct", "cell/robot.plumb", "--data", "cell/targets.csv", "-o", "cell/cell.toml"},
        {"bench", "cell/robot.plumb", "--calls", "100", "-o", "cell/cell.toml"}};
  }
  Sandbox box;
};

TEST_F(Writing, NothingIsOverwrittenWithoutForce) {
  const auto before = box.listing();
  const std::string cell = box.read("cell/cell.toml"), data = box.read("cell/measurements.csv");
  for (const auto& words : writers()) {
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 2) << words[0] << words[2] << ran.err;
    const bool kept = words.back() == "cell/cell.toml";
    EXPECT_NE(ran.err.find(kept ? "error[E-OUTPUT-INPUT]" : "error[E-EXISTS]"), std::string::npos)
        << words[0] << words[2] << ran.err;
  }
  EXPECT_EQ(box.listing(), before);
  EXPECT_EQ(box.read("cell/cell.toml"), cell);
  EXPECT_EQ(box.read("cell/measurements.csv"), data);
}

TEST_F(Writing, ForceNeverReplacesWhatIsReadOrWorkedOnWhateverPathNamesIt) {
  const fs::path cell = box.path() / "cell";
  fs::create_symlink(cell / "cell.toml", box.path() / "link.toml");
  fs::create_hard_link(cell / "measurements.csv", box.path() / "hard.csv");
  fs::create_symlink(cell, box.path() / "same-folder");
  fs::copy_file(cell / "robot.plumb", box.path() / "copy.plumb");
  const std::string run = box.listing().empty() ? "" : "cell/runs/0001/run.json";
  const std::vector<std::string> kept{
      "cell/cell.toml", "cell/../cell/./cell.toml",     "link.toml", "cell/measurements.csv",
      "hard.csv",       "same-folder/measurements.csv", run};
  const auto before = box.listing();
  std::map<std::string, std::string> bytes;
  for (const auto& file : kept) bytes[file] = box.read(file);
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"-C", "cell", "compile"},
           {"-C", "cell", "report"},
           {"-C", "cell", "plot", "error-before-after"},
           {"-C", "cell", "plan", "--n", "5"},
           {"-C", "cell", "plan", "--recheck"},
           {"-C", "cell", "export"},
           {"-C", "cell", "dbc"},
           {"-C", "cell", "modbus-map"},
           {"-C", "cell", "predict", "--as-measured"},
           {"-C", "cell", "predict", "robot.plumb", "--data", "cell/targets.csv"},
           {"-C", "cell", "correct", "copy.plumb", "--data", "cell/targets.csv"},
           {"-C", "cell", "bench", "copy.plumb", "--calls", "100"}})
    for (const auto& file : kept) {
      auto forced = words;
      for (const char* more : {"-o", file.c_str(), "--force"}) forced.emplace_back(more);
      const Ran ran = box.plumb(forced);
      EXPECT_EQ(ran.exit, words[2] == "predict" && words[3] == "robot.plumb" ? 3 : 2)
          << words[2] << " " << file << ran.err;
      EXPECT_EQ(box.read(file), bytes[file]) << words[2] << " " << file;
    }
  EXPECT_EQ(box.listing(), before);
}

TEST_F(Writing, AnOutputIsNeverItsInput) {
  fs::copy_file(box.path() / "cell/robot.plumb", box.path() / "copy.plumb");
  fs::copy_file(box.path() / "cell/targets.csv", box.path() / "t.csv");
  box.write("raw.csv", box.read("cell/measurements.csv"));
  const std::string model = box.read("copy.plumb"), targets = box.read("t.csv"),
                    raw = box.read("raw.csv");
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"correct", "copy.plumb", "--data", "t.csv", "-o", "./t.csv"},
           {"correct", "copy.plumb", "--data", "t.csv", "-o", "copy.plumb"},
           {"predict", "copy.plumb", "--data", "raw.csv", "-o", "raw.csv"},
           {"-C", "cell", "predict", "--as-measured", "--data", "raw.csv", "-o", "raw.csv"},
           {"import", "raw.csv", "-o", "raw.csv"},
           {"-C", "cell", "import", "raw.csv", "-o", "cell/cell.toml"}}) {
    auto forced = words;
    forced.emplace_back("--force");
    const Ran ran = box.plumb(forced);
    EXPECT_EQ(ran.exit, 2) << words[0] << ran.err;
    EXPECT_NE(ran.err.find("error[E-OUTPUT-INPUT]"), std::string::npos) << words[0] << ran.err;
  }
  EXPECT_EQ(box.read("copy.plumb"), model);
  EXPECT_EQ(box.read("t.csv"), targets);
  EXPECT_EQ(box.read("raw.csv"), raw);
}

TEST_F(Writing, AVerbLooksAtItsOutputBeforeItWorks) {
  fs::remove_all(box.path() / "cell" / "runs");
  box.write("there", "");
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"-C", "cell", "compile", "-o", "there"},
           {"-C", "cell", "plan", "--recheck", "-o", "there"},
           {"-C", "cell", "plan", "-o", "there"},
           {"-C", "cell", "export", "-o", "there"},
           {"-C", "cell", "predict", "--as-measured", "-o", "there"},
           {"-C", "cell", "report", "-o", "there"}}) {
    EXPECT_EQ(box.plumb(words).exit, 2) << words[2];
    EXPECT_FALSE(fs::exists(box.path() / "cell" / "runs")) << words[2];
  }
}

TEST_F(Writing, ForceReplaces) {
  const std::string before = box.read("cell/measurements.csv");
  ASSERT_EQ(box.plumb({"-C", "cell", "simulate", "--seed", "3", "--force"}).exit, 0);
  EXPECT_NE(box.read("cell/measurements.csv"), before);
  EXPECT_EQ(box.plumb({"-C", "cell", "compile", "--force"}).exit, 0);
}

TEST_F(Writing, DryRunWritesNothing) {
  fs::remove_all(box.path() / "cell" / "runs");
  const auto before = box.listing();
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"demo", "beam", "new-one", "--dry-run"},
           {"new", "new-one", "--dh", "dh.csv", "--convention", "modified", "--dry-run"},
           {"-C", "cell", "simulate", "-o", "m.csv", "--truth", "t.json", "--dry-run"},
           {"-C", "cell", "fit", "--dry-run"},
           {"-C", "cell", "compile", "-o", "r.plumb", "--dry-run"},
           {"-C", "cell", "deploy", "-o", "d", "--dry-run"},
           {"-C", "cell", "dbc", "-o", "b.dbc", "--dry-run"},
           {"-C", "cell", "modbus-map", "-o", "m.md", "--dry-run"},
           {"predict", "cell/robot.plumb", "--data", "cell/measurements.csv", "-o", "p.csv",
            "--dry-run"},
           {"-C", "cell", "predict", "--as-measured", "-o", "p.csv", "--dry-run"},
           {"correct", "cell/robot.plumb", "--data", "cell/targets.csv", "-o", "c.csv",
            "--dry-run"}}) {
    EXPECT_EQ(box.plumb(words).exit, 0) << words[0] << words[2];
    EXPECT_EQ(box.listing(), before) << words[0] << words[2];
  }
}

TEST_F(Writing, AFolderIsNoFileToWrite) {
  fs::create_directory(box.path() / "there");
  for (const std::string name : {"new/", "new/sub/", "there", "there/"})
    for (const bool force : {false, true}) {
      std::vector<std::string> words{"-C", "cell", "compile", "-o", name};
      if (force) words.emplace_back("--force");
      const Ran ran = box.plumb(words);
      EXPECT_EQ(ran.exit, 2) << name << ran.err;
      EXPECT_NE(ran.err.find("is a folder, and a file is to be written"), std::string::npos)
          << ran.err;
      EXPECT_FALSE(fs::exists(box.path() / "new")) << name;
    }
}

TEST_F(Writing, ANewFolderIsSaidByEveryVerbAlike) {
  int i = 0;
  for (auto words : std::vector<std::vector<std::string>>{
           {"-C", "cell", "compile", "-o", "robot.plumb"},
           {"-C", "cell", "export", "-o", "arm.urdf"},
           {"-C", "cell", "dbc", "-o", "bus.dbc"},
           {"-C", "cell", "deploy", "-o", "deployed"},
           {"predict", "cell/robot.plumb", "--data", "cell/measurements.csv", "-o", "p.csv"},
           {"correct", "cell/robot.plumb", "--data", "cell/targets.csv", "-o", "c.csv"}}) {
    const std::string name = words.back(), folder = "gone" + std::to_string(i++);
    words.back() = folder + "/sub/" + name;
    words.emplace_back("--dry-run");
    const Ran dry = box.plumb(words);
    EXPECT_EQ(dry.exit, 0) << name << dry.err;
    EXPECT_NE(
        dry.err.find("note[N-WRITE-FOLDER]: there was no folder " + folder + ": it would be made"),
        std::string::npos)
        << name << dry.err;
    words.pop_back();
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 0) << name << ran.err;
    EXPECT_NE(ran.err.find("there was no folder " + folder + ": it was made"), std::string::npos)
        << name << ran.err;
    EXPECT_TRUE(fs::exists(box.path() / folder / "sub" / name)) << name;
    words.emplace_back("--force");
    EXPECT_EQ(box.plumb(words).err.find("N-WRITE-FOLDER"), std::string::npos) << name;
  }
  EXPECT_EQ(box.plumb({"demo", "beam", "asked/for"}).err, "");
}

TEST_F(Writing, AFolderThatCannotBeMadeIsExitFive) {
  const auto before = box.listing();
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"demo", "beam", "dh.csv/cell"},
           {"-C", "cell", "compile", "-o", "dh.csv/robot.plumb"},
           {"-C", "cell", "deploy", "-o", "dh.csv/deploy"},
           {"-C", "cell", "dbc", "-o", "dh.csv/bus.dbc"},
           {"predict", "cell/robot.plumb", "--data", "cell/measurements.csv", "-o", "dh.csv/p.csv"},
           {"correct", "cell/robot.plumb", "--data", "cell/targets.csv", "-o", "dh.csv/c.csv"}}) {
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 5) << words[0] << ran.err;
    EXPECT_EQ(box.listing(), before) << words[0];
  }
}

TEST_F(Writing, AFolderWithoutPermissionIsExitFiveAndStaysEmpty) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::create_directory(box.path() / "locked");
  fs::permissions(box.path() / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(box.plumb({"-C", "cell", "compile", "-o", "locked/robot.plumb"}).exit, 5);
  EXPECT_TRUE(fs::is_empty(box.path() / "locked"));
  fs::permissions(box.path() / "locked", fs::perms::owner_all);
}

TEST_F(Writing, ADeviceIsWrittenIntoWithoutForceAndStaysOne) {
  EXPECT_EQ(box.plumb({"-C", "cell", "compile", "-o", "/dev/null"}).exit, 0);
  EXPECT_EQ(box.plumb({"-C", "cell", "compile", "-o", "/dev/null", "--force"}).exit, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Writing, ACellThatCannotBeWrittenSaysWhichFolderDeniesIt) {
  fs::remove_all(box.path() / "cell" / "runs");
  box.write("cell/runs", "a file where the folder should be");
  const Ran ran = box.plumb({"-C", "cell", "fit"});
  EXPECT_EQ(ran.exit, 5);
  EXPECT_NE(ran.err.find("cannot write cell/runs: "), std::string::npos) << ran.err;
  EXPECT_EQ(ran.err.find(".draft"), std::string::npos) << ran.err;
  fs::remove(box.path() / "cell" / "runs");
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::permissions(box.path() / "cell", fs::perms::owner_read | fs::perms::owner_exec);
  const Ran denied = box.plumb({"-C", "cell", "fit"});
  fs::permissions(box.path() / "cell", fs::perms::owner_all);
  EXPECT_EQ(denied.exit, 5);
  EXPECT_NE(denied.err.find("Permission denied"), std::string::npos) << denied.err;
}

TEST_F(Writing, AFullStdoutIsExitFive) {
  EXPECT_EQ(box.plumb_into("/dev/full", {"-C", "cell", "compare"}).exit, 5);
  EXPECT_EQ(box.plumb_into("/dev/full", {"-C", "cell", "fit", "--json", "--dry-run"}).exit, 5);
}

TEST_F(Writing, AnInterruptIsExit130AndLeavesNothingHalfWritten) {
  const auto before = box.listing();
  const std::vector<std::string> slow{"-C", "cell",  "simulate", "--poses", "400000",
                                      "-o", "m.csv", "--truth",  "t.json",  "--json"};
  const Ran ran = box.plumb_interrupted(300, slow);
  EXPECT_EQ(ran.exit, 130);
  EXPECT_EQ(ran.json().at("error").at("exit"), 130);
  EXPECT_EQ(box.listing(), before);
}

TEST_F(Writing, WhatTakesLongerThanASecondSaysSoOnStderr) {
  const Ran ran = box.plumb_interrupted(
      1500, {"-C", "cell", "simulate", "--poses", "1000000", "-o", "m.csv", "--truth", "t.json"});
  EXPECT_EQ(ran.exit, 130);
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(ran.err.rfind("simulating 1000000 poses ...", 0), 0U) << ran.err;
  EXPECT_EQ(box.plumb({"-C", "cell", "fit", "--dry-run"}).err, "");
}

}  // namespace
