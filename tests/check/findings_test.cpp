// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <algorithm>

#include <cmath>
#include <set>
#include <sstream>

#include "check/check.hpp"
#include "check/data_sense.hpp"
#include "fit/cell_data.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/check/scrambled.hpp"

namespace plumb::offline {
namespace {

using scrambled::Files;

struct Options {
  int poses = 80;
  int repeats = 1;
  bool directions = false;
  RowsN q = {};
};

Files files_of(std::uint64_t seed, const Options& options) {
  const Cell cell = random_cell(seed, 6, format::Convention::kModified, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = options.poses;
  plan.repeats = options.repeats;
  plan.q = options.q;
  plan.seed = seed;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
  if (options.directions) plan.directions = Recorded::kAlways;
  return {write_cell(cell), simulated_csv(cell, simulate(cell, plan)), {}};
}

Check checked(const Files& files) {
  const scrambled::Folder folder;
  const auto c = opened(files, folder.path());
  return check_cell(c.cell, c.measured);
}

const Problem* found(const Check& check, const std::string& code) {
  for (const auto& problem : check.findings)
    if (problem.code == code) return &problem;
  return nullptr;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string out;
  for (const auto& line : lines) out += line + "\n";
  return out;
}

/// A column more, its cell made from the number of the data row.
template <class Make>
std::string with_column(const std::string& csv, const std::string& header, Make make) {
  auto lines = lines_of(csv);
  int row = -1;
  for (auto& line : lines)
    if (!line.starts_with('#')) line += "," + (row++ < 0 ? header : std::string(make(row - 1)));
  return joined(lines);
}

Testable effect(const Check& check, const std::string& name) {
  for (const auto& e : check.effects)
    if (e.effect == name) return e;
  ADD_FAILURE() << name;
  return {};
}

TEST(Check, FindsNothingInASoundCell) {
  const Check check = checked(files_of(1, {.repeats = 3}));
  EXPECT_EQ(check.exit, Exit::kDone);
  for (const auto& problem : check.findings)
    EXPECT_EQ(problem.severity, Severity::kNote) << problem.code << problem.message;
  EXPECT_EQ(verdict(check).rfind("Usable: ", 0), 0U) << verdict(check);
  EXPECT_EQ(check.floor.source, NoiseFloor::Source::kRepeats);
}

TEST(Check, AReadingBeyondTheLimitsIsAWarningWithItsLineAndTheTurnThatWouldBeInside) {
  Files files = files_of(1, {});
  auto lines = lines_of(files.csv);
  std::size_t header = 0;
  while (lines[header].starts_with('#')) ++header;
  auto& line = lines[header + 5];
  const auto begin = line.find(',') + 1, end = line.find(',', begin);
  const double q = std::stod(line.substr(begin, end - begin));
  line.replace(begin, end - begin, std::to_string(q + 360.0));
  files.csv = joined(lines);
  const Check check = checked(files);
  const Problem* problem = found(check, "W-CHECK-LIMITS");
  ASSERT_NE(problem, nullptr);
  EXPECT_EQ(problem->place->line, static_cast<int>(header) + 6);
  EXPECT_NE(problem->message.find("a whole turn"), std::string::npos) << problem->message;
  EXPECT_NE(problem->message.find("J1 is beyond"), std::string::npos) << problem->message;
  EXPECT_EQ(problem->severity, Severity::kWarning);
  EXPECT_EQ(check.exit, Exit::kDone);
}

TEST(Check, AReadingBeyondLimitsThatNobodyStatedIsANoteAndTheDataAreUsable) {
  const scrambled::Folder folder;
  auto c = opened(files_of(1, {}), folder.path());
  c.cell.nominal.joints[3].q_min = -0.5;
  c.cell.nominal.joints[3].q_max = 0.5;
  c.cell.assumed_limits.assign(6, false);
  EXPECT_NE(found(check_cell(c.cell, c.measured), "W-CHECK-LIMITS"), nullptr);
  c.cell.assumed_limits[3] = true;
  const Check check = check_cell(c.cell, c.measured);
  EXPECT_EQ(found(check, "W-CHECK-LIMITS"), nullptr);
  const Problem* note = found(check, "N-CHECK-LIMITS");
  ASSERT_NE(note, nullptr);
  EXPECT_EQ(note->severity, Severity::kNote);
  EXPECT_NE(note->message.find("J4"), std::string::npos) << note->message;
  EXPECT_EQ(check.exit, Exit::kDone);
  EXPECT_EQ(verdict(check).rfind("Usable: ", 0), 0U) << verdict(check);
}

TEST(Check, ACopiedPointIsSuspicious) {
  Files files = files_of(1, {});
  auto lines = lines_of(files.csv);
  const auto last = lines.size() - 1;
  lines[last] = "COPY" + lines[last - 3].substr(lines[last - 3].find(','));
  files.csv = joined(lines);
  const Check check = checked(files);
  const Problem* problem = found(check, "W-CHECK-COPY");
  ASSERT_NE(problem, nullptr);
  EXPECT_EQ(problem->place->line, static_cast<int>(last) + 1);
  EXPECT_EQ(check.exit, Exit::kDone);
}

TEST(Check, AGrossOutlierIsNamedWithItsLineAndSpoilsNothingElse) {
  Files files = files_of(1, {});
  auto lines = lines_of(files.csv);
  const auto row = lines.size() - 7;
  const auto at = lines[row].rfind(',', lines[row].rfind(',') - 1);  // z, then t_s
  const auto end = lines[row].find(',', at + 1);
  const double z = std::stod(lines[row].substr(at + 1, end - at - 1));
  lines[row].replace(at + 1, end - at - 1, std::to_string(z + 25.0));
  files.csv = joined(lines);
  const Check check = checked(files);
  const Problem* problem = found(check, "W-CHECK-OUTLIER");
  ASSERT_NE(problem, nullptr);
  EXPECT_EQ(problem->place->line, static_cast<int>(row) + 1) << problem->message;
  EXPECT_EQ(check.exit, Exit::kDone);
  EXPECT_LT(check.detection.best.fitted_m, 0.1e-3);
}

TEST(Check, EqualPosesAreAnErrorOfTheData) {
  RowsN q = RowsN::Constant(40, 6, 0.2);
  const Check check = checked(files_of(1, {.q = q}));
  EXPECT_NE(found(check, "E-CHECK-EQUAL"), nullptr);
  EXPECT_EQ(check.exit, Exit::kInput);
}

TEST(Check, TooFewPosesSayNoInNumbers) {
  const Check check = checked(files_of(1, {.poses = 2}));
  EXPECT_EQ(check.exit, Exit::kNumbersSayNo);
  EXPECT_FALSE(check.detection.changed);
  EXPECT_NE(found(check, "N-CHECK-CONVENTION"), nullptr);
}

TEST(Check, AnotherArmsRowsFitNoReading) {
  Files files = files_of(1, {});
  files.csv = files_of(2, {}).csv;
  const Check check = checked(files);
  EXPECT_NE(found(check, "E-CHECK-NOFIT"), nullptr);
  EXPECT_EQ(check.exit, Exit::kInput);
  EXPECT_FALSE(check.detection.changed);
}

TEST(Check, SmallRangesWarnOfExtrapolationAndAStillJointIsNamed) {
  RowsN q(60, 6);
  tests::Random random(5);
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 6; ++j) q(i, j) = j == 3 ? 0.1 : random.uniform(-0.5, 0.5);
  const Check check = checked(files_of(1, {.q = q}));
  ASSERT_NE(found(check, "W-CHECK-COVERAGE"), nullptr);
  ASSERT_NE(found(check, "W-CHECK-STILL"), nullptr);
  EXPECT_NE(found(check, "W-CHECK-STILL")->message.find("J4"), std::string::npos);
  ASSERT_TRUE(check.coverage);
  EXPECT_EQ(check.coverage->joints[3].text.rfind("never moves", 0), 0U);
  EXPECT_NEAR(check.coverage->joints[0].q_max, q.col(0).maxCoeff(), 1e-9);
  int sum = 0;
  for (const int n : check.coverage->joints[0].tenths) sum += n;
  EXPECT_EQ(sum, 60);
}

TEST(Check, RoundedJointReadingsAreSeenFromTheirDigitsAndSizedAtTheTool) {
  const Cell cell = random_cell(1, 6, format::Convention::kModified, ArmKind::kRevolute);
  Files files = files_of(1, {.poses = 100, .repeats = 3});
  // 0.1 deg: sigma 0.1/sqrt(12) deg = 0.5 mrad a joint; over six joints at metres, about a mm.
  auto lines = lines_of(files.csv);
  for (auto& line : lines) {
    if (line.starts_with('#') || line.starts_with("pose")) continue;
    std::string out = line.substr(0, line.find(','));
    std::size_t at = out.size() + 1;
    for (int j = 0; j < 6; ++j) {
      const auto end = line.find(',', at);
      char text[32];
      std::snprintf(text, sizeof text, ",%.1f", std::stod(line.substr(at, end - at)));
      out += text;
      at = end + 1;
    }
    line = out + line.substr(at - 1);
  }
  files.csv = joined(lines);
  const Check check = checked(files);
  ASSERT_TRUE(check.rounding);
  EXPECT_EQ(check.rounding->step_in_unit, 0.1);
  EXPECT_GT(check.rounding->at_tool_m, 0.2e-3);
  EXPECT_LT(check.rounding->at_tool_m, 2e-3);
  EXPECT_NE(found(check, "W-CHECK-ROUNDED"), nullptr);
  EXPECT_FALSE(checked(files_of(1, {.repeats = 3})).rounding &&
               checked(files_of(1, {.repeats = 3})).rounding->at_tool_m > 1e-6);
}

// ---- which effects the data can show

TEST(Effects, HaveOneLineEachInTheOrderOfTheLibrary) {
  const Check check = checked(files_of(1, {}));
  std::vector<std::string> names;
  for (const auto& e : check.effects) {
    names.push_back(e.effect);
    EXPECT_FALSE(e.why.empty()) << e.effect;
    EXPECT_EQ(e.measure.empty(), e.answer == Testable::Answer::kYes) << e.effect;
  }
  std::vector<std::string> library = known_effects();
  std::erase(library, "local_tree");
  std::sort(library.begin(), library.end());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, library);
}

TEST(Effects, ThermalGrowthNeedsATemperatureThatVaries) {
  using enum Testable::Answer;
  const Files files = files_of(1, {});
  const auto answer = [&](double span) {
    Files with = files;
    with.csv = with_column(files.csv, "temp_arm_degC", [&](int row) {
      return std::to_string(20.0 + (row % 2 == 0 ? 0.0 : span));
    });
    return effect(checked(with), "thermal_growth");
  };
  EXPECT_EQ(answer(0.0).answer, kNo);
  EXPECT_EQ(answer(1.5).answer, kNo);
  EXPECT_EQ(answer(3.0).answer, kWeakly);
  EXPECT_EQ(answer(12.0).answer, kYes);
  EXPECT_NE(answer(1.5).measure.find("cold and warm"), std::string::npos);
}

TEST(Effects, PayloadEffectsNeedTwoPayloads) {
  using enum Testable::Answer;
  const Files files = files_of(1, {});
  for (const bool varies : {false, true}) {
    Files with = files;
    with.csv = with_column(files.csv, "payload_kg",
                           [&](int row) { return varies && row % 2 == 0 ? "5" : "20"; });
    const Check check = checked(with);
    EXPECT_EQ(effect(check, "payload_compliance").answer, varies ? kYes : kNo);
    EXPECT_EQ(effect(check, "link_flexure").answer, varies ? kYes : kWeakly);
    EXPECT_EQ(found(check, "N-CHECK-CONSTANT") == nullptr, varies);
  }
}

TEST(Effects, ReversalNeedsBothDirections) {
  using enum Testable::Answer;
  EXPECT_EQ(effect(checked(files_of(1, {})), "reversal").answer, kNo);
  EXPECT_EQ(effect(checked(files_of(1, {.directions = true})), "reversal").answer, kYes);
  Files files = files_of(1, {});
  for (int j = 1; j <= 6; ++j)
    files.csv = with_column(files.csv, "dir_j" + std::to_string(j), [](int) { return "1"; });
  EXPECT_EQ(effect(checked(files), "reversal").answer, kNo);
}

/// A standing first axis feels no gravity; a ceiling or wall mount changes that.
TEST(Effects, AVerticalAxisCannotShowItsComplianceAndALyingOneCan) {
  const Files files = files_of(1, {});
  const scrambled::Folder folder;
  auto c = opened(files, folder.path());
  std::vector<int> rows(c.measured.size());
  for (int i = 0; i < c.measured.size(); ++i) rows[i] = i;
  const DataSense standing = data_sense(c.cell, c.measured, rows);
  EXPECT_NEAR(standing.lever_m[0], 0.0, 1e-9);
  EXPECT_GT(standing.lever_m[1], 0.1);
  c.cell.gravity = {9.81, 0.0, 0.0};
  EXPECT_GT(data_sense(c.cell, c.measured, rows).lever_m[0], 0.1);
  EXPECT_NE(effect(checked(files), "joint_compliance").why.find("not at J1"), std::string::npos);
}

TEST(Effects, ATimeOfDayCountsAsMuchAsSecondsDo) {
  Files files = files_of(1, {});
  const Check seconds = checked(files);
  auto lines = lines_of(files.csv);
  int minute = 0;
  for (auto& line : lines) {
    if (line.starts_with('#')) continue;
    const auto last = line.rfind(',');
    const bool header = line.substr(last + 1) == "t_s";
    ASSERT_TRUE(header || minute > 0);
    char text[40];
    std::snprintf(text, sizeof text, "2026-03-04T%02d:%02d:00", 8 + minute / 60, minute % 60);
    line = line.substr(0, last + 1) + (header ? "time" : text);
    ++minute;
  }
  files.csv = joined(lines);
  const Check clock = checked(files);
  EXPECT_EQ(effect(clock, "drift").answer, effect(seconds, "drift").answer);
  EXPECT_NE(effect(clock, "drift").why.find("1.3 h of time"), std::string::npos)
      << effect(clock, "drift").why;
}

}  // namespace
}  // namespace plumb::offline
