// SPDX-License-Identifier: Apache-2.0
// One arm measured on three days: two stations, two reflectors, three files.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

std::string replaced(std::string text, const std::string& old, const std::string& with) {
  const auto at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), with);
}

/// As seen by a tracker that stands elsewhere, turned by 0.7 rad [mm].
std::array<double, 3> seen_elsewhere(const std::array<double, 3>& p) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {c * p[0] - s * p[1] + 1500.0, s * p[0] + c * p[1] - 700.0, p[2] + 320.0};
}

struct Rows {
  std::string header;
  std::vector<std::string> lines;
};

Rows rows_of(const std::string& text) {
  Rows out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    (out.header.empty() ? out.header : out.lines.emplace_back()) = line;
  }
  return out;
}

/// Rows `first` .. `first + n - 1` with their header; or, `value` appended to each, without.
std::string part(const Rows& rows, std::size_t first, std::size_t n, bool elsewhere,
                 const std::string& value = "") {
  std::vector<std::string> names;
  std::istringstream header(rows.header);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  std::string out = value.empty() ? rows.header + "\n" : "";
  for (std::size_t i = first; i < first + n; ++i) {
    std::vector<std::string> cells;
    std::istringstream line(rows.lines.at(i));
    for (std::string cell; std::getline(line, cell, ',');) cells.push_back(cell);
    std::array<double, 3> p{};
    std::array<std::size_t, 3> at{};
    for (std::size_t k = 0; k < names.size(); ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (names[k] == std::string(1, "xyz"[axis]) + "_mm") {
          at[axis] = k;
          p[axis] = std::stod(cells.at(k));
        }
    if (elsewhere) p = seen_elsewhere(p);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::ostringstream number;
      number.precision(12);
      number << p[axis];
      cells[at[axis]] = number.str();
    }
    for (std::size_t k = 0; k < cells.size(); ++k) out += (k > 0 ? "," : "") + cells[k];
    out += (value.empty() ? "" : "," + value) + "\n";
  }
  return out;
}

constexpr std::size_t kDay = 60;

class SetupVerbs : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "clean", "cell"}).exit, 0);
    const std::string cell = box->read("cell/cell.toml");
    const Rows small = simulated(cell, "[80, 20, 110]"), large = simulated(cell, "[-30, 90, 50]");
    box->write("cell/day1.csv", part(small, 0, kDay, false));
    box->write("cell/day2.csv", part(large, kDay, kDay, false));
    box->write("cell/day3.csv", part(small, 2 * kDay, kDay, true));
    box->write("cell/all.csv", small.header + ",setup\n" + part(small, 0, kDay, false, "day 1") +
                                   part(large, kDay, kDay, false, "day 2") +
                                   part(small, 2 * kDay, kDay, true, "day 3"));
    const std::string no_files = replaced(cell, "files = [\"measurements.csv\"]\n", "");
    by_file = no_files + setups(true);
    by_column = replaced(cell, "measurements.csv", "all.csv") + setups(false);
    one_frame = replaced(cell, "\"measurements.csv\"", "\"day1.csv\", \"day2.csv\", \"day3.csv\"");
    box->write("cell/cell.toml", by_file);
  }
  static void TearDownTestSuite() { delete box; }

  /// Of the arm of one seed, with the reflector at `target`.
  static Rows simulated(const std::string& cell, const std::string& target) {
    box->write("cell/cell.toml", replaced(cell, "target = \"fit\"", "target = " + target));
    const Ran ran = box->plumb(
        {"-C", "cell", "simulate", "--force", "--poses", "180", "--repeats", "1", "--seed", "5"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return rows_of(box->read("cell/measurements.csv"));
  }

  static std::string setups(bool files) {
    const auto file = [&](const char* name) {
      return files ? "files = [\"" + std::string(name) + "\"]\n" : std::string();
    };
    return "\n[[measurement.setup]]\nname = \"day 1\"   # with the small reflector\n" +
           file("day1.csv") + "\n[[measurement.setup]]\nname = \"day 2\"\n" + file("day2.csv") +
           "frame = { same_as = \"day 1\" }\n\n[[measurement.setup]]\nname = \"day 3\"\n" +
           file("day3.csv") + "target = { same_as = \"day 1\" }\n";
  }

  static Json result(const std::vector<std::string>& words) {
    std::vector<std::string> all{"-C", "cell", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    const Ran ran = box->plumb(all);
    EXPECT_EQ(ran.exit, 0) << words.front() << ran.err << ran.out.substr(0, 2000);
    return ran.exit == 0 ? ran.json().at("result") : Json{};
  }

  void SetUp() override { box->write("cell/cell.toml", by_file); }

  static Sandbox* box;
  static std::string by_file, by_column, one_frame;
};
Sandbox* SetupVerbs::box = nullptr;
std::string SetupVerbs::by_file, SetupVerbs::by_column, SetupVerbs::one_frame;

TEST_F(SetupVerbs, ThatShareWhatTheyDoNotShareAreNamedByCheckAndNoOthers) {
  const Ran right = box->plumb({"-C", "cell", "check"});
  EXPECT_EQ(right.exit, 0) << right.err;
  EXPECT_EQ(right.err.find("W-CHECK-SAME"), std::string::npos) << right.err;
  box->write("cell/cell.toml", replaced(by_file, "frame = { same_as = \"day 1\" }",
                                        "frame = { same_as = \"day 1\" }\n"
                                        "target = { same_as = \"day 1\" }"));
  const Ran target = box->plumb({"-C", "cell", "check"});
  EXPECT_NE(target.err.find("set-up 'day 2' does not carry the reflector that 'day 1' carries"),
            std::string::npos)
      << target.err;
  EXPECT_EQ(target.err.find("set-up 'day 3' does not"), std::string::npos) << target.err;
  box->write("cell/cell.toml", replaced(by_file, "target = { same_as = \"day 1\" }",
                                        "frame = { same_as = \"day 1\" }\n"
                                        "target = { same_as = \"day 1\" }"));
  const Ran frame = box->plumb({"-C", "cell", "check"});
  EXPECT_NE(frame.err.find("set-up 'day 3' does not stand where 'day 1' stands"), std::string::npos)
      << frame.err;
  EXPECT_EQ(frame.err.find("set-up 'day 2' does not"), std::string::npos) << frame.err;
}

TEST_F(SetupVerbs, AreFittedTogetherDownToTheNoise) {
  const Json fit = result({"fit", "--dry-run"});
  EXPECT_LT(fit.at("held_out").at("mean_mm").get<double>(), 0.020);  // noise 10 um an axis
  ASSERT_EQ(fit.at("setups").size(), 3U);
  const Json &one = fit["setups"][0], &two = fit["setups"][1], &three = fit["setups"][2];
  EXPECT_EQ(one["name"], "day 1");
  EXPECT_EQ(one["frame"], fit["frame"]);
  EXPECT_EQ(one["target_mm"], fit["target_mm"]);
  EXPECT_EQ(two["frame"], one["frame"]);
  EXPECT_EQ(three["target_mm"], one["target_mm"]);
  double d = 0.0;  // between the two reflectors
  for (int k = 0; k < 3; ++k)
    d += std::pow(two["target_mm"][k].get<double>() - one["target_mm"][k].get<double>(), 2);
  EXPECT_NEAR(std::sqrt(d), std::sqrt(110.0 * 110.0 + 70.0 * 70.0 + 60.0 * 60.0), 0.3);
  std::array<double, 3> origin{};
  for (int k = 0; k < 3; ++k) origin[k] = one["frame"]["xyz_mm"][k];
  const auto moved = seen_elsewhere(origin);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(three["frame"]["xyz_mm"][k].get<double>(), moved[k], 0.1);
}

TEST_F(SetupVerbs, AreFittedTheSameByFileAndByColumn) {
  const Json by_files = result({"fit", "--dry-run"});
  box->write("cell/cell.toml", by_column);
  const Json by_columns = result({"fit", "--dry-run"});
  EXPECT_NEAR(by_files["held_out"]["mean_mm"].get<double>(),
              by_columns["held_out"]["mean_mm"].get<double>(), 1e-9);
  EXPECT_EQ(by_files["parameters"].size(), by_columns["parameters"].size());
}

TEST_F(SetupVerbs, FailVisiblyIfReadAsOne) {
  box->write("cell/cell.toml", one_frame);
  EXPECT_NE(box->plumb({"-C", "cell", "fit", "--dry-run"}).exit, 0);
}

TEST_F(SetupVerbs, ShowFrameAndTargetOfEach) {
  const Ran ran = box->plumb({"-C", "cell", "fit", "--dry-run"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  for (const char* text : {"set-up [mm]", "day 1", "as day 1", "day 3"})
    EXPECT_NE(ran.out.find(text), std::string::npos) << text << "\n" << ran.out;
}

TEST_F(SetupVerbs, AreComparedSetupBySetup) {
  const Json compare = result({"compare"});
  const Json& by = compare.at("by").at("setup");
  ASSERT_EQ(by.size(), 3U);
  int n = 0;
  for (const auto& one : by) {
    n += one["n"].get<int>();
    EXPECT_LT(one["mean_mm"].get<double>(), 0.03);
  }
  EXPECT_EQ(n, compare["n"].get<int>());
  const Ran ran = box->plumb({"-C", "cell", "compare"});
  EXPECT_NE(ran.out.find("Mean error by set-up"), std::string::npos) << ran.out;
}

TEST_F(SetupVerbs, ABadDayStandsOutInCompare) {
  // On the third day the tracker was bumped by 0.3 mm half way through.
  const Csv good = box->csv("cell/day3.csv");
  const Rows rows = rows_of(box->read("cell/day3.csv"));
  std::string text = rows.header + "\n";
  for (std::size_t i = 0; i < kDay; ++i) {
    const std::string one = part(rows, i, 1, false);
    std::string line = one.substr(one.find('\n') + 1);
    if (i >= kDay / 2) {
      const auto x = good.columns.at("x_mm").at(i);
      line = replaced(line, x, std::to_string(std::stod(x) + 0.3));
    }
    text += line;
  }
  box->write("cell/bad3.csv", text);
  box->write("cell/cell.toml", replaced(by_file, "day3.csv", "bad3.csv"));
  const Json by = result({"compare"}).at("by").at("setup");
  EXPECT_GT(by[2]["mean_mm"].get<double>(), 3 * by[0]["mean_mm"].get<double>());
  EXPECT_GT(by[2]["mean_mm"].get<double>(), 3 * by[1]["mean_mm"].get<double>());
}

TEST_F(SetupVerbs, EveryOtherVerbWorks) {
  EXPECT_EQ(box->plumb({"-C", "cell", "check"}).exit, 0);
  (void)result({"fit"});
  EXPECT_EQ(box->plumb({"-C", "cell", "runs"}).exit, 0);
  EXPECT_EQ(box->plumb({"-C", "cell", "diagnose"}).exit, 0);
  EXPECT_EQ(box->plumb({"-C", "cell", "plan", "--n", "5", "-o", "next.csv"}).exit, 0);
  EXPECT_EQ(box->plumb({"-C", "cell", "compile", "-o", "robot.plumb"}).exit, 0);
  EXPECT_EQ(box->plumb({"-C", "cell", "add", "joint_compliance"}).exit, 0);
  const std::string edited = box->read("cell/cell.toml");
  EXPECT_NE(edited.find("# with the small reflector"), std::string::npos);
  EXPECT_EQ(result({"fit", "--dry-run"}).at("setups").size(), 3U);
}

TEST_F(SetupVerbs, PredictTakesTheSetupFromTheColumn) {
  const Json fit = result({"fit"});
  ASSERT_EQ(box->plumb({"-C", "cell", "predict", "--as-measured", "-o", "own.csv"}).exit, 0);
  const Ran all = box->plumb(
      {"-C", "cell", "predict", "--as-measured", "--data", "cell/all.csv", "-o", "said.csv"});
  ASSERT_EQ(all.exit, 0) << all.err;
  const Csv said = box->csv("said.csv");
  ASSERT_EQ(said.rows(), 3 * kDay);
  for (const char* axis : {"x", "y", "z"}) {
    const auto p = said.numbers("p" + std::string(axis) + "_mm");
    const auto seen = said.numbers(std::string(axis) + "_mm");
    for (std::size_t i = 0; i < p.size(); ++i) ASSERT_NEAR(p[i], seen[i], 0.2) << i;
  }
  // Without the column, a file that a set-up names is of that set-up; of another one nothing is
  // known.
  for (const std::string day : {"day1", "day2"}) {
    const Ran named = box->plumb({"-C", "cell", "predict", "--as-measured", "--data",
                                  "cell/" + day + ".csv", "-o", day + ".csv"});
    ASSERT_EQ(named.exit, 0) << named.err;
    const Csv points = box->csv(day + ".csv");
    const auto p = points.numbers("px_mm"), seen = points.numbers("x_mm");
    for (std::size_t i = 0; i < p.size(); ++i) ASSERT_NEAR(p[i], seen[i], 0.2) << day << " " << i;
  }
  box->write("unknown.csv", box->read("cell/day2.csv"));
  const Ran none = box->plumb(
      {"-C", "cell", "predict", "--as-measured", "--data", "unknown.csv", "-o", "first.csv"});
  EXPECT_EQ(none.exit, 3) << none.err;
  EXPECT_NE(none.err.find("E-CSV-SETUP"), std::string::npos) << none.err;
  box->write("other.csv", replaced(box->read("cell/all.csv"), "day 1", "day 4"));
  const Ran unknown =
      box->plumb({"-C", "cell", "predict", "--as-measured", "--data", "other.csv", "-o", "no.csv"});
  EXPECT_EQ(unknown.exit, 3) << unknown.err;
  EXPECT_NE(unknown.err.find("E-CSV-SETUP"), std::string::npos) << unknown.err;
}

TEST_F(SetupVerbs, SimulateMeasuresInTheFirstAndSaysSo) {
  const Ran ran =
      box->plumb({"-C", "cell", "simulate", "--poses", "20", "-o", "cell/new.csv", "--force"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.err.find("N-SIMULATE-SETUP"), std::string::npos) << ran.err;
}

}  // namespace
