// SPDX-License-Identifier: Apache-2.0
// The whole way: a cell with a tree, plumb compile --emit-c, the system's C compiler.
#include <gtest/gtest.h>

#include "../cli/sandbox.hpp"
#include "c_program.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/runtime/forward_model.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;
using tests::CProgram;

class EmitCVerb : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(box.plumb({"demo", "beam", "cell"}).exit, 0);
    const std::string cell = box.read("cell/cell.toml");
    const std::string line = "geometry = true\n";
    const std::size_t at = cell.find(line);
    ASSERT_NE(at, std::string::npos) << cell;
    box.write("cell/cell.toml", cell.substr(0, at + line.size()) + "[effects.local_tree]\n" +
                                    cell.substr(at + line.size()));
  }
  Ran compile(std::vector<std::string> more) const {
    std::vector<std::string> words{"-C", "cell", "compile"};
    words.insert(words.end(), more.begin(), more.end());
    return box.plumb(words);
  }
  Sandbox box;
};

TEST_F(EmitCVerb, WritesWhatSaysTheSameAsTheModelFileAtEveryMeasuredPose) {
  const Ran ran = compile({"--emit-c", "out/arm-4.h", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.json().at("result").at("c"), "out/arm-4.h");
  EXPECT_EQ(ran.json().at("result").at("files").size(), 2U);
  const std::string bytes = box.read("cell/robot.plumb");
  const auto read = format::read_model(std::as_bytes(std::span(bytes)));
  ASSERT_TRUE(std::holds_alternative<format::Model>(read));
  const ForwardModel arm(std::get<format::Model>(read));
  const CProgram program({{"arm-4.h", "arm_4", box.read("out/arm-4.h")}}, tests::kStrictC);
  ASSERT_EQ(program.complaint(), "");
  const Csv data = box.csv("cell/measurements.csv");
  double largest = 0.0;
  for (std::size_t row = 0; row < data.rows(); ++row) {
    std::vector<double> q;
    for (int i = 1; i <= arm.joints(); ++i)
      q.push_back(data.numbers("q" + std::to_string(i) + "_deg")[row] * M_PI / 180.0);
    const CProgram::Answer answer = program(0, q);
    const Vector3 wanted = arm.tree_error(q);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(answer.error_m[axis], wanted(static_cast<int>(axis)));
      largest = std::max(largest, std::abs(answer.error_m[axis]));
    }
  }
  std::printf("%zu poses, largest error %.3g m\n", data.rows(), largest);
  EXPECT_GT(largest, 1e-6);
}

TEST_F(EmitCVerb, NamesBothFilesAndReplacesNeitherWithoutForce) {
  const Ran ran = compile({"--emit-c", "arm.h"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.out.find("wrote arm.h\n"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("robot.plumb\n"), std::string::npos) << ran.out;
  fs::remove(box.path() / "cell/robot.plumb");
  box.write("arm.h", "mine");
  EXPECT_EQ(compile({"--emit-c", "arm.h"}).exit, 2);
  EXPECT_EQ(box.read("arm.h"), "mine");
  EXPECT_FALSE(fs::exists(box.path() / "cell/robot.plumb"));
  EXPECT_EQ(compile({"--emit-c", "arm.h", "--force"}).exit, 0);
  EXPECT_NE(box.read("arm.h"), "mine");
}

TEST_F(EmitCVerb, DryRunWritesNeither) {
  const auto before = box.listing();
  const Ran ran = compile({"--emit-c", "arm.h", "--dry-run"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.out.find("would write arm.h\n"), std::string::npos) << ran.out;
  EXPECT_EQ(box.listing(), before);
}

TEST_F(EmitCVerb, NeverTakesTheModelFileForTheC) {
  for (const auto* file : {"cell/robot.plumb", "./cell/../cell/robot.plumb"}) {
    const Ran ran = compile({"--emit-c", file, "--force"});
    EXPECT_EQ(ran.exit, 2);
    EXPECT_NE(ran.err.find("error[E-USAGE]"), std::string::npos) << ran.err;
  }
  EXPECT_FALSE(fs::exists(box.path() / "cell/robot.plumb"));
}

TEST(EmitCVerbAlone, ACellWithoutATreeIsExitThreeAndWritesNothing) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  const Ran ran = box.plumb({"-C", "cell", "compile", "--emit-c", "arm.h", "--json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_EQ(ran.json().at("error").at("code"), "E-EMIT-NO-TREE");
  EXPECT_FALSE(fs::exists(box.path() / "arm.h"));
  EXPECT_FALSE(fs::exists(box.path() / "cell/robot.plumb"));
  EXPECT_EQ(box.plumb({"explain", "E-EMIT-NO-TREE"}).exit, 0);
}

}  // namespace
}  // namespace plumb
