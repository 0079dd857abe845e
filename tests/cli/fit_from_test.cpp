// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "sandbox.hpp"

namespace {

namespace fs = std::filesystem;

/// The readings of the cell `arm` beyond the first ones go to later.csv.
void keep_first_rows(const Sandbox& box, int first) {
  std::istringstream all(box.read("arm/measurements.csv"));
  std::string line, head, early, late;
  int row = 0;
  while (std::getline(all, line)) {
    const bool header = line.starts_with("#") || line.starts_with("pose");
    (header ? head : row < first ? early : late) += line + "\n";
    if (!header) ++row;
  }
  ASSERT_GT(row, first + 20);
  box.write("arm/measurements.csv", head + early);
  box.write("later.csv", head + late);
}

/// A cell with run 1 on most of its readings; the last ones are later.csv.
class FitFrom : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "clean", "arm"}).exit, 0);
    keep_first_rows(*box, 200);
    ASSERT_EQ(box->plumb({"-C", "arm", "fit"}).exit, 0);
  }
  static void TearDownTestSuite() { delete box; }

  /// Exit 0 and `from` of the result.
  static nlohmann::ordered_json from(std::vector<std::string> words) {
    words.push_back("--json");
    const Ran ran = box->plumb(words);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.json()["result"]["from"];
  }
  static Sandbox* box;
};
Sandbox* FitFrom::box = nullptr;

TEST_F(FitFrom, TheSameArmMeasuredAgain) {
  const auto like = from({"-C", "arm", "fit", "--from", "1", "--data", "later.csv"});
  EXPECT_EQ(like["alike"], "same");
  EXPECT_LT(like["spread_mm"], 0.02);
  EXPECT_GT(like["numbers"], 15);
  const Ran ran = box->plumb({"-C", "arm", "fit", "--from", "1", "--data", "later.csv"});
  EXPECT_NE(ran.out.find("hold for this arm too"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("prior_from = \"runs/0001\""), std::string::npos) << ran.out;
}

TEST_F(FitFrom, WhatHappenedToTheEarlierMeasurementIsNotTakenOver) {
  fs::create_directories(box->path() / "moved");
  box->write("moved/cell.toml", box->read("arm/cell.toml"));
  box->write("moved/measurements.csv", box->read("arm/measurements.csv"));
  // Row 150 is beyond the last of the later readings, whose number is some 40.
  ASSERT_EQ(
      box->plumb({"-C", "moved", "add", "step", "--set", "after_row=150", "--set", "of=base"}).exit,
      0);
  const Ran ran =
      box->plumb({"-C", "moved", "fit", "--from", "1", "--data", "later.csv", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.err.find("N-FIT-LEFT"), std::string::npos) << ran.err;
  EXPECT_EQ(ran.err.find("N-FIT-EARLIER"), std::string::npos) << ran.err;
  const auto plain = from({"-C", "arm", "fit", "--from", "moved/runs/0001", "--data", "later.csv"});
  EXPECT_EQ(ran.json()["result"]["from"]["alike"], "same");
  EXPECT_NEAR(ran.json()["result"]["from"]["spread_mm"].get<double>(),
              plain["spread_mm"].get<double>(), 1e-9);
}

TEST_F(FitFrom, TheProcedureIsThatOfTheLaterMeasurementToo) {
  const Sandbox own;
  ASSERT_EQ(own.plumb({"demo", "clean", "arm"}).exit, 0);
  ASSERT_EQ(own.plumb({"-C", "arm", "simulate", "--force", "--effect", "settling_lag:J2:20",
                       "--directions", "--poses", "150"})
                .exit,
            0);
  std::string cell = own.read("arm/cell.toml");
  cell.insert(cell.find("geometry = true") + 15, "\n[effects.settling_lag]\njoints = [\"J2\"]");
  own.write("arm/cell.toml", cell);
  keep_first_rows(own, 100);
  ASSERT_EQ(own.plumb({"-C", "arm", "fit"}).exit, 0);
  const Ran ran = own.plumb({"-C", "arm", "fit", "--from", "1", "--data", "later.csv"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.out.find("settling_lag.J2.T"), std::string::npos) << ran.out;
  EXPECT_EQ(ran.err.find("N-FIT-LEFT"), std::string::npos) << ran.err;
  EXPECT_EQ(ran.err.find("N-FIT-EARLIER"), std::string::npos) << ran.err;
}

TEST_F(FitFrom, NumberFolderAndCellFileSayTheSame) {
  fs::create_directories(box->path() / "arm2");
  const std::string cell = box->read("arm/cell.toml");
  box->write("arm2/cell.toml", cell);
  box->write("arm2/measurements.csv", box->read("later.csv"));
  const auto by_cell = from({"-C", "arm2", "fit", "--from", "arm/runs/0001"});
  auto taken = cell;
  taken.replace(taken.find("[effects]"), 9,
                "[fit]\nprior_from = \"../arm/runs/0001\"\n\n[effects]");
  box->write("arm2/cell.toml", taken);
  EXPECT_EQ(from({"-C", "arm2", "fit"}), by_cell);
  EXPECT_EQ(from({"-C", "arm", "fit", "--from", "1", "--data", "later.csv"}), by_cell);
  EXPECT_EQ(box->plumb({"-C", "arm2", "compare"}).exit, 0);
  EXPECT_EQ(box->plumb({"-C", "arm2", "plot", "poses", "-o", "poses.svg"}).exit, 0);
  EXPECT_NE(box->read("poses.svg").find("With what is taken over, 8 poses reach"),
            std::string::npos);
}

TEST_F(FitFrom, ReadingsNeverCountTwice) {
  const Ran own = box->plumb({"-C", "arm", "fit", "--from", "1"});
  EXPECT_EQ(own.exit, 3);
  EXPECT_NE(own.err.find("E-FIT-EARLIER"), std::string::npos) << own.err;
  const auto run = box->plumb({"-C", "arm", "fit", "--from", "1", "--data", "later.csv", "--json"})
                       .json()["result"]["run"]
                       .dump();
  const Ran chain = box->plumb({"-C", "arm", "fit", "--from", run});
  EXPECT_EQ(chain.exit, 3);
  EXPECT_NE(chain.err.find("E-FIT-EARLIER"), std::string::npos) << chain.err;
  // A file that has grown, or lost its last line, holds the same readings.
  std::string less = box->read("later.csv");
  less.erase(less.rfind('\n', less.size() - 2) + 1);
  box->write("less.csv", less);
  const Ran part = box->plumb({"-C", "arm", "fit", "--from", run, "--data", "less.csv"});
  EXPECT_EQ(part.exit, 3);
  EXPECT_NE(part.err.find("which would count twice"), std::string::npos) << part.err;
}

TEST_F(FitFrom, WhatCannotBeMeantIsRefused) {
  EXPECT_EQ(box->plumb({"-C", "arm", "fit", "--data", "later.csv"}).exit, 2);
  EXPECT_EQ(box->plumb({"-C", "arm", "fit", "--from", "7", "--data", "later.csv"}).exit, 3);
  EXPECT_EQ(box->plumb({"-C", "arm", "fit", "--from", "nowhere"}).exit, 3);
  EXPECT_EQ(box->plumb({"-C", "arm", "fit", "--from", ""}).exit, 2);
  // Five readings do not show where the tracker stands, however well the arm is known.
  std::istringstream lines(box->read("later.csv"));
  std::string line, few;
  for (int rows = 0; rows < 2 && std::getline(lines, line); few += line + "\n")
    if (!line.starts_with("#") && !line.starts_with("pose")) ++rows;
  box->write("few.csv", few);
  const Ran ran =
      box->plumb({"-C", "arm", "fit", "--from", "1", "--data", "few.csv", "--held-out", "20%"});
  EXPECT_NE(ran.exit, 0) << ran.out;
  EXPECT_EQ(box->plumb({"-C", "arm", "fit", "--from", "1", "--data", "none.csv"}).exit, 3);
  ASSERT_EQ(box->plumb({"demo", "scara", "other"}).exit, 0);
  ASSERT_EQ(box->plumb({"-C", "other", "fit"}).exit, 0);
  const Ran other = box->plumb({"-C", "arm", "fit", "--from", "other"});
  EXPECT_EQ(other.exit, 3);
  EXPECT_NE(other.err.find("E-FIT-EARLIER"), std::string::npos) << other.err;
}

}  // namespace
