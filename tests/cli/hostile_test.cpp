// SPDX-License-Identifier: Apache-2.0
// Two programs at once, full disks, files without end, text that a terminal would obey, and values
// on the command line that mean nothing.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <thread>

#include "sandbox.hpp"

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// No file of ours or of a child may grow beyond `bytes` while this lives: a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit now = before_;
    now.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

/// The folder of a cell, locked as another plumb would.
class OtherPlumb {
 public:
  explicit OtherPlumb(const fs::path& cell)
      : fd_(::open(cell.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    EXPECT_EQ(::flock(fd_, LOCK_EX), 0);
  }
  ~OtherPlumb() { ::close(fd_); }

 private:
  int fd_;
};

void make_cell(const Sandbox& box) {
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "simulate", "--poses", "60", "--force"}).exit, 0);
}

TEST(CellLock, WhoeverChangesACellWaitsForTheOtherAndReadingDoesNot) {
  const Sandbox box;
  make_cell(box);
  ASSERT_EQ(box.plumb({"-C", "cell", "fit"}).exit, 0);
  auto other = std::make_unique<OtherPlumb>(box.path() / "cell");
  EXPECT_EQ(box.plumb({"-C", "cell", "runs"}).exit, 0);
  EXPECT_EQ(box.plumb({"-C", "cell", "compare"}).exit, 0);
  std::thread ends([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    other.reset();
  });
  const Ran ran = box.plumb({"-C", "cell", "fit"});
  ends.join();
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(has(ran.err, "waiting for another plumb in this cell")) << ran.err;
}

TEST(CellLock, AnInterruptEndsTheWait) {
  const Sandbox box;
  make_cell(box);
  const OtherPlumb other(box.path() / "cell");
  const std::string before = box.read("cell/cell.toml");
  const Ran ran = box.plumb_interrupted(300, {"-C", "cell", "add", "gravity_sag"});
  EXPECT_EQ(ran.exit, 130) << ran.err;
  EXPECT_EQ(box.read("cell/cell.toml"), before);
}

TEST(FullDiskOf, EveryWriterIsExitFiveAndLeavesNothing) {
  const Sandbox box;
  make_cell(box);
  ASSERT_EQ(box.plumb({"-C", "cell", "compile"}).exit, 0);
  const auto before = box.listing();
  for (const Words& words : std::vector<Words>{
           {"-C", "cell", "fit"},
           {"-C", "cell", "compile", "--force"},
           {"-C", "cell", "simulate", "-o", "m.csv", "--truth", "t.json"},
           {"predict", "cell/robot.plumb", "--data", "cell/measurements.csv", "-o", "p.csv"}}) {
    Ran ran;
    {
      const FullDisk full(900);
      ran = box.plumb(words);
    }
    EXPECT_EQ(ran.exit, 5) << words[0] << words[2] << ran.err;
    EXPECT_EQ(box.listing(), before) << words[0] << words[2];
  }
}

TEST(Terminal, NothingOfAFileReachesItRaw) {
  const Sandbox box;
  const std::string evil = "\\u001b[31mred\\u0007\\u009b2J\\u202eleft";
  make_cell(box);
  std::string cell = box.read("cell/cell.toml");
  const auto at = cell.find("[robot]\nname = \"");
  ASSERT_NE(at, std::string::npos);
  cell.insert(at + 16, evil);
  cell.insert(cell.find("[cell]\nname = \"") + 15, evil);
  box.write("cell/cell.toml", cell);
  box.write("bad.csv", "pose\x1b[2J,q1_deg\x07,x\n1,2,3\n");
  for (const Words& words : std::vector<Words>{{"-C", "cell", "fit"},
                                               {"-C", "cell", "compile", "--force"},
                                               {"-C", "cell", "check"},
                                               {"inspect", "cell/robot.plumb"},
                                               {"inspect", "no\x1b[2J.plumb"},
                                               {"\x1b[2J"},
                                               {"import", "bad.csv", "--preview"}}) {
    const Ran ran = box.plumb(words);
    for (const char* raw : {"\x1b", "\x07", "\xc2\x9b", "\xe2\x80\xae"}) {
      EXPECT_FALSE(has(ran.out, raw)) << words[0] << ran.out;
      EXPECT_FALSE(has(ran.err, raw)) << words[0] << ran.err;
    }
  }
}

TEST(Compile, WarnsOfACellWithoutSerialNumber) {
  const Sandbox box;
  make_cell(box);
  EXPECT_FALSE(has(box.plumb({"-C", "cell", "compile"}).err, "W-COMPILE-SERIAL"));
  std::string cell = box.read("cell/cell.toml");
  const auto at = cell.find("serial = \"") + 10;
  cell.erase(at, cell.find('"', at) - at);
  box.write("cell/cell.toml", cell);
  const Ran ran = box.plumb({"-C", "cell", "compile", "--force"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_TRUE(has(ran.err, "warning[W-COMPILE-SERIAL]")) << ran.err;
}

TEST(Compile, RefusesARunThatWasEditedAndRunsListsItAsDamaged) {
  const Sandbox box;
  make_cell(box);
  ASSERT_EQ(box.plumb({"-C", "cell", "fit"}).exit, 0);
  std::string run = box.read("cell/runs/0001/run.json");
  const auto at = run.find("\"mean_m\": ");
  run[run.find_first_of("123456789", at)] = '0';
  box.write("cell/runs/0001/run.json", run);
  for (const Words& words : std::vector<Words>{{"-C", "cell", "compile"},
                                               {"-C", "cell", "compare"},
                                               {"-C", "cell", "compare", "1"},
                                               {"-C", "cell", "predict", "--as-measured"}}) {
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 3) << words[2] << ran.err;
    EXPECT_TRUE(has(ran.err, "error[E-RUN-DAMAGED]")) << ran.err;
    EXPECT_TRUE(has(ran.err, "runs/0001/run.json")) << ran.err;
  }
  const Ran runs = box.plumb({"-C", "cell", "runs"});
  EXPECT_EQ(runs.exit, 0);
  EXPECT_TRUE(has(runs.out, "0001: damaged")) << runs.out;
  EXPECT_TRUE(has(runs.err, "warning[W-RUN-DAMAGED]")) << runs.err;
  EXPECT_FALSE(has(runs.err, "E-RUN")) << runs.err;
  EXPECT_EQ(box.plumb({"-C", "cell", "fit"}).exit, 0);
  EXPECT_EQ(box.plumb({"-C", "cell", "compile"}).exit, 0);
}

TEST(New, WritesWhatItReadsBackWhateverTheNames) {
  const Sandbox box;
  box.write("dh.csv",
            "joint,alpha_deg,a_mm,d_mm,theta_deg,q_min_deg,q_max_deg,q_min_mm,q_max_mm,type\n"
            "\"a\"\"b\\c\",90,0,0,0,-90,90,,,revolute\n"
            "x.y,0,1e-300,1e5,1e-9,,,0,1500,prismatic\n"
            "x y,0,0,0,0,,,,,\n"
            "x_y,0,0,0,0,,,,,prismatic\n"
            "Gelenk-\xc3\xb6,0,0.1,0,0,,,,,revolute\n");
  const Ran made = box.plumb({"new", "cell", "--dh", "dh.csv", "--convention", "modified", "--name",
                              "quote \" back\\slash \x1b \xff", "--json"});
  ASSERT_EQ(made.exit, 0) << made.err;
  EXPECT_TRUE(has(made.out, "N-NEW-JOINT"));
  const std::string cell = box.read("cell/cell.toml");
  EXPECT_TRUE(has(cell, "q = [0, 1500]")) << cell;
  EXPECT_TRUE(has(cell, "wide limits are assumed")) << cell;
  EXPECT_EQ(box.plumb({"-C", "cell", "simulate", "--poses", "5"}).exit, 0);
}

TEST(Option, OfEveryVerbRefusesWhatMeansNothing) {
  const Sandbox box;
  make_cell(box);
  box.write("a.csv", "pose,q1_deg,x_mm\n1,2,3\n");
  struct Case {
    Words verb;
    std::string option;
    Words bad;
  };
  const Words numbers{"nan", "inf", "-inf", "1x", "", "-1", "1e999", "0x1p3"};
  const std::vector<Case> cases{
      {{"-C", "cell", "fit"}, "--max-rms", numbers},
      {{"-C", "cell", "fit"}, "--seed", {"nan", "-1", "1.5", "1x", "99999999999999999999"}},
      {{"-C", "cell", "fit"}, "--held-out", {"nan", "nan%", "0%", "100%", "-5%", "kfold:1", "x"}},
      {{"-C", "cell", "fit"}, "--base", {"x", "nan"}},
      {{"-C", "cell", "plan"}, "--n", {"nan", "0", "-1", "1.5", "1x", "99999999999"}},
      {{"-C", "cell", "plan"}, "--pool", {"nan", "0", "-1", "1x"}},
      {{"-C", "cell", "plan"}, "--joint-limits", {"nan", "nan%", "0%", "-5%", "200%", "inf", "x"}},
      {{"-C", "cell", "plan"},
       "--box",
       {"nan,1,0,1,0,1", "-inf,inf,0,1,0,1", "1,2,3", "1,0,0,1,0,1"}},
      {{"-C", "cell", "plan"}, "--separate", {"x", "reversal:J2"}},
      {{"-C", "cell", "simulate", "--force"}, "--noise-um", {"nan", "inf", "-1", "1x"}},
      {{"-C", "cell", "simulate", "--force"}, "--noise-urad", {"nan", "inf", "-1", "1x"}},
      {{"-C", "cell", "simulate", "--force"}, "--geometry-mm", {"nan", "inf", "-1", "1x"}},
      {{"-C", "cell", "simulate", "--force"}, "--geometry-mrad", {"nan", "inf", "-1", "1x"}},
      {{"-C", "cell", "simulate", "--force"}, "--richness", {"nan", "inf", "-1", "1x"}},
      {{"-C", "cell", "simulate", "--force"},
       "--joint-scatter-urad",
       {"nan", "inf", "-1", "1x", "1,2"}},
      {{"-C", "cell", "simulate", "--force"}, "--encoder-step-urad", {"nan", "inf", "-1", "1x"}},
      {{"-C", "cell", "simulate", "--force"}, "--true-gravity", {"nan,0,0", "inf,0,0", "1,2", "x"}},
      {{"-C", "cell", "simulate", "--force"}, "--coupled-drives", {"J1", "J9", "x"}},
      {{"-C", "cell", "simulate", "--force"}, "--revisits", {"nan", "-1", "1.5", "1000"}},
      {{"-C", "cell", "simulate", "--force"}, "--seconds", numbers},
      {{"-C", "cell", "simulate", "--force"}, "--poses", {"nan", "0", "-1", "1.5", "1x"}},
      {{"-C", "cell", "simulate", "--force"}, "--repeats", {"nan", "0", "-1", "1.5", "1x"}},
      {{"-C", "cell", "simulate", "--force"}, "--grid", {"nan", "1", "-1", "1x"}},
      {{"-C", "cell", "simulate", "--force"}, "--payloads", {"nan", "inf", "-1", "1x"}},
      {{"-C", "cell", "simulate", "--force"}, "--outliers", {"nan%", "-1%", "101%", "x", "inf%"}},
      {{"-C", "cell", "simulate", "--force"}, "--held", {"nan%", "-1%", "101%", "x"}},
      {{"-C", "cell", "simulate", "--force"}, "--range", {"nan%", "-1%", "0%", "101%", "x"}},
      {{"-C", "cell", "simulate", "--force"}, "--mass-error", {"nan%", "-1%", "101%", "x"}},
      {{"-C", "cell", "simulate", "--force"}, "--order", {"x"}},
      {{"import", "a.csv", "--preview"}, "--rot", {"abc", "xyz", "xxz-fixed", "xyz-turning"}},
      {{"import", "a.csv", "--preview"}, "--join", {"x", "pose", "time", "order"}},
      {{"import", "a.csv", "--preview"}, "--max-gap", {"nan", "inf", "-1", "0", "1x", "5"}},
      {{"import", "a.csv", "--preview"}, "--separator", {"xx"}},
      {{"import", "a.csv", "--preview"}, "--decimal", {"x"}},
      {{"import", "a.csv", "--preview"}, "--dir", {"x"}},
      {{"study", "planar"}, "--noise-um", {"nan", "inf", "-1", "1x"}},
      {{"study", "planar"}, "--draws", {"nan", "0", "-1", "1x"}},
      {{"study", "planar"}, "--variant", {"x"}},
      {{"new", "d", "--dh", "a.csv"}, "--convention", {"x"}},
      {{"bench", "m.plumb"}, "--max-us", numbers},
      {{"bench", "m.plumb"}, "--calls", {"nan", "0", "-1", "1x"}},
      {{"-C", "cell", "predict", "--as-measured"}, "--run", {"nan", "-1", "0", "1x", "x"}},
      {{"-C", "cell", "export"}, "--run", {"nan", "-1", "0", "1x", "x"}}};
  for (const auto& [verb, option, bad] : cases)
    for (const auto& value : bad) {
      Words words = verb;
      words.push_back(option + "=" + value);
      const Ran ran = box.plumb(words);
      EXPECT_EQ(ran.exit, 2) << option << "=" << value << "\n" << ran.err;
      EXPECT_TRUE(has(ran.err, "= help: ")) << option << "=" << value << "\n" << ran.err;
    }
}

}  // namespace
