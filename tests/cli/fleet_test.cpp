// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <sstream>

#include "sandbox.hpp"

namespace {

namespace fs = std::filesystem;

/// Six arms of one model, drawn apart and measured at 40 poses.
class FleetVerb : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "clean", "sample"}).exit, 0);
    for (int arm = 1; arm <= 6; ++arm) {
      const std::string cell = name(arm);
      fs::create_directories(box->path() / cell);
      box->write(cell + "/cell.toml", box->read("sample/cell.toml"));
      ASSERT_EQ(
          box->plumb({"-C", cell, "simulate", "--poses", "40", "--seed", std::to_string(arm)}).exit,
          0);
    }
  }
  static void TearDownTestSuite() { delete box; }

  void TearDown() override {
    for (const char* extra : {"cells/extra", "cells/fleet", "cells/pipe"})
      fs::remove_all(box->path() / extra);
  }

  static std::string name(int arm) { return "cells/arm" + std::to_string(arm); }
  static Ran fleet(std::vector<std::string> more = {}) {
    std::vector<std::string> words{"fleet", "cells", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return box->plumb(words);
  }
  /// A further cell: that of the first arm, changed.
  static void extra(const std::string& measurements, const std::string& fit = "") {
    fs::create_directories(box->path() / "cells/extra");
    box->write("cells/extra/cell.toml", box->read(name(1) + "/cell.toml") + fit);
    box->write("cells/extra/measurements.csv", measurements);
  }
  static std::string kept(const std::string& cell) {
    for (const auto& file : fs::recursive_directory_iterator(box->path() / "cells/fleet/cells"))
      if (file.path().filename() == cell + ".json")
        return box->read(fs::relative(file.path(), box->path()).string());
    return {};
  }

  static Sandbox* box;
};
Sandbox* FleetVerb::box = nullptr;

TEST_F(FleetVerb, SaysHowEveryArmIsAndWhatIsTypical) {
  const Ran ran = fleet();
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto result = ran.json()["result"];
  EXPECT_EQ(result["cells"].size(), 6U);
  for (const auto& cell : result["cells"]) {
    EXPECT_TRUE(cell["ok"]) << cell;
    EXPECT_EQ(cell["held_out"]["n"], 40) << cell;
    EXPECT_FALSE(cell["unlike_sisters"]) << cell;
  }
  ASSERT_EQ(result["models"].size(), 1U);
  EXPECT_EQ(result["models"][0]["arms"], 6);
  EXPECT_GT(result["typical"].size(), 10U);
  for (const auto& number : result["typical"]) {
    EXPECT_GT(number["sd"], 0.0) << number;
    EXPECT_LE(number["shrinkage"], 1.0) << number;
  }
  EXPECT_NE(box->read("cells/fleet/fleet.html").find("<svg"), std::string::npos);
}

TEST_F(FleetVerb, TheHeldOutErrorIsThatOfFitInTheCell) {
  ASSERT_EQ(fleet().exit, 0);
  const auto alone = box->plumb({"-C", name(3), "fit", "--dry-run", "--json"}).json()["result"];
  const auto result = fleet().json()["result"];
  for (const auto& [key, value] : result["cells"][2]["held_out"].items())
    EXPECT_EQ(value, alone["held_out"][key]) << key;
}

TEST_F(FleetVerb, TheVerdictIsThatOfFitInTheSameWordsClassAndColour) {
  extra(box->read(name(1) + "/measurements.csv"));
  std::string strict = box->read("cells/extra/cell.toml");
  const auto at = strict.find("tolerance_mm = ");
  ASSERT_NE(at, std::string::npos);
  strict.replace(at, strict.find('\n', at) - at, "tolerance_mm = 0.001");
  box->write("cells/extra/cell.toml", strict);
  const auto all = fleet().json()["result"]["cells"];
  const std::string screen = box->plumb({"fleet", "cells"}).out;
  const std::string page = box->read("cells/fleet/fleet.html");
  for (const auto& cell : all) {
    const std::string folder = "cells/" + cell["name"].get<std::string>();
    const auto alone = box->plumb({"-C", folder, "fit", "--dry-run", "--json"}).json()["result"];
    for (const char* key : {"verdict", "verdict_head", "verdict_class"})
      EXPECT_EQ(cell[key], alone[key]) << folder;
    const std::string head = alone["verdict_head"], found = alone["verdict_class"];
    EXPECT_NE(screen.find(head), std::string::npos) << screen;
    const std::string mark = found == "good" ? "✓" : found == "bad" ? "✗" : "◐";
    EXPECT_NE(page.find("<td class=\"left " + found + "\">" + mark + " " + head), std::string::npos)
        << folder << ": " << found << " " << head;
    EXPECT_NE(page.find(cell["arm"].get<std::string>()), std::string::npos);
  }
  EXPECT_NE(all.back()["verdict_class"], all.front()["verdict_class"]);
}

TEST_F(FleetVerb, ACellThatWasDoneIsNotDoneAgain) {
  ASSERT_EQ(fleet().exit, 0);
  const auto stamp = [&] {
    for (const auto& f : fs::recursive_directory_iterator(box->path() / "cells/fleet/cells"))
      if (f.path().filename() == "arm1.json") return fs::last_write_time(f.path());
    return fs::file_time_type::min();
  };
  const auto before = stamp();
  const std::string table = box->read("cells/fleet/fleet.json");
  ASSERT_EQ(fleet().exit, 0);
  EXPECT_EQ(stamp(), before);
  EXPECT_EQ(box->read("cells/fleet/fleet.json"), table);
}

TEST_F(FleetVerb, SharesGiveTheSameBytesAsTheWhole) {
  ASSERT_EQ(fleet({"-o", "whole"}).exit, 0);
  for (const char* share : {"1/2", "0/2"}) {
    const Ran ran = fleet({"-o", "shares", "--share", share});
    ASSERT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.json()["result"]["done"], 3);
  }
  EXPECT_FALSE(fs::exists(box->path() / "shares/fleet.json"));
  ASSERT_EQ(fleet({"-o", "shares"}).exit, 0);
  EXPECT_EQ(box->read("shares/fleet.json"), box->read("whole/fleet.json"));
  for (const char* wrong : {"2/2", "-1/2", "1", "1/0", "a/b", "1/2/3"})
    EXPECT_EQ(fleet({"--share", wrong}).exit, 2) << wrong;
}

TEST_F(FleetVerb, ABrokenCellIsNamedAndChangesNothingElse) {
  ASSERT_EQ(fleet().exit, 0);
  const std::string good = kept("arm4");
  ASSERT_NE(good, "");
  extra("q1_deg,x_mm\n");
  const Ran ran = fleet();
  EXPECT_EQ(ran.exit, 0) << "five of six can be used";
  const auto cells = ran.json()["result"]["cells"];
  ASSERT_EQ(cells.size(), 7U);
  EXPECT_FALSE(cells[6]["ok"]);
  EXPECT_NE(cells[6]["error"]["code"], "");
  EXPECT_NE(ran.err.find("W-FLEET-CELL"), std::string::npos) << ran.err;
  EXPECT_EQ(kept("arm4"), good);
}

TEST_F(FleetVerb, AnEditedResultIsNotBelieved) {
  ASSERT_EQ(fleet().exit, 0);
  const std::string whole = kept("arm2");
  for (const auto& f : fs::recursive_directory_iterator(box->path() / "cells/fleet/cells"))
    if (f.path().filename() == "arm2.json") {
      std::string edited = whole;
      const auto at = edited.find("\"mean_m\": ");
      ASSERT_NE(at, std::string::npos);
      edited[at + 10] = '7';
      box->write(fs::relative(f.path(), box->path()).string(), edited);
    }
  ASSERT_EQ(fleet().exit, 0);
  EXPECT_EQ(kept("arm2"), whole);
}

TEST_F(FleetVerb, ACopyTeachesNothing) {
  extra(box->read(name(1) + "/measurements.csv"));
  const Ran ran = fleet();
  EXPECT_NE(ran.err.find("W-FLEET-COPY"), std::string::npos) << ran.err;
  EXPECT_EQ(ran.json()["result"]["models"][0]["arms"], 6);
  EXPECT_EQ(ran.json()["result"]["cells"][6]["same_measurements_as"], "arm1");
}

TEST_F(FleetVerb, APipeIsNotWaitedFor) {
  fs::create_directories(box->path() / "cells/pipe");
  box->write("cells/pipe/cell.toml", box->read(name(1) + "/cell.toml"));
  ASSERT_EQ(::mkfifo((box->path() / "cells/pipe/measurements.csv").c_str(), 0600), 0);
  const auto result = fleet().json()["result"];
  EXPECT_FALSE(result["cells"][6]["ok"]);
}

TEST_F(FleetVerb, WhatSistersTaughtIsTakenOverAndMakesAnotherRun) {
  ASSERT_EQ(fleet({"-o", "taught"}).exit, 0);
  extra(box->read(name(6) + "/measurements.csv"));
  const auto alone = box->plumb({"-C", "cells/extra", "fit", "--json"}).json()["result"];
  extra(box->read(name(6) + "/measurements.csv"),
        "\n[fit]\nprior_from = \"../../taught/fleet.json\"\n");
  const Ran with = box->plumb({"-C", "cells/extra", "fit", "--json"});
  ASSERT_EQ(with.exit, 0) << with.err;
  EXPECT_NE(with.json()["result"]["held_out"], alone["held_out"]);
  EXPECT_NE(with.json()["result"]["run"], alone["run"]);
  // Other numbers of the sisters are another calibration, though cell.toml is the same.
  std::string fewer = box->read("taught/fleet.json");
  const auto at = fewer.find("\"sd_si\": ");
  ASSERT_NE(at, std::string::npos);
  fewer.insert(at + 9, "1");
  box->write("taught/fleet.json", fewer);
  const auto runs = box->plumb({"-C", "cells/extra", "runs", "--json"}).json()["result"]["runs"];
  for (const auto& run : runs) EXPECT_FALSE(run["current"]) << run;
}

TEST_F(FleetVerb, AFleetOfOneChangesNothingAndSaysSo) {
  fs::create_directories(box->path() / "one");
  fs::copy(box->path() / name(1), box->path() / "one/arm", fs::copy_options::recursive);
  ASSERT_EQ(box->plumb({"fleet", "one"}).exit, 0);
  extra(box->read(name(2) + "/measurements.csv"));
  const auto alone = box->plumb({"-C", "cells/extra", "fit", "--dry-run", "--json"}).json();
  extra(box->read(name(2) + "/measurements.csv"),
        "\n[fit]\nprior_from = \"../../one/fleet/fleet.json\"\n");
  const Ran with = box->plumb({"-C", "cells/extra", "fit", "--dry-run", "--json"});
  EXPECT_NE(with.err.find("W-CELL-PRIOR"), std::string::npos) << with.err;
  EXPECT_EQ(with.json()["result"]["held_out"], alone["result"]["held_out"]);
}

TEST_F(FleetVerb, AFleetOfAnotherModelIsRefused) {
  ASSERT_EQ(box->plumb({"demo", "scara", "other/arm"}).exit, 0);
  ASSERT_EQ(box->plumb({"fleet", "other"}).exit, 0);
  extra(box->read(name(2) + "/measurements.csv"),
        "\n[fit]\nprior_from = \"../../other/fleet/fleet.json\"\n");
  const Ran ran = box->plumb({"-C", "cells/extra", "fit"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("E-CELL-PRIOR"), std::string::npos) << ran.err;
}

TEST_F(FleetVerb, AFolderWithoutCellsIsRefused) {
  fs::create_directories(box->path() / "nothing/here");
  EXPECT_EQ(box->plumb({"fleet", "nothing"}).exit, 3);
  EXPECT_EQ(box->plumb({"fleet", "nowhere"}).exit, 3);
  EXPECT_EQ(box->plumb({"fleet"}).exit, 2);
  EXPECT_FALSE(fs::exists(box->path() / "nothing/fleet"));
}

}  // namespace
