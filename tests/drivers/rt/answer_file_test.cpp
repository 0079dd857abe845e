// SPDX-License-Identifier: Apache-2.0
#include "rt/answer_file.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cerrno>
#include <fstream>
#include <sstream>

#include "plumb/drivers/bus_content.hpp"
#include "program/scratch_folder.hpp"
#include "tests/drivers/child.hpp"
#include "tests/drivers/rt/disk_limit.hpp"
#include "tests/drivers/rt/folder_text.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

class AnswerFiles : public testing::Test {
 protected:
  const ScratchFolder scratch{"plumb-answers-"};
  const fs::path file = scratch.path() / "corrected.csv";
};

Transformd pose_number(int i) {
  Transformd out;
  out.R = Eigen::AngleAxisd(0.1 * i, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).matrix();
  out.p = Vector3(0.001 * i, -0.5, 1.25);
  return out;
}

BusMessage answer(int i) {
  BusMessage out =
      pose_message(MessageKind::kCorrected, pose_number(i), static_cast<std::uint16_t>(i));
  out.time_ns = 4'000'000LL * i;
  return out;
}

TEST_F(AnswerFiles, EveryAnswerIsARowThatSaysItsTimeItsCounterAndItsPose) {
  constexpr int kAnswers = 40;
  {
    AnswerFile out(file);
    for (int i = 0; i < kAnswers; ++i) out.add(answer(i));
  }
  std::istringstream in(tests::whole_text(file));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "t_s,counter,cx_mm,cy_mm,cz_mm,cqw,cqx,cqy,cqz");
  for (int i = 0; i < kAnswers; ++i) {
    std::array<double, 9> v{};
    char comma = 0;
    for (double& one : v) in >> one >> comma;
    if (i + 1 < kAnswers) in.unget();  // the last "comma" was the first digit of the next line
    EXPECT_NEAR(v[0], 0.004 * i, 1e-6);
    EXPECT_EQ(v[1], i);
    EXPECT_LT((Vector3(v[2], v[3], v[4]) - 1e3 * pose_number(i).p).norm(), 2e-6);
    const Eigen::Quaterniond turn(v[5], v[6], v[7], v[8]);
    EXPECT_LT((turn.matrix() - pose_number(i).R).norm(), 1e-8);
  }
}

TEST_F(AnswerFiles, WhatIsNoCorrectedPoseIsNoRow) {
  AnswerFile out(file);
  out.write();
  const std::string head = tests::whole_text(file);
  out.add(pose_message(MessageKind::kTarget, pose_number(1), 1));
  out.add(pose_message(MessageKind::kActual, pose_number(1), 1));
  BusMessage no_pose = answer(1);
  no_pose.values[2] = std::numeric_limits<double>::quiet_NaN();
  out.add(no_pose);
  EXPECT_EQ(out.write(), 0);
  EXPECT_EQ(tests::whole_text(file), head);
}

/// What the next program reads as a row must be one, and somebody must hear of the rest.
TEST_F(AnswerFiles, AFullDiskHoldsWholeRowsAndIsTold) {
  std::string all;
  {
    AnswerFile out(file);
    for (int i = 0; i < 300; ++i) out.add(answer(i));
  }
  all = tests::whole_text(file);
  for (const std::size_t limit :
       {std::size_t{10}, std::size_t{60}, std::size_t{5'000}, all.size() - 1, all.size()}) {
    SCOPED_TRACE(limit);
    fs::remove(file);
    const int error = tests::in_child([&] {
      tests::limit_files(limit);
      AnswerFile out(file);
      for (int i = 0; i < 300; ++i) out.add(answer(i));
      return out.write();
    });
    EXPECT_EQ(error, limit < all.size() ? EFBIG : 0);
    const std::string held = tests::whole_text(file);
    EXPECT_EQ(held, all.substr(0, held.size()));
    EXPECT_TRUE(held.empty() || held.back() == '\n') << held.substr(held.rfind('\n'));
    EXPECT_GT(held.size() + 120, limit) << "all rows for which there was room";
  }
}

TEST_F(AnswerFiles, WhatIsThereIsRefusedBeforeAndThenAndStays) {
  std::ofstream(file) << "of a run before\n";
  fs::create_symlink("elsewhere", scratch.path() / "link");
  const auto before = tests::folder_text(scratch.path());
  for (const fs::path& name : {file, scratch.path() / "link", scratch.path() / "missing" / "x"}) {
    const Problem first = tests::problem_of([&] { AnswerFile::check(name); });
    const Problem then = tests::problem_of([&] { AnswerFile out(name); });
    EXPECT_EQ(first.code, "E-RT-SINK") << name;
    EXPECT_EQ(then.code, "E-RT-SINK") << name;
    EXPECT_EQ(first.message, then.message);
    EXPECT_NE(first.message.find(name.filename().string()), std::string::npos) << first.message;
  }
  AnswerFile::check(scratch.path() / "new.csv");
  EXPECT_EQ(tests::folder_text(scratch.path()), before) << "nothing is made by a look";
}

}  // namespace
}  // namespace plumb::drivers::rt
