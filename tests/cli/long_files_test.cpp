// SPDX-License-Identifier: Apache-2.0
// predict and correct on files that are longer than what is read at a time.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <thread>

#include "sandbox.hpp"

namespace {

using Lines = std::vector<std::string>;

constexpr int kRows = 50000;
constexpr int kPiece = 4000;  // rows that are read at once

/// Header and rows of a file, without comments.
Lines lines_of(const std::string& text) {
  Lines out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with('#')) out.push_back(line);
  return out;
}

std::string text_of(const Lines& lines) {
  std::string out;
  for (const auto& line : lines) out += line + "\n";
  return out;
}

/// The rows over and over, each with a note of its own behind.
Lines repeated(const Lines& lines, int rows) {
  Lines out{lines[0] + ",note"};
  for (int i = 0; i < rows; ++i)
    out.push_back(lines[1 + static_cast<std::size_t>(i) % (lines.size() - 1)] + ",\"row, " +
                  std::to_string(i) + "\"");
  return out;
}

/// This thread, and the programs it starts, on one core while it lives.
class OneCore {
 public:
  OneCore() {
    sched_getaffinity(0, sizeof(before_), &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
      if (CPU_ISSET(cpu, &before_)) {
        CPU_SET(cpu, &one);
        break;
      }
    sched_setaffinity(0, sizeof(one), &one);
  }
  ~OneCore() { sched_setaffinity(0, sizeof(before_), &before_); }

 private:
  cpu_set_t before_;
};

class LongFiles : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "gear", "cell"}).exit, 0);
    ASSERT_EQ(box->plumb({"-C", "cell", "compile"}).exit, 0);
    poses = repeated(lines_of(box->read("cell/measurements.csv")), kRows);
    targets = repeated(lines_of(box->read("cell/targets.csv")), kRows);
    box->write("poses.csv", text_of(poses));
    box->write("targets.csv", text_of(targets));
  }
  static void TearDownTestSuite() { delete box; }

  static Ran run(const std::string& verb, const std::string& data, const std::string& out) {
    return box->plumb({verb, "cell/robot.plumb", "--data", data, "-o", out, "--force", "--json"});
  }

  /// The output of pieces that are each read at once, put together.
  static std::string piecewise(const std::string& verb, const Lines& lines) {
    std::string out;
    for (std::size_t at = 1; at < lines.size(); at += kPiece) {
      Lines piece{lines[0]};
      for (std::size_t i = at; i < std::min(at + kPiece, lines.size()); ++i)
        piece.push_back(lines[i]);
      box->write("piece.csv", text_of(piece));
      EXPECT_EQ(run(verb, "piece.csv", "piece_out.csv").exit, 0);
      const std::string text = box->read("piece_out.csv");
      out += at == 1 ? text : text.substr(text.find('\n') + 1);
    }
    return out;
  }

  static void expect_the_same_bytes(const std::string& verb, const Lines& lines) {
    const std::string data = verb == "predict" ? "poses.csv" : "targets.csv";
    const Ran ran = run(verb, data, "whole.csv");
    ASSERT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.json().at("result").at("rows"), kRows);
    const std::string whole = box->read("whole.csv");
    EXPECT_TRUE(whole == piecewise(verb, lines));
    const OneCore one;
    ASSERT_EQ(run(verb, data, "one.csv").exit, 0);
    EXPECT_TRUE(box->read("one.csv") == whole);
  }

  static Sandbox* box;
  static Lines poses, targets;
};
Sandbox* LongFiles::box = nullptr;
Lines LongFiles::poses;
Lines LongFiles::targets;

TEST_F(LongFiles, ArePredictedToTheBytesOfTheirPiecesOnAnyNumberOfCores) {
  expect_the_same_bytes("predict", poses);
}

TEST_F(LongFiles, AreCorrectedToTheBytesOfTheirPiecesOnAnyNumberOfCores) {
  expect_the_same_bytes("correct", targets);
}

TEST_F(LongFiles, WithoutJointStatesEachTargetBeginsWhereTheLastOneEnded) {
  const Lines lines = lines_of(box->read("cell/targets.csv"));
  const Csv csv = parse_csv(text_of(lines));
  std::string start, rows = "x_mm,y_mm,z_mm\n";
  for (int j = 1; j <= 6; ++j)
    start += (j == 1 ? "" : ",") + csv.columns.at("q" + std::to_string(j) + "_deg")[0];
  // 25 mm there and back over several blocks: every step needs a joint state to begin from.
  const double x = csv.numbers("x_mm")[0], y = csv.numbers("y_mm")[0], z = csv.numbers("z_mm")[0];
  std::ostringstream text;
  for (int i = 0; i < kRows; ++i)
    text << x << ',' << y + 0.001 * (i < kRows / 2 ? i : kRows - i) << ',' << z << '\n';
  box->write("path.csv", rows + text.str());
  const Ran ran = box->plumb({"correct", "cell/robot.plumb", "--data", "path.csv",
                              "--start=" + start, "-o", "path_out.csv", "--force", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.json().at("result").at("corrected"), kRows);
}

TEST_F(LongFiles, AllThatIsWrongIsSaidInOnePassAndNothingIsWritten) {
  Lines bad = poses;
  bad[10] += ",1";
  bad[20000] = "x" + bad[20000].substr(0, bad[20000].find(','));
  const auto q1 = bad[45000].find(',') + 1;
  bad[45000].insert(q1, "abc");
  box->write("bad.csv", text_of(bad));
  const auto before = box->listing();
  const Ran ran = run("predict", "bad.csv", "new/out.csv");
  EXPECT_EQ(ran.exit, 3);
  const auto problems = ran.json().at("error").at("problems");
  ASSERT_EQ(problems.size(), 3U) << ran.out;
  EXPECT_EQ(problems[0].at("place").at("line"), 11) << problems.dump();
  EXPECT_EQ(problems[1].at("place").at("line"), 20001);
  EXPECT_EQ(problems[2].at("place").at("line"), 45001);
  EXPECT_EQ(problems[2].at("code"), "E-CSV-NUMBER");
  EXPECT_EQ(box->listing(), before);
}

TEST_F(LongFiles, WhatIsWrongWithTheHeaderIsSaidOnce) {
  Lines bad = poses;
  bad[0].replace(bad[0].find("q3_deg"), 6, "r3_deg");
  box->write("bad.csv", text_of(bad));
  const Ran ran = run("predict", "bad.csv", "out.csv");
  EXPECT_EQ(ran.exit, 3);
  EXPECT_EQ(ran.json().at("error").at("count"), 1) << ran.out;
}

TEST_F(LongFiles, APipeIsReadAndWrittenAsAFileIs) {
  ASSERT_EQ(run("predict", "poses.csv", "file.csv").exit, 0);
  const std::string in = (box->path() / "in").string(), out = (box->path() / "out").string();
  ASSERT_EQ(::mkfifo(in.c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo(out.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(in, std::ios::binary) << text_of(poses); });
  std::string got;
  std::thread reader([&] {
    std::ifstream from(out, std::ios::binary);
    std::ostringstream all;
    all << from.rdbuf();
    got = all.str();
  });
  const Ran ran = box->plumb({"predict", "cell/robot.plumb", "--data", "in", "-o", "out"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  writer.join();
  reader.join();
  ::unlink(in.c_str());
  ::unlink(out.c_str());
  EXPECT_TRUE(got == box->read("file.csv"));
  const Ran to_stdout = box->plumb({"predict", "cell/robot.plumb", "--data", "poses.csv"});
  EXPECT_TRUE(to_stdout.out == got);
}

TEST_F(LongFiles, AnInterruptLeavesNothingBehind) {
  const std::string in = (box->path() / "slow").string();
  ASSERT_EQ(::mkfifo(in.c_str(), 0600), 0);
  const int fd = ::open(in.c_str(), O_RDWR);
  std::thread writer([&] {
    const std::string text = text_of({poses.begin(), poses.begin() + 20000});
    std::string_view rest = text;
    for (ssize_t n = 1; n > 0 && !rest.empty(); rest.remove_prefix(static_cast<std::size_t>(n)))
      n = std::max<ssize_t>(0, ::write(fd, rest.data(), rest.size()));
  });
  const auto before = box->listing();
  const Ran ran = box->plumb_interrupted(
      500, {"predict", "cell/robot.plumb", "--data", "slow", "-o", "slow_out.csv"});
  EXPECT_EQ(ran.exit, 130);
  EXPECT_EQ(box->listing(), before);
  ::fcntl(fd, F_SETFL, O_NONBLOCK);
  std::string drain(1 << 16, '\0');
  while (::read(fd, drain.data(), drain.size()) > 0) {
  }
  writer.join();
  ::close(fd);
  ::unlink(in.c_str());
}

TEST_F(LongFiles, AnEndlessLineIsOneErrorWithItsNumber) {
  box->write("endless.csv", poses[0] + "\n" + poses[1] + "\n" + std::string(3 << 20, '1') + "\n");
  for (const std::string verb : {"predict", "correct"}) {
    const Ran ran = run(verb, "endless.csv", "out.csv");
    EXPECT_EQ(ran.exit, 3);
    EXPECT_EQ(ran.json().at("error").at("code"), "E-CSV-LINE") << ran.out;
    EXPECT_EQ(ran.json().at("error").at("place").at("line"), 3) << ran.out;
    EXPECT_EQ(ran.json().at("error").at("count"), 1);
    const Ran device = run(verb, "/dev/zero", "out.csv");
    EXPECT_EQ(device.exit, 3);
    EXPECT_EQ(device.json().at("error").at("code"), "E-CSV-LINE") << device.out;
  }
}

TEST_F(LongFiles, NeedNoMoreMemoryThanShortOnes) {
  if (PLUMB_TIMED == 0) GTEST_SKIP() << "sanitizers keep what was freed";
  box->write("longer.csv", text_of(repeated(lines_of(box->read("cell/measurements.csv")), 200000)));
  ASSERT_EQ(run("predict", "longer.csv", "out.csv").exit, 0);
  rusage used{};
  ::getrusage(RUSAGE_CHILDREN, &used);  // the most of all programs so far
  EXPECT_LT(used.ru_maxrss, 300 * 1024);
}

}  // namespace
