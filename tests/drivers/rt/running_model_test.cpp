// SPDX-License-Identifier: Apache-2.0
#include "rt/running_model.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "plumb/drivers/bus_content.hpp"
#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt/folder_text.hpp"
#include "tests/drivers/rt/problem_of.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

class RunningModels : public testing::Test {
 protected:
  static Problem refusal_of(const fs::path& file, const std::string& serial = "") {
    return tests::problem_of([&] { std::ignore = load_model(file, serial); });
  }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder.folder / name, std::ios::binary) << text;
    return folder.folder / name;
  }
  const tests::Deployed folder;
  const fs::path file = folder.folder / "robot.plumb";
  const std::string bytes = tests::whole_text(file);
};

TEST_F(RunningModels, ItIsTheModelThatWasWrittenUnderTheFingerprintOfItsSum) {
  const RunningModel read = load_model(file, "UR-1");
  EXPECT_EQ(read.loaded->model(), tests::Deployed::arm());
  EXPECT_EQ(read.sha256, sha256(bytes));
  EXPECT_EQ(read.loaded->number(), fingerprint(sha256(bytes)));
}

TEST_F(RunningModels, FilesThatDifferHaveDifferentNumbersWhateverTheyAreCalled) {
  format::Model other = tests::Deployed::arm();
  other.calibrated.joints[2].a += 1e-9;
  folder.write_model("other.plumb", other);
  const std::uint32_t own = load_model(file, "").loaded->number();
  EXPECT_NE(load_model(folder.folder / "other.plumb", "").loaded->number(), own);
  EXPECT_EQ(load_model(write("same", bytes), "").loaded->number(), own);
}

TEST_F(RunningModels, OnlyTheRobotThatIsAskedForIsTaken) {
  for (const char* const serial : {"UR-2", "UR-", "ur-1", "UR-1 "}) {
    const Problem problem = refusal_of(file, serial);
    EXPECT_EQ(problem.code, "E-RT-SERIAL") << serial;
    for (const std::string& word : {std::string("'UR-1'"), std::string("'") + serial + "'"})
      EXPECT_NE(problem.message.find(word), std::string::npos) << problem.message;
  }
  EXPECT_EQ(refusal_of(file, "UR-1").code, "");
  EXPECT_EQ(refusal_of(file, "").code, "") << "nobody asked";
}

TEST_F(RunningModels, AFileThatWasCutOrChangedAnywhereIsRefusedByItsName) {
  tests::Random random(91);
  for (long i = 0; i < tests::scaled(200); ++i) {
    const auto at =
        static_cast<std::size_t>(random.uniform(0.0, 1.0) * static_cast<double>(bytes.size() - 1));
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    for (const std::string& bad : {changed, bytes.substr(0, at)}) {
      const Problem problem = refusal_of(write("bad one.plumb", bad));
      EXPECT_EQ(problem.code, "E-RT-MODEL") << at;
      EXPECT_NE(problem.message.find("bad one.plumb"), std::string::npos) << problem.message;
      EXPECT_NE(problem.help.find("bad one.plumb'"), std::string::npos) << "in quotes for a shell";
    }
  }
}

/// A pipe would be waited for, and a file without end would fill the memory.
TEST_F(RunningModels, WhatIsNoRegularFileOfAModelsSizeIsNotRead) {
  const fs::path pipe = folder.folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const fs::path large = write("large", bytes);
  fs::resize_file(large, kMostModelBytes + 1);
  for (const fs::path& one :
       {pipe, large, folder.folder, folder.folder / "none", fs::path("/dev/zero")})
    EXPECT_EQ(refusal_of(one).code.substr(0, 6), "E-READ") << one;
  fs::resize_file(large, kMostModelBytes);
  EXPECT_EQ(refusal_of(large).code, "E-RT-MODEL") << "it is read, and is no model";
}

}  // namespace
}  // namespace plumb::drivers::rt
