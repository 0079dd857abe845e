// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <tuple>
#include <utility>

#include "arm/predicted_points.hpp"
#include "compare/worst_band.hpp"
#include "effects/registry.hpp"
#include "figures/bench_figures.hpp"
#include "figures/data_figures.hpp"
#include "figures/error_axis.hpp"
#include "figures/error_figures.hpp"
#include "figures/evidence_figure.hpp"
#include "figures/formula_law.hpp"
#include "figures/heat_map.hpp"
#include "figures/joint_law.hpp"
#include "figures/joint_residual.hpp"
#include "figures/law_figures.hpp"
#include "figures/model_figures.hpp"
#include "figures/observability_figure.hpp"
#include "figures/registry.hpp"
#include "figures/run_figures.hpp"
#include "figures/words.hpp"
#include "fit/calibrate.hpp"
#include "plumb/format/formula.hpp"
#include "tests/draw/text_boxes.hpp"
#include "tests/draw/well_formed.hpp"
#include "tests/figures/made_run.hpp"
#include "tests/yardstick.hpp"

namespace plumb::offline::figures {
namespace {

using Held = MadeRun::Held;

std::set<std::string> poses_in(const std::string& svg) {
  static const std::regex kPose("data-pose=\"([^\"]*)\"");
  std::set<std::string> out;
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), kPose); it != std::sregex_iterator();
       ++it)
    out.insert((*it)[1]);
  return out;
}

/// The names of the figures that are drawn from a run.
std::vector<std::string> run_figures(const Cell& cell) {
  std::vector<std::string> out;
  for (const auto& name : figure_names(cell))
    if (needs_of(name) == FigureRow::Needs::kRun ||
        needs_of(name) == FigureRow::Needs::kEarlierRuns)
      out.push_back(name);
  return out;
}

bool shows_no_error(const std::string& name) {
  return name == "parameters" || name == "correlation" || name == "coverage" ||
         name == "uncertainty" || name == "leaf-map" || name == "refusals";
}

/// Every figure of the run at the three widths of the page: no label touches another, none leaves
/// the drawing, and no number is missing.
void expect_sound(const MadeRun& made) {
  const RunResults results = made.results();
  for (const auto& name : run_figures(made.cell))
    for (const double width : {1280.0, 700.0, 400.0}) {
      const std::string svg = drawn(name, results, width).value();
      EXPECT_EQ(collisions(svg, width), "") << name << " at " << width;
      EXPECT_EQ(svg.find("nan"), std::string::npos) << name;
      EXPECT_EQ(svg.find("inf"), std::string::npos) << name;
      EXPECT_EQ(svg.find("measured - predicted") == std::string::npos, shows_no_error(name))
          << name;
      EXPECT_EQ(tests::xml_fault(svg), "") << name;
    }
}

TEST(Figures, OfEveryEffectThatListsNoJointAreThere) {
  for (const EffectDescriptor* effect : effect_descriptors())
    EXPECT_TRUE(std::any_of(figure_list().begin(), figure_list().end(), [&](const auto& row) {
      return row.name == effect->figure;
    })) << effect->name;
}

TEST(Figures, AreSoundForArmsOfTwoSixAndNineJoints) {
  for (const int joints : {2, 6, 9}) expect_sound(MadeRun(60, joints));
}

TEST(Figures, AreSoundWithoutAHeldOutSetAndSayThatItIsNoAccuracy) {
  const MadeRun made(60, 6, Held::kNone);
  expect_sound(made);
  for (const auto& name : run_figures(made.cell))
    EXPECT_EQ(drawn(name, made.results(), 1280.0)->find("in-sample") == std::string::npos,
              shows_no_error(name))
        << name;
}

TEST(Figures, AreSoundForNoPoseOnePoseAndErrorsThatAreAllZero) {
  expect_sound(MadeRun(0, 6));
  expect_sound(MadeRun(1, 6));
  MadeRun exact(30, 6);
  exact.before_M.setZero();
  exact.after_M.setZero();
  exact.run.fit.floor = {};
  expect_sound(exact);
}

TEST(Figures, SayOneOfAThingInTheSingular) {
  const std::regex plural(
      "[^0-9.]1 (poses|numbers|readings|rows|rechecks|held-out poses|fitted "
      "poses)");
  for (const auto held : {Held::kNone, Held::kEveryFifth}) {
    const MadeRun one(1, 6, held);
    for (const auto& name : run_figures(one.cell)) {
      std::smatch found;
      const std::string svg = drawn(name, one.results(), 4000.0).value();
      EXPECT_FALSE(std::regex_search(svg, found, plural)) << name << ": " << found.str();
    }
  }
}

TEST(Figures, HostileNamesOfPosesStayWords) {
  MadeRun made(40, 6);
  for (auto& name : made.measured.pose) name = "\"><script>alert('" + name + "')</script>";
  for (const auto& name : run_figures(made.cell)) {
    const std::string svg = drawn(name, made.results(), 700.0).value();
    EXPECT_EQ(svg.find("<script"), std::string::npos) << name;
    EXPECT_EQ(collisions(svg, 700.0), "") << name;
  }
}

TEST(ErrorByPose, DrawsEveryHeldOutPoseAndNoOther) {
  const MadeRun made(60, 6);
  std::set<std::string> held;
  for (const int row : made.results().held) held.insert(made.results().pose(row));
  ASSERT_EQ(held.size(), 12U);
  EXPECT_EQ(poses_in(error_by_pose(made.results(), 900.0)), held);
  EXPECT_EQ(poses_in(error_map(made.results(), 900.0)), held);
}

std::string where(const MadeRun& made) {
  const RunResults results = made.results();
  return compare::where_sentence(results.cell, results.measured, results.run.fit);
}

std::optional<compare::WorstBand> band_of(const MadeRun& made) {
  const RunResults results = made.results();
  return compare::worst_band(results.cell, results.measured, results.run.fit);
}

TEST(ErrorByPose, NamesTheWorstPoseInTheDrawingAndTheSentence) {
  MadeRun made(60, 6);
  made.after_M.row(25) = Eigen::RowVector3d(0.0, 0.3e-3, 0.4e-3);
  const std::string svg = error_by_pose(made.results(), 900.0);
  EXPECT_NE(svg.find(">P26</text>"), std::string::npos);
  EXPECT_NE(where(made).find("P26"), std::string::npos);
  EXPECT_NE(where(made).find("0.50 mm"), std::string::npos);
}

TEST(WorstBand, IsTheOneThatWasPlanted) {
  MadeRun made(2000, 6);
  const auto& q = made.measured.q;
  double low = 1e9, high = -1e9;
  for (const int row : made.results().held) {
    low = std::min(low, q(row, 1));
    high = std::max(high, q(row, 1));
  }
  const double step = (high - low) / 8.0;
  int planted = 0;
  for (const int row : made.results().held) {
    if (q(row, 1) < low + 5.0 * step || q(row, 1) > low + 6.0 * step) continue;
    made.after_M.row(row) *= 6.0;
    ++planted;
  }
  const auto band = band_of(made);
  ASSERT_TRUE(band) << planted << " poses planted";
  EXPECT_EQ(band->joint, 1);
  EXPECT_NEAR(band->from, low + 5.0 * step, 0.1 * step);
  EXPECT_GT(band->mean_m, 4.0 * band->elsewhere_m);
  EXPECT_NE(where(made).find("largest at " + made.cell.nominal.joints[1].name), std::string::npos);
}

TEST(WorstBand, NoiseHasNone) { EXPECT_FALSE(band_of(MadeRun(400, 6))); }

/// Of 60 readings, 12 of them held out, some that are listed as standing out by a quarter metre.
MadeRun with_bad_readings(const std::vector<int>& rows) {
  MadeRun made(60, 6);
  Fit& fit = made.run.fit;
  fit.held.n = 12;
  fit.held_without_outliers.n = 12 - static_cast<int>(rows.size());
  for (const int row : rows) {
    made.after_M.row(row) = Eigen::RowVector3d(0.15, 0.2, 0.0);
    made.before_M.row(row) = made.after_M.row(row);
    fit.held_outliers.push_back({.row = row, .error_m = 0.25, .times = 900.0});
  }
  return made;
}

TEST(BadReadings, LieAtTheEdgeOfAnAxisThatIsMadeForTheOthers) {
  const MadeRun made = with_bad_readings({25});
  const RunResults results = made.results();
  const ErrorAxis axis = error_axis(results);
  EXPECT_EQ(axis.unit.name, "mm");
  EXPECT_LT(axis.axis.high, 20.0);
  EXPECT_EQ(axis.of(0.25), axis.axis.high);
  for (const auto& svg :
       {error_by_pose(results, 900.0), error_hist(results, 900.0), error_ecdf(results, 900.0)}) {
    EXPECT_NE(svg.find("1 beyond the axis"), std::string::npos);
    EXPECT_NE(svg.find("1 reading stands out and lies beyond the axis"), std::string::npos);
    EXPECT_EQ(collisions(svg, 900.0), "");
  }
  MadeRun unlisted = made;
  unlisted.run.fit.held_outliers.clear();
  EXPECT_GE(error_axis(unlisted.results()).axis.high, 250.0);
  EXPECT_EQ(error_hist(unlisted.results(), 900.0).find("beyond the axis"), std::string::npos);
}

TEST(BadReadings, AreLeftOutOfTheSentences) {
  const MadeRun one = with_bad_readings({25});
  const std::string svg = error_ecdf(one.results(), 4000.0);
  EXPECT_NE(svg.find("11 held-out poses (without 1 reading that stands out) miss"),
            std::string::npos);
  EXPECT_EQ(where(one).find("250 mm"), std::string::npos);
  // Three of twelve are no single bad readings any more: all count.
  const MadeRun three = with_bad_readings({25, 30, 35});
  EXPECT_NE(where(three).find("250 mm"), std::string::npos);
  EXPECT_GE(error_axis(three.results()).axis.high, 250.0);
}

TEST(ErrorHist, CountsEveryPoseOnceBeforeAndOnceAfter) {
  const MadeRun made(200, 6);
  const std::string svg = error_hist(made.results(), 900.0);
  const auto sum = [&](const std::string& kind) {
    const std::regex count_of(": (\\d+) " + kind + "</title>");
    int out = 0;
    for (auto it = std::sregex_iterator(svg.begin(), svg.end(), count_of);
         it != std::sregex_iterator(); ++it)
      out += std::stoi((*it)[1]);
    return out;
  };
  EXPECT_EQ(sum("held out"), 2 * 40);
  EXPECT_EQ(sum("fitted"), 2 * 160);
}

TEST(ErrorHist, SaysHowManyAreWithinTheTolerance) {
  MadeRun made(50, 6);
  for (int i = 0; i < 50; ++i)
    made.after_M.row(i) = Eigen::RowVector3d(0.0, 0.0, i < 15 ? 5e-5 : 2e-4);
  EXPECT_NE(error_hist(made.results(), 900.0).find("3 of 10 are within the tolerance of 0.10 mm"),
            std::string::npos);
}

TEST(JointResidual, FindsAnOffsetOfTheJointThatHasIt) {
  MadeRun made(300, 6);
  ArmState wrong = made.run.fit.calibration.state;
  wrong.arm.calibrated.joints[2].theta -= 200e-6;
  made.after_M = residuals(made.measured, predict_points(wrong, made.measured));
  for (const auto& joint : joint_residuals(made.results())) {
    if (joint.joint != 2) continue;
    for (const auto& mean : joint.curve) EXPECT_NEAR(mean.value, 200e-6, 2e-6);
    EXPECT_LT(joint.rms_without_curve, 0.02 * joint.rms);
  }
}

TEST(Joints, NameTheJointThatStandsOut) {
  MadeRun made(400, 6);
  auto wrong = made.run.fit.calibration.state;
  wrong.arm.effects.push_back({.name = "gear_ripple",
                               .joints = {1},
                               .parameters = {2e-4, 0.0},
                               .context = {},
                               .constants = {1.0}});
  made.after_M += residuals(made.measured, predict_points(wrong, made.measured));
  EXPECT_NE(joints_figure(made.results(), 700.0)
                .find("What is left at " + made.cell.nominal.joints[1].name + " runs from"),
            std::string::npos);
}

TEST(JointResidual, TheIntervalCoversZeroWhereThereIsNoiseOnly) {
  const MadeRun made(600, 6);
  int outside = 0, all = 0;
  for (const auto& joint : joint_residuals(made.results()))
    for (const auto& mean : joint.curve) {
      outside += std::abs(mean.value) > mean.half;
      ++all;
    }
  EXPECT_EQ(all, 6 * 160);
  EXPECT_LT(outside, all / 8) << "5 % expected";
  EXPECT_GT(outside, 0) << "an interval that is always right is too wide";
}

TEST(Order, NamesThePosesBetweenWhichSomethingJumped) {
  MadeRun made(200, 6);
  EXPECT_NE(order_figure(made.results(), 900.0).find("Nothing jumps"), std::string::npos);
  for (int i = 120; i < 200; ++i) made.after_M.row(i) += Eigen::RowVector3d(1e-4, 0.0, -2e-4);
  const std::string svg = order_figure(made.results(), 900.0);
  EXPECT_NE(svg.find("jumped: between poses P120 and P121"), std::string::npos);
  EXPECT_NE(svg.find("the base or tracker"), std::string::npos);
  EXPECT_EQ(count(svg, ">jump: P121<"), 3) << "in the panel of each axis";
}

TEST(Parameters, NameTheNumberThatIsFarthestFromNominal) {
  MadeRun made(30, 6);
  made.cell.fit.prior_m = 0.5e-3;
  made.run.fit.calibration.estimates = {
      {.name = "J1.theta", .of_robot = true, .value = 1.0001, .nominal = 1.0, .std = 1e-4},
      {.name = "J2.d",
       .is_length = true,
       .of_robot = true,
       .value = 0.4515,
       .nominal = 0.45,
       .std = 1e-5},
      {.name = "drift.rate", .of_robot = true, .unit = "m/s", .value = 3.0, .std = 1.0},
      {.name = "frame.x", .is_length = true, .value = 0.5, .std = 1e-5}};
  const std::string svg = parameters_figure(made.results(), 900.0);
  EXPECT_NE(svg.find("2 of 3 fitted numbers differ from nominal"), std::string::npos);
  EXPECT_NE(svg.find("that of J2.d, 1.5 mm, 3.0 times the usual deviation"), std::string::npos);
  EXPECT_EQ(svg.find("frame.x"), std::string::npos) << "of the measurement, not of the arm";
  for (const double width : {1280.0, 700.0, 400.0})
    EXPECT_EQ(collisions(parameters_figure(made.results(), width), width), "");
}

TEST(Waterfall, TakesTheRunsThatLeadToThisOneAndCountsPosesThatBecameWorse) {
  MadeRun made(50, 6);
  using Names = std::vector<std::string>;
  const auto run_of = [&](int number, const Names& effects, double error_m) {
    offline::Run out = made.run;
    out.number = number;
    out.effects = effects;
    out.fit.predicted_M = made.measured.p_M;
    out.fit.predicted_M.col(2).array() -= error_m;
    out.fit.held.mean = error_m;
    return out;
  };
  const std::vector<offline::Run> earlier{run_of(1, Names{"geometry"}, 4e-4),
                                          run_of(2, Names{"geometry", "reversal"}, 3e-4),
                                          run_of(3, Names{"geometry", "drift"}, 2e-4)};
  made.run = run_of(4, Names{"geometry", "drift", "gear_ripple", "gear_ripple"}, 1e-4);
  made.run.fit.predicted_M(0, 2) -= 9e-4;  // row 0 is held out
  made.after_M = residuals(made.measured, made.run.fit.predicted_M);
  const auto steps = waterfall_steps(made.results(), earlier);
  ASSERT_EQ(steps.size(), 4U);
  EXPECT_EQ(steps[1].added, "geometry");
  EXPECT_EQ(steps[2].added, "drift of tracker or base");
  EXPECT_EQ(steps[3].added, "gear ripple (2 times)");
  EXPECT_DOUBLE_EQ(steps[3].mean_m, 1e-4);
  EXPECT_EQ(steps[2].worse, 0);
  EXPECT_EQ(steps[3].worse, 1);
  for (const double width : {1280.0, 700.0, 400.0}) {
    const std::string svg = waterfall(made.results(), steps, width);
    EXPECT_EQ(collisions(svg, width), "") << width;
    EXPECT_NE(svg.find("1 pose worse"), std::string::npos) << width;
  }
}

TEST(Regions, NameThePartOfTheJointRangeWhereTheErrorIsLargest) {
  MadeRun made(1500, 6);
  const auto& q = made.measured.q;
  const double middle = 0.5 * (q.col(1).minCoeff() + q.col(1).maxCoeff());
  for (int i = 0; i < 1500; ++i)
    if (q(i, 1) > middle) made.after_M.row(i) *= 4.0;
  const std::string svg = regions_figure(made.results(), 1280.0);
  EXPECT_NE(svg.find("largest where " + made.cell.nominal.joints[1].name + " is between"),
            std::string::npos);
  EXPECT_NE(svg.find(">* " + made.cell.nominal.joints[1].name + " [deg]<"), std::string::npos);
  EXPECT_NE(regions_figure(MadeRun(1500, 6).results(), 1280.0).find("much the same everywhere"),
            std::string::npos);
}

TEST(Regions, APoseThatStandsOutColoursNoRegion) {
  MadeRun made(300, 6);
  const int row = made.results().held.front();
  made.after_M.row(row) *= 500.0;
  const auto brightest_mm = [&] {
    const std::string svg = regions_figure(made.results(), 1280.0);
    std::smatch found;
    return std::regex_search(svg, found, std::regex("\\(dark\\) to ([0-9.]+) mm"))
               ? std::stod(found[1])
               : 0.0;
  };
  const auto is_told = [&] {
    return regions_figure(made.results(), 1280.0).find("One pose is left out") != std::string::npos;
  };
  EXPECT_FALSE(is_told());
  EXPECT_GT(brightest_mm(), 0.3);
  made.run.fit.held_outliers = {{.row = row}};
  EXPECT_TRUE(is_told());
  EXPECT_LT(brightest_mm(), 0.2);
}

TEST(Coverage, SaysThatAllIsUsedAndWhereTheWidestGapIs) {
  MadeRun made(2000, 6);
  const auto& row = made.cell.nominal.joints[2];
  const double from = row.q_min + 0.4 * (row.q_max - row.q_min);
  const double to = row.q_min + 0.6 * (row.q_max - row.q_min);
  for (int i = 0; i < 2000; ++i)
    if (double& q = made.measured.q(i, 2); q > from && q < to) q = from;
  const std::string svg = coverage_figure(made.results(), 900.0);
  EXPECT_NE(svg.find("Every joint used at least 99 % of its range"), std::string::npos);
  EXPECT_NE(svg.find("that of " + row.name + " between"), std::string::npos);
}

TEST(Coverage, NamesTheJointThatMovedLeastAndTheHole) {
  MadeRun made(200, 6);
  auto& row = made.cell.nominal.joints[3];
  row.q_min = -M_PI, row.q_max = M_PI;
  for (int i = 0; i < 200; ++i) made.measured.q(i, 3) = (i % 2 == 0 ? -1.0 : 0.5) + 0.001 * i;
  const std::string svg = coverage_figure(made.results(), 900.0);
  EXPECT_NE(svg.find(row.name + " used the least of its range: -57 to 40 deg, 27 % of it"),
            std::string::npos);
  EXPECT_NE(svg.find("between 40 and 180 deg"), std::string::npos);
}

TEST(Correlation, NamesThePairThatMovesTogether) {
  MadeRun made(30, 6);
  auto& c = made.run.fit.calibration;
  for (const char* name : {"J1.theta", "J2.d", "J3.d", "target.z"})
    c.estimates.push_back({.name = name});
  c.covariance = Eigen::MatrixXd::Identity(4, 4) * 1e-8;
  EXPECT_NE(correlation_figure(made.results(), 700.0).find("No two fitted numbers"),
            std::string::npos);
  c.covariance(1, 2) = c.covariance(2, 1) = -0.97e-8;
  const std::string svg = correlation_figure(made.results(), 700.0);
  EXPECT_NE(svg.find("1 pair of numbers can hardly be told apart; the closest are J2.d and J3.d "
                     "(correlation -0.970)"),
            std::string::npos);
  EXPECT_EQ(count(svg, "</title>"), 4 + 1) << "the diagonal and one pair";
  for (const double width : {1280.0, 700.0, 400.0})
    EXPECT_EQ(collisions(correlation_figure(made.results(), width), width), "") << width;
}

Diagnosis made_diagnosis() {
  Diagnosis out;
  out.before = {.n = 20, .mean = 1.1e-4};
  for (int i = 0; i < 15; ++i) {
    Candidate c;
    c.entry.name = "gear_ripple";
    c.entry.joints = {i % 6};
    c.title = "gear ripple";
    c.ln_bayes = 90.0 - 8.0 * i;
    c.gain = 0.4 - 0.03 * i;
    c.gain_se = 0.02;
    c.alone = {.n = 20, .mean = 6e-5 + 4e-6 * i};
    c.after = {.n = 20, .mean = 5e-5};
    c.supported = i < 6;
    c.plausible = i != 3;
    out.candidates.push_back(std::move(c));
  }
  out.candidates[0].confounded_with = {"gear_ripple:J2@cycles=4"};
  return out;
}

TEST(Evidence, SaysWhatTheFirstCandidateWouldBringAndThatAnotherImitatesIt) {
  const MadeRun made(10, 6);
  const Diagnosis d = made_diagnosis();
  for (const double width : {1280.0, 700.0, 400.0}) {
    const std::string svg = evidence(made.cell, d, width);
    EXPECT_EQ(collisions(svg, width), "") << width;
    EXPECT_EQ(count(svg, "%</title>"), 12) << "one bar for each of the twelve that are shown";
  }
  const std::string svg = evidence(made.cell, d, 1280.0);
  EXPECT_NE(svg.find("Adding gear ripple of J1 takes the mean error of held-out poses from 0.11 mm "
                     "to 0.060 mm; these poses hardly tell it from 3 other effects."),
            std::string::npos)
      << "J2 stands three times in the list";
  EXPECT_NE(svg.find("12 of 15 candidates are shown"), std::string::npos);
}

TEST(Evidence, SaysThatNothingIsSupportedOrCanBeJudged) {
  const MadeRun made(10, 6);
  Diagnosis d = made_diagnosis();
  for (auto& c : d.candidates) c.supported = false;
  EXPECT_NE(evidence(made.cell, d, 700.0).find("No further effect is supported"),
            std::string::npos);
  d.candidates.clear();
  EXPECT_NE(evidence(made.cell, d, 700.0).find("No effect of the library can be judged"),
            std::string::npos);
}

/// What the run fitted as a law of one joint, with numbers that are known to 5 µrad each.
void add_ripple(MadeRun& made, std::uint8_t joint, double cycles, double sine, double cosine) {
  auto& c = made.run.fit.calibration;
  const int place = static_cast<int>(c.state.arm.effects.size());
  c.state.arm.effects.push_back({.name = "gear_ripple",
                                 .joints = {joint},
                                 .parameters = {sine, cosine},
                                 .context = {},
                                 .constants = {cycles}});
  for (int k = 0; k < 2; ++k) {
    c.parameters.push_back(effect_parameters(c.state.arm)[static_cast<std::size_t>(2 * place + k)]);
    c.estimates.push_back({.name = c.parameters.back().name});
  }
  const auto n = static_cast<Eigen::Index>(c.estimates.size());
  c.covariance = 25e-12 * Eigen::MatrixXd::Identity(n, n);
}

/// Residuals of an arm that has these effects while the model has none.
void err_by_effects(MadeRun& made) {
  made.after_M =
      residuals(made.measured, predict_points(made.run.fit.calibration.state, made.measured)) *
      -1.0;
}

JointResidual residual_of(const MadeRun& made, int joint) {
  for (auto& one : joint_residuals(made.results()))
    if (one.joint == joint) return one;
  return {.joint = joint};
}

TEST(JointLaw, IsTheSumOfTheWavesOfThatJointWithTheirUncertainty) {
  MadeRun made(60, 6);
  add_ripple(made, 1, 17.0, 80e-6, -50e-6);
  add_ripple(made, 1, 3.0, 0.0, 30e-6);
  add_ripple(made, 2, 5.0, 70e-6, 0.0);
  const RunResults results = made.results();
  const JointLaw law(results, 1, JointLaw::Of::kOwnPosition);
  ASSERT_FALSE(law.empty());
  EXPECT_EQ(law.names(), "gear ripple (2 times)");
  for (const double q : {-1.0, 0.1, 0.7}) {
    const auto [value, sigma] = law.at(q, 0);
    EXPECT_NEAR(value,
                80e-6 * std::sin(17.0 * q) - 50e-6 * std::cos(17.0 * q) + 30e-6 * std::cos(3.0 * q),
                1e-12);
    EXPECT_NEAR(sigma, 5e-6 * std::sqrt(2.0), 1e-9) << "sin^2 + cos^2 of two waves";
  }
  EXPECT_TRUE(JointLaw(results, 0, JointLaw::Of::kOwnPosition).empty());
  EXPECT_TRUE(JointLaw(results, 1, JointLaw::Of::kLoad).empty());
  EXPECT_FALSE(law.has_sides());
  const std::string svg =
      drawn("joint-" + made.cell.nominal.joints[1].name, results, 900.0).value();
  EXPECT_NE(svg.find("(gear ripple (2 times)) runs from"), std::string::npos);
  EXPECT_NE(svg.find(">fitted law<"), std::string::npos);
}

TEST(Spectrum, NamesTheWaveThatIsThereAndNoneInNoise) {
  MadeRun made(400, 6);
  add_ripple(made, 1, 16.9, 80e-6, -50e-6);
  err_by_effects(made);
  const JointResidual joint = residual_of(made, 1);
  std::vector<double> value;
  for (const auto& pose : joint.poses) value.push_back(pose.value);
  const Spectrum found = spectrum_of(joint, value, 0.0);
  const auto peaks = peaks_of(found, 4);
  ASSERT_FALSE(peaks.empty());
  EXPECT_NEAR(found.cycles[peaks[0]], 16.9, 0.5 * found.apart);
  EXPECT_GT(found.share[peaks[0]], 0.9);
  made.run.fit.calibration.state.arm.effects.clear();
  const auto& name = made.cell.nominal.joints[1].name;
  const std::string svg = drawn("spectrum-" + name, made.results(), 900.0).value();
  EXPECT_NE(svg.find(">k = 1"), std::string::npos);
  EXPECT_NE(svg.find("is not known"), std::string::npos) << "the gear ratio";
  made.cell.mechanics[1].gear_ratio = 101.0;
  EXPECT_NE(drawn("spectrum-" + name, made.results(), 900.0)->find(">motor<"), std::string::npos);
  int false_alarms = 0;
  for (int j = 0; j < 6; ++j) {
    const JointResidual noise = residual_of(MadeRun(300, 6), j);
    std::vector<double> numbers;
    for (const auto& pose : noise.poses) numbers.push_back(pose.value);
    false_alarms += peaks_of(spectrum_of(noise, numbers, 0.0), 4).empty() ? 0 : 1;
  }
  EXPECT_LE(false_alarms, 1) << "once in a hundred spectra";
}

TEST(Load, FindsTheSpringThatIsMissingAndDrawsTheOneThatWasFitted) {
  MadeRun made(300, 6);
  made.cell.payload.mass_kg = 8.0;
  auto& arm = made.run.fit.calibration.state.arm;
  arm.mechanics.payload_kg = 8.0;
  arm.gravity = made.cell.gravity;
  arm.effects.push_back(
      {.name = "joint_compliance", .joints = {1}, .parameters = {4e-6}, .context = {}});
  err_by_effects(made);
  const auto& name = made.cell.nominal.joints[1].name;
  const auto effects = std::exchange(arm.effects, {});
  const std::string missing = drawn("load-" + name, made.results(), 900.0).value();
  EXPECT_NE(missing.find("follows its load: 4.0 µrad per N m"), std::string::npos);
  arm.effects = effects;
  made.after_M.setZero();
  const std::string fitted = drawn("load-" + name, made.results(), 900.0).value();
  EXPECT_NE(fitted.find("The fitted law of " + name + " (joint compliance)"), std::string::npos);
  EXPECT_NE(fitted.find("explains 100 %"), std::string::npos);
  EXPECT_NE(drawn("load-" + name, MadeRun(60, 6).results(), 900.0)->find("1 kg at the flange"),
            std::string::npos);
}

/// target = k * sin(q2)
format::Effect wave_of_q2(format::FormulaTarget target, std::uint8_t component, double k) {
  using format::FormulaOp;
  format::Effect out{.name = "formula", .joints = {}, .parameters = {k}, .context = {}};
  out.formula.name = "wave";
  out.formula.expression = "target = k*sin(q2)";
  out.formula.target = target;
  out.formula.joint = 2;
  out.formula.component = component;
  out.formula.code = {
      format::instruction(FormulaOp::kParameter, 0), format::instruction(FormulaOp::kPosition, 1),
      format::instruction(FormulaOp::kSin), format::instruction(FormulaOp::kMultiply)};
  out.formula.parameters = {{.name = "k", .unit = "rad", .typical = 1e-4, .start = 0.0}};
  return out;
}

TEST(Formulas, ShowWhatTheFormulaAddsAndWhatItHasToExplainWhateverItMoves) {
  using format::FormulaTarget;
  for (const auto& [target, component, turns] :
       {std::tuple{FormulaTarget::kJoint, 0, true}, std::tuple{FormulaTarget::kPost, 5, true},
        std::tuple{FormulaTarget::kBase, 1, false}, std::tuple{FormulaTarget::kTool, 0, false}}) {
    MadeRun made(120, 6);
    made.run.fit.calibration.state.arm.effects = {
        wave_of_q2(target, static_cast<std::uint8_t>(component), 80e-6)};
    err_by_effects(made);  // the formula again, which the model lacks
    const auto found = formula_points(made.results());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].turns, turns);
    EXPECT_EQ(found[0].input, "position of " + made.cell.nominal.joints[1].name);
    ASSERT_EQ(found[0].poses.size(), 120U);
    for (const auto& pose : found[0].poses) {
      EXPECT_NEAR(pose.input, made.measured.q(pose.row, 1) * 180.0 / M_PI, 1e-9);
      EXPECT_NEAR(pose.law, 80e-6 * std::sin(made.measured.q(pose.row, 1)), 1e-15);
      EXPECT_NEAR(pose.value, 2.0 * pose.law, 1e-7) << "what it adds, and what is missing";
    }
    made.after_M.setZero();
    for (const double width : {1280.0, 700.0, 400.0}) {
      const std::string svg = drawn("formulas", made.results(), width).value();
      EXPECT_EQ(collisions(svg, width), "") << width;
      EXPECT_EQ(tests::xml_fault(svg), "");
      EXPECT_NE(svg.find("explains 100 %"), std::string::npos);
    }
  }
  EXPECT_NE(why_empty("formulas", MadeRun(30, 6).results()), "");
}

TEST(Context, NamesTheTemperatureThatTheErrorFollows) {
  MadeRun made(200, 6);
  EXPECT_NE(context_figure(made.results(), Quantity::kTemperature, 700.0).find("do not say"),
            std::string::npos);
  made.measured.context.sensors = {"temp<base>", "temp_arm"};
  made.measured.context.temperature.resize(200, 2);
  for (int i = 0; i < 200; ++i) {
    made.measured.context.temperature.row(i) << 20.0 + 0.05 * i, 21.0;
    made.after_M(i, 2) += 12e-6 * 0.05 * i;
  }
  for (const double width : {1280.0, 700.0, 400.0}) {
    const std::string svg = context_figure(made.results(), Quantity::kTemperature, width);
    EXPECT_EQ(collisions(svg, width), "") << width;
    EXPECT_EQ(tests::xml_fault(svg), "");
    EXPECT_NE(svg.find("z follows"), std::string::npos);
  }
  made.measured.context.payload = Eigen::MatrixXd::Constant(200, 4, 2.5);
  EXPECT_NE(context_figure(made.results(), Quantity::kPayload, 700.0).find("same at all poses"),
            std::string::npos);
}

TEST(Uncertainty, IsTheLeverOfAnAngleTimesItsSigma) {
  MadeRun made(40, 6);
  EXPECT_NE(uncertainty_figure(made.results(), 700.0).find("does not know the covariance"),
            std::string::npos);
  auto& c = made.run.fit.calibration;
  c.parameters = {{.kind = Parameter::Kind::kTarget, .name = "target.x"},
                  {.kind = Parameter::Kind::kD, .name = made.cell.nominal.joints[0].name + ".d"}};
  c.covariance = Eigen::Vector2d(1.0, 400e-12).asDiagonal();
  const std::string svg = uncertainty_figure(made.results(), 700.0);
  EXPECT_NE(svg.find("uncertain by 0.020 mm in the median, and by up to 0.020 mm"),
            std::string::npos)
      << "J1.d shifts every point by as much; the reflector is no part of the arm";
  EXPECT_EQ(poses_in(svg).size(), 40U);
  for (const double width : {1280.0, 700.0, 400.0})
    EXPECT_EQ(collisions(uncertainty_figure(made.results(), width), width), "") << width;
}

TEST(Uncertainty, IsThatOfTheMeasuredAxesAndOfWhatIsCompiled) {
  MadeRun made(40, 6);
  auto& c = made.run.fit.calibration;
  c.parameters = {{.kind = Parameter::Kind::kD, .name = made.cell.nominal.joints[0].name + ".d"}};
  c.covariance = Eigen::MatrixXd::Constant(1, 1, 400e-12);
  const auto is_whole = [&] {
    return uncertainty_figure(made.results(), 700.0).find("uncertain by 0.020 mm in the median") !=
           std::string::npos;
  };
  EXPECT_TRUE(is_whole());
  int whole = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    made.measured.has_axis = {k == 0, k == 1, k == 2};
    whole += is_whole();
  }
  EXPECT_LE(whole, 1) << "a shift has its whole length along one axis at most";
  made.measured.has_axis = {true, true, true};
  c.state.arm.effects.push_back(
      {.name = "drift", .joints = {}, .parameters = {1.0}, .context = {}});
  c.parameters = {{.kind = Parameter::Kind::kEffect, .joint = 0, .name = "drift.dx1"}};
  EXPECT_NE(uncertainty_figure(made.results(), 700.0).find("does not know the covariance"),
            std::string::npos)
      << "a drift of the tracker is cleaned out of the model";
}

/// Trees of two leaves each: J2 below and above the middle, with two levels.
void add_trees(MadeRun& made) {
  auto& arm = made.run.fit.calibration.state.arm;
  const std::size_t n = made.cell.nominal.joints.size();
  for (const auto& row : made.cell.nominal.joints) {
    arm.domain.q_min.push_back(row.q_min);
    arm.domain.q_max.push_back(row.q_max);
  }
  for (auto& tree : arm.trees) {
    tree.depth = 1;
    tree.nodes = {{.threshold = 0.0, .input = 1, .low = ~0, .high = ~1}};
    tree.coefficients.assign(2 * (n + 1), 0.0);
    tree.coefficients[0] = -5e-5, tree.coefficients[n + 1] = 7e-5;
    tree.coefficients[4] = 1e-6;
    tree.bounds = {-1e-4, 1e-4, -1e-4, 1e-4};
  }
}

TEST(LeafMap, ShowsTheBorderAndSaysThatThereIsNoTree) {
  MadeRun made(50, 6);
  EXPECT_NE(leaf_map_figure(made.results(), 700.0).find("has no tree"), std::string::npos);
  add_trees(made);
  for (const double width : {1280.0, 700.0, 400.0}) {
    const std::string svg = leaf_map_figure(made.results(), width);
    EXPECT_EQ(collisions(svg, width), "") << width;
    EXPECT_EQ(tests::xml_fault(svg), "");
    EXPECT_NE(svg.find("2 for x, 2 for y, 2 for z; they correct up to 0.07"), std::string::npos);
    EXPECT_NE(svg.find("100 % of their splits are by " + made.cell.nominal.joints[1].name + " and"),
              std::string::npos)
        << svg.substr(0, 4000);
    EXPECT_EQ(poses_in(svg).size(), 50U);
  }
}

TEST(Refusals, CountWhatTheGuardCuts) {
  MadeRun made(50, 6);
  made.cell.deploy.max_correction_m = 3e-3;
  const std::string good = refusals_figure(made.results(), 900.0);
  EXPECT_EQ(good.find("cut by the guard"), std::string::npos);
  made.run.fit.calibration.state.arm.calibrated.joints[0].d += 5e-3;
  const std::string cut = refusals_figure(made.results(), 900.0);
  EXPECT_NE(cut.find("are cut by the guard"), std::string::npos);
  for (const double width : {1280.0, 700.0, 400.0})
    EXPECT_EQ(collisions(refusals_figure(made.results(), width), width), "") << width;
}

TEST(Observability, SaysWhatThePlanBringsAndThatNothingIsPlanned) {
  InformationGrowth growth{.sigma_now_m = 40e-6, .planned = {}, .random = {}};
  EXPECT_NE(observability_figure(growth, 3, 700.0).find("No further pose"), std::string::npos);
  for (int k = 1; k <= 10; ++k) {
    growth.planned.push_back({"N<" + std::to_string(k), 5.0 / k, 40e-6 - 2e-6 * k});
    growth.random.push_back({"random", 2.0 / k, 40e-6 - 1e-6 * k});
  }
  for (const double width : {1280.0, 700.0, 400.0}) {
    const std::string svg = observability_figure(growth, 3, width);
    EXPECT_EQ(collisions(svg, width), "") << width;
    EXPECT_EQ(tests::xml_fault(svg), "");
    EXPECT_EQ(poses_in(svg).size(), 10U);
  }
  const std::string svg = observability_figure(growth, 3, 1280.0);
  EXPECT_NE(svg.find("from 0.040 mm to 0.020 mm; the first 5 bring half"), std::string::npos);
}

bench::Benchmark made_benchmark() {
  using bench::Part;
  using bench::Way;
  bench::Benchmark out;
  out.cycle_s = 0.004;
  out.poses = 1024;
  out.why_not_representative = {"virtual machine <\"1\">"};
  for (const Way way : {Way::kWarm, Way::kChain, Way::kCold})
    for (const auto& [part, label, ns] : std::vector<std::tuple<Part, std::string, double>>{
             {Part::kCycle, "", 2000.0},
             {Part::kCorrect, "", 1800.0},
             {Part::kGuard, "", 40.0},
             {Part::kPredict, "", 300.0},
             {Part::kKinematics, "", 90.0},
             {Part::kEffect, "gear_ripple:J2", 120.0},
             {Part::kTrees, "", 290.0}})
      out.timings.all.push_back(
          {.part = part, .label = label, .way = way, .ns = {0.9 * ns, ns, 1.5 * ns}});
  return out;
}

TEST(Latency, MarksTheWorstCallAndTheCycle) {
  for (const double width : {1280.0, 700.0, 400.0}) {
    const std::string svg = latency_figure(made_benchmark(), width);
    EXPECT_EQ(collisions(svg, width), "") << width;
    EXPECT_EQ(tests::xml_fault(svg), "");
    EXPECT_NE(svg.find("the worst of 3 calls took 3 us"), std::string::npos);
    EXPECT_NE(svg.find(">cycle 4 ms<"), std::string::npos) << width;
  }
  bench::Benchmark none = made_benchmark();
  for (auto& timing : none.timings.all) timing.ns.clear();
  EXPECT_NE(latency_figure(none, 700.0).find("No call was timed"), std::string::npos);
  for (auto& timing : none.timings.all) timing.ns = {0.0};
  EXPECT_EQ(latency_figure(none, 700.0).find("nan"), std::string::npos);
}

TEST(Cost, NamesTheDearestPart) {
  for (const double width : {1280.0, 700.0, 400.0}) {
    const std::string svg = cost_figure(made_benchmark(), width);
    EXPECT_EQ(collisions(svg, width), "") << width;
    EXPECT_EQ(tests::xml_fault(svg), "");
    EXPECT_NE(svg.find("is trees, 200 ns"), std::string::npos);
    EXPECT_NE(svg.find("gear ripple of J2: 30 ns"), std::string::npos);
  }
}

TEST(Waterfall, WritesOutWhatWasAddedAtEveryWidth) {
  const MadeRun made(60, 6);
  std::string all;
  for (int k = 1; k <= 12; ++k)
    all += (k == 1 ? "" : " + ") + std::string("effect ") + char('A' + k);
  const std::vector<WaterfallStep> steps{
      {"nominal arm", 1e-3, 0}, {"geometry", 2e-4, 3}, {all, 2e-5, 1}};
  for (const double width : {1280.0, 700.0, 400.0}) {
    const std::string svg = waterfall(made.results(), steps, width);
    EXPECT_EQ(collisions(svg, width), "") << width;
    EXPECT_NE(svg.find("effect M</text>"), std::string::npos) << "the last one is not cut off";
  }
}

TEST(Empty, IsWhatWasNotMeasuredOrNeverChanged) {
  MadeRun made(30, 6);
  EXPECT_NE(why_empty("context-payload", made.results()), "");
  EXPECT_NE(why_empty("leaf-map", made.results()), "");
  EXPECT_EQ(why_empty("order", made.results()), "");
  made.measured.context.payload = RowsN::Constant(30, 4, 2.0);
  EXPECT_NE(why_empty("context-payload", made.results()), "");
  made.measured.context.payload(3, 0) = 5.0;
  EXPECT_EQ(why_empty("context-payload", made.results()), "");
  add_trees(made);
  EXPECT_EQ(why_empty("leaf-map", made.results()), "");
}

TEST(HeatMap, EqualNeighboursAreOneRectangleAndNothingIsLost) {
  HeatMap map;
  map.value.resize(2, 3);
  map.value << 0.0, 0.0, 1.0,  //
      1.0, 0.5, 2.0;
  map.x_title = "a < b & c";
  const std::string svg = map_file(map, {.title = "map", .sentence = ""}, "mm", 700.0);
  // Ground, paper and frame of the panel, five of the legend; rows of 2 and 3 different runs.
  EXPECT_EQ(count(svg, "<rect"), 1 + 2 + 5 + 2 + 3);
  EXPECT_GE(count(svg, "fill=\"#fde725\">"), 2) << "1 twice, and 2, which is beyond the scale";
  EXPECT_EQ(tests::xml_fault(svg), "");
  map.value.setZero();
  map.most = 0.0;
  EXPECT_EQ(map_file(map, {.title = "", .sentence = ""}, "mm", 400.0).find("nan"),
            std::string::npos);
}

TEST(Thinning, KeepsTheWorstAndIsToldAt12000Poses) {
  MadeRun made(12000, 6);
  made.after_M.row(6000) *= 50.0;
  const RunResults results = made.results();
  for (const auto& name : {"error-by-pose", "error-map"}) {
    const std::string svg = drawn(name, results, 1280.0).value();
    EXPECT_LT(svg.size(), 1000000U) << name;
    EXPECT_TRUE(poses_in(svg).contains("P6001")) << name;
    EXPECT_NE(svg.find(" of 2400 poses are drawn"), std::string::npos) << name;
    EXPECT_EQ(collisions(svg, 1280.0), "") << name;
  }
  for (const auto& name : {"joints", "order", "uncertainty"})
    EXPECT_LT(drawn(name, results, 1280.0)->size(), 400000U) << name;
}

TEST(Figures, TakeLessThan100MillisecondsFor1500Poses) {
  if (PLUMB_TIMED == 0) GTEST_SKIP() << "timing is judged in release";
  MadeRun made(1500, 6);
  for (int k = 0; k < 12; ++k) add_ripple(made, 1, 2.0 + 3.0 * k, 1e-5, 1e-5);
  add_trees(made);
  const RunResults results = made.results();
  for (const auto& name : run_figures(made.cell)) {
    std::vector<double> ms;
    for (int i = 0; i < 5; ++i) {
      const double begin = tests::processor_s();
      ASSERT_TRUE(drawn(name, results, 900.0));
      ms.push_back(1e3 * (tests::processor_s() - begin));
    }
    std::nth_element(ms.begin(), ms.begin() + 2, ms.end());
    std::printf("%s: %.1f ms\n", name.c_str(), ms[2]);
    EXPECT_LT(ms[2], 100.0 * tests::times_slower()) << name;
  }
}

TEST(Registry, DrawsWhatItListsAndNothingElse) {
  const MadeRun made(20, 2);
  const auto names = run_figures(made.cell);
  EXPECT_EQ(names.size(), figure_list().size() - 5 + 3)
      << "two joints instead of JN three times; no diagnosis, no plan, no fits, no timing";
  for (const auto& name : names) EXPECT_TRUE(drawn(name, made.results(), 700.0)) << name;
  for (const auto* name : {"joint-J3", "joint-JN", "evidence", "observability", "poses", "latency",
                           "cost", "context-NAME", "", "../error-hist"})
    EXPECT_FALSE(drawn(name, made.results(), 700.0)) << name;
}

}  // namespace
}  // namespace plumb::offline::figures
