// SPDX-License-Identifier: Apache-2.0
#include "check/orientation_check.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <sstream>
#include <vector>

#include "check/check.hpp"
#include "fit/fit.hpp"
#include "fit/fit_cell.hpp"
#include "tests/check/scrambled.hpp"
#include "tests/check/simulated_arm.hpp"

namespace plumb::offline {
namespace {

using Kind = MeasuredOrientations::Kind;
using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

// ------------------------------------------------- a simulator that shares nothing with the
// program

constexpr double kDegree = M_PI / 180.0;

struct Link {
  double alpha, a, d, theta;  // [deg], [mm]
};

struct TestArm {
  bool standard = true;
  std::vector<Link> links;
  double low = -100, high = 100;  // [deg]
};

TestArm welder() {
  return {true,
          {{-90, 150, 525, 0},
           {0, 790, 0, -90},
           {-90, 250, 0, 0},
           {90, 0, 835, 0},
           {-90, 0, 0, 0},
           {0, 0, 100, 0}}};
}

TestArm collaborative() {
  return {false,
          {{0, 0, 152, 0},
           {90, 0, 0, 0},
           {0, -425, 0, 0},
           {0, -392, 109, 0},
           {90, 0, 95, 0},
           {-90, 0, 82, 0}},
          -150,
          150};
}

TestArm seven_axes() {
  return {true,
          {{-90, 0, 360, 0},
           {90, 0, 0, 0},
           {90, 0, 420, 0},
           {-90, 0, 0, 0},
           {-90, 0, 400, 0},
           {90, 0, 0, 0},
           {0, 0, 126, 0}}};
}

double gauss(tests::Random& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random.uniform(0.0, 1.0);
  return sum;
}

Matrix about(int axis, double angle) {
  return Eigen::AngleAxisd(angle, Vector::Unit(axis)).toRotationMatrix();
}

Eigen::Isometry3d forward(const TestArm& arm, const std::vector<double>& q_deg) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  for (std::size_t j = 0; j < arm.links.size(); ++j) {
    const Link& link = arm.links[j];
    Eigen::Isometry3d turn = Eigen::Isometry3d::Identity(), twist = turn;
    turn.rotate(about(2, (link.theta + q_deg[j]) * kDegree));
    turn.translate(Vector(0, 0, link.d));
    twist.translate(Vector(link.a, 0, 0));
    twist.rotate(about(0, link.alpha * kDegree));
    out = arm.standard ? out * turn * twist : out * twist * turn;
  }
  return out;
}

struct Reading {
  std::vector<double> q_deg;
  Vector point_mm;
  Matrix turn;     // measured
  Matrix nominal;  // what a controller would say, in its base
};

struct Measured {
  TestArm arm;
  double stated_urad = 40;  // 0: not stated
  std::vector<Reading> readings;
};

struct Noise {
  double um = 20, urad = 30;
};

Measured measured_with(const TestArm& arm, Noise noise, std::uint64_t seed = 1, int poses = 80) {
  tests::Random random(seed);
  const auto any_turn = [&] {
    Matrix out = Matrix::Identity();
    for (int k = 0; k < 3; ++k) out = about(k, random.uniform(-3.0, 3.0)) * out;
    return out;
  };
  TestArm real = arm;
  for (Link& link : real.links) {
    link.alpha += 0.03 * gauss(random), link.theta += 0.03 * gauss(random);
    link.a += 0.4 * gauss(random), link.d += 0.4 * gauss(random);
  }
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity(), target = frame;
  frame.rotate(any_turn());
  frame.pretranslate(Vector(1500, -300, 400));
  target.rotate(any_turn());
  target.pretranslate(Vector(15, -10, 140));
  Measured out{arm, 40, {}};
  for (int i = 0; i < poses; ++i) {
    Reading one;
    for (std::size_t j = 0; j < arm.links.size(); ++j)
      one.q_deg.push_back(std::round(random.uniform(arm.low, arm.high) * 1e4) / 1e4);
    const Eigen::Isometry3d pose = frame * forward(real, one.q_deg) * target;
    Vector error;
    for (int k = 0; k < 3; ++k) {
      one.point_mm(k) = pose.translation()(k) + 1e-3 * noise.um * gauss(random);
      error(k) = 1e-6 * noise.urad * gauss(random);
    }
    const double angle = error.norm();
    one.turn = (angle > 0 ? Eigen::AngleAxisd(angle, error / angle).toRotationMatrix()
                          : Matrix(Matrix::Identity())) *
               pose.linear();
    one.nominal = forward(arm, one.q_deg).linear();
    out.readings.push_back(one);
  }
  return out;
}

/// The text of the orientation columns: what stands above the header, their headings, their
/// numbers.
struct Written {
  std::string comment, headings;
  std::function<std::vector<double>(const Reading&)> numbers;
};

std::vector<double> wxyz(const Matrix& R) {
  const Eigen::Quaterniond q(R);
  return {q.w(), q.x(), q.y(), q.z()};
}

Written as_quaternion() {
  return {"", "qw,qx,qy,qz", [](const Reading& r) { return wxyz(r.turn); }};
}

scrambled::Files files_of(const Measured& measured, const Written& written) {
  scrambled::Files out;
  std::ostringstream cell, csv;
  const std::string unit = measured.arm.standard ? "standard" : "modified";
  cell << "schema = \"cell/1\"\n[cell]\nname = \"arm\"\nserial = \"1\"\ntolerance_mm = 0.2\n"
       << "[robot]\nname = \"arm\"\ndh_convention = \"" << unit
       << "\"\nlength_unit = \"mm\"\nangle_unit = \"deg\"\njoints = [\n";
  int number = 0;
  for (const Link& link : measured.arm.links)
    cell << "  { name = \"J" << ++number << "\", alpha = " << link.alpha << ", a = " << link.a
         << ", d = " << link.d << ", theta = " << link.theta << ", q = [" << measured.arm.low
         << ", " << measured.arm.high << "] },\n";
  cell << "]\n[measurement]\nfiles = [\"measurements.csv\"]\nframe = \"fit\"\ntarget = \"fit\"\n"
       << "sigma_um = 20\n";
  if (measured.stated_urad > 0) cell << "sigma_urad = " << measured.stated_urad << "\n";
  cell << "\n[effects]\ngeometry = true\n";
  if (!written.comment.empty()) csv << written.comment << "\n";
  csv << "pose";
  for (std::size_t j = 0; j < measured.arm.links.size(); ++j) csv << ",q" << j + 1 << "_deg";
  csv << ",x_mm,y_mm,z_mm," << written.headings << "\n";
  csv.precision(10);
  int row = 0;
  for (const Reading& one : measured.readings) {
    csv << "P" << ++row;
    for (const double q : one.q_deg) csv << "," << q;
    for (const double x : one.point_mm) csv << "," << x;
    for (const double x : written.numbers(one)) csv << "," << x;
    csv << "\n";
  }
  out.cell = cell.str();
  out.csv = csv.str();
  return out;
}

scrambled::Case case_of(const scrambled::Folder& folder, const Measured& measured,
                        const Written& written) {
  return scrambled::opened(files_of(measured, written), folder.path());
}

// ------------------------------------------------------------------------------ conventions

/// Angles (a, b, c) with R = turn(i, a) turn(j, b) turn(k, c), i, j, k all different.
std::vector<double> moving(const Matrix& R, int i, int j, int k) {
  const Vector angles = R.eulerAngles(i, j, k);
  return {angles(0), angles(1), angles(2)};
}

std::vector<double> times(std::vector<double> all, double factor) {
  for (double& one : all) one *= factor;
  return all;
}

std::vector<double> rotation_vector_of(const Matrix& R) {
  const Eigen::AngleAxisd turn(R);
  const Vector v = turn.angle() * turn.axis();
  return {v(0), v(1), v(2)};
}

constexpr const char* kFixed = "# rot: xyz-fixed";
constexpr const char* kDegrees = "rx_deg,ry_deg,rz_deg";

struct Convention6 {
  const char* name;
  Written written;
  std::string words;  // part of the sentence
};

std::vector<Convention6> wrong_conventions() {
  return {
      {"xyzw",
       {"", "qw,qx,qy,qz",
        [](const Reading& r) {
          const auto q = wxyz(r.turn);
          return std::vector<double>{q[1], q[2], q[3], q[0]};
        }},
       "qw, qx, qy, qz hold x, y, z, w"},
      {"wxyz under qx, qy, qz, qw",
       {"", "qx,qy,qz,qw", [](const Reading& r) { return wxyz(r.turn); }},
       "qx, qy, qz, qw hold w, x, y, z"},
      {"inverse",
       {"", "qw,qx,qy,qz", [](const Reading& r) { return wxyz(r.turn.transpose()); }},
       "the inverse of what is meant"},
      {"inverse xyzw",
       {"", "qw,qx,qy,qz",
        [](const Reading& r) {
          const auto q = wxyz(r.turn.transpose());
          return std::vector<double>{q[1], q[2], q[3], q[0]};
        }},
       "the inverse of what is meant"},
      {"rotation vector",
       {kFixed, kDegrees,
        [](const Reading& r) { return times(rotation_vector_of(r.turn), 1 / kDegree); }},
       "rx, ry, rz hold a rotation vector"},
      {"rotation vector in rad",
       {kFixed, kDegrees, [](const Reading& r) { return rotation_vector_of(r.turn); }},
       "rx, ry, rz are in rad, not deg"},
      {"KUKA",
       {kFixed, kDegrees,
        [](const Reading& r) { return times(moving(r.turn, 2, 1, 0), 1 / kDegree); }},
       "KUKA's A, B, C (zyx-moving)"},
      {"xyz-moving",
       {kFixed, kDegrees,
        [](const Reading& r) { return times(moving(r.turn, 0, 1, 2), 1 / kDegree); }},
       "xyz-moving"},
      {"zyz-moving",
       {kFixed, kDegrees,
        [](const Reading& r) { return times(moving(r.turn, 2, 1, 2), 1 / kDegree); }},
       "zyz-moving"},
      {"zxz-moving",
       {kFixed, kDegrees,
        [](const Reading& r) { return times(moving(r.turn, 2, 0, 2), 1 / kDegree); }},
       "zxz-moving"},
      {"yxz about the axes of the columns' names",
       {kFixed, kDegrees,
        [](const Reading& r) {
          const auto a = times(moving(r.turn, 1, 0, 2), 1 / kDegree);
          return std::vector<double>{a[1], a[0], a[2]};
        }},
       "turn in the order yxz-moving"},
      {"rad under deg",
       {kFixed, kDegrees,
        [](const Reading& r) {
          const auto a = moving(r.turn, 2, 1, 0);
          return std::vector<double>{a[2], a[1], a[0]};
        }},
       "rx, ry, rz are in rad, not deg"},
      {"deg under rad",
       {kFixed, "rx_rad,ry_rad,rz_rad",
        [](const Reading& r) {
          const auto a = times(moving(r.turn, 2, 1, 0), 1 / kDegree);
          return std::vector<double>{a[2], a[1], a[0]};
        }},
       "rx, ry, rz are in deg, not rad"},
      {"inverse angles",
       {kFixed, kDegrees,
        [](const Reading& r) {
          const auto a = times(moving(r.turn.transpose(), 2, 1, 0), 1 / kDegree);
          return std::vector<double>{a[2], a[1], a[0]};
        }},
       "the inverse of what is meant"},
      {"labelled a rotation vector",
       {"# rot: rotation-vector", kDegrees,
        [](const Reading& r) {
          const auto a = times(moving(r.turn, 2, 1, 0), 1 / kDegree);
          return std::vector<double>{a[2], a[1], a[0]};
        }},
       "xyz-fixed"},
  };
}

TEST(OrientationCheck, NamesEveryConventionAndItsEditPutsTheFilesRight) {
  const std::vector<TestArm> arms{welder(), collaborative(), seven_axes()};
  std::uint64_t seed = 1;
  for (const auto& wrong : wrong_conventions()) {
    SCOPED_TRACE(wrong.name);
    const TestArm& arm = arms[seed % arms.size()];
    const Measured measured = measured_with(arm, {}, seed++);
    const scrambled::Files files = files_of(measured, wrong.written);
    const scrambled::Folder folder, fixed;
    const auto before = scrambled::opened(files, folder.path());
    const OrientationCheck found = check_orientations(before.cell, before.measured);
    ASSERT_EQ(found.judged.kind, Kind::kOtherwise);
    ASSERT_EQ(found.meant.size(), 1U) << found.meant[1];
    EXPECT_NE(found.meant[0].find(wrong.words), std::string::npos) << found.meant[0];
    EXPECT_NEAR(found.judged.left_rad, 30e-6, 20e-6);
    const int header = wrong.written.comment.empty() ? 1 : 2;
    const auto after =
        scrambled::opened({files.cell, edited(files.csv, header, found.edit), {}}, fixed.path());
    EXPECT_EQ(check_orientations(after.cell, after.measured).judged.kind, Kind::kGood);
  }
}

TEST(OrientationCheck, FitLeavesOutWhatIsMeantOtherwise) {
  for (const std::size_t k : {0U, 4U, 11U}) {
    const auto wrong = wrong_conventions()[k];
    SCOPED_TRACE(wrong.name);
    const Measured measured = measured_with(welder(), {}, 3);
    const scrambled::Folder folder;
    const auto files = case_of(folder, measured, wrong.written);
    const Fit fit = fit_cell(files.cell, files.measured);
    EXPECT_LT(fit.held.mean, 45e-6);
    EXPECT_EQ(fit.remarks.back().code, "W-FIT-ORIENTATION") << fit.remarks.back().message;
    const Check check = check_cell(files.cell, files.measured);
    EXPECT_EQ(check.exit, Exit::kInput);
    EXPECT_TRUE(can_be_fixed(check));
    EXPECT_EQ(check.findings.front().code, "E-CHECK-ORIENTATION");
    EXPECT_NE(verdict(check).find(wrong.words), std::string::npos) << verdict(check);
  }
}

TEST(OrientationCheck, OnlyWarnsWhereTheCellAsksForNoOrientation) {
  Measured measured = measured_with(collaborative(), {}, 4);
  measured.stated_urad = 0;
  const scrambled::Folder folder;
  const auto files = case_of(folder, measured, wrong_conventions()[0].written);
  const Check check = check_cell(files.cell, files.measured);
  EXPECT_EQ(check.exit, Exit::kDone);
  EXPECT_TRUE(can_be_fixed(check));
  EXPECT_EQ(check.findings.front().code, "W-CHECK-ORIENTATION");
}

// ----------------------------------------------------------------------------- none measured

TEST(OrientationCheck, KnowsOrientationsThatNobodyMeasured) {
  const Matrix turned = about(2, 0.7) * about(0, -1.1);
  const std::vector<std::pair<Written, Kind>> cases{
      {{"", "qw,qx,qy,qz",
        [](const Reading&) {
          return std::vector<double>{1, 0, 0, 0};
        }},
       Kind::kConstant},
      {{"", "qw,qx,qy,qz",
        [](const Reading&) {
          return std::vector<double>{0.6, 0, 0.8, 0};
        }},
       Kind::kConstant},
      {{"", "qw,qx,qy,qz", [](const Reading& r) { return wxyz(r.nominal); }}, Kind::kNominal},
      {{"", "qw,qx,qy,qz", [&](const Reading& r) { return wxyz(turned * r.nominal * turned); }},
       Kind::kNominal},
  };
  for (const TestArm& arm : {welder(), collaborative()})
    for (const double stated : {0.0, 40.0, 300.0})
      for (const auto& [written, kind] : cases) {
        Measured measured = measured_with(arm, {}, 5);
        measured.stated_urad = stated;
        const scrambled::Folder folder;
        const auto files = case_of(folder, measured, written);
        const auto judged = check_orientations(files.cell, files.measured).judged;
        EXPECT_EQ(judged.kind, kind) << stated;
        if (!arm.standard || stated != 40.0) continue;
        const Fit fit = fit_cell(files.cell, files.measured);
        EXPECT_LT(fit.held.mean, 45e-6);
        EXPECT_EQ(fit.turn_held.n, 0);
        EXPECT_FALSE(fit.orientations.fit_to_use());
        EXPECT_EQ(fit.remarks.back().code, "W-FIT-ORIENTATION");
      }
}

TEST(OrientationCheck, KnowsOrientationsOfAnotherFrame) {
  const Matrix turned = about(1, 0.4) * about(0, 2.1);
  const Measured measured = measured_with(welder(), {}, 6);
  const scrambled::Folder folder;
  const auto files =
      case_of(folder, measured,
              {"", "qw,qx,qy,qz", [&](const Reading& r) { return wxyz(turned * r.turn); }});
  EXPECT_EQ(check_orientations(files.cell, files.measured).judged.kind, Kind::kTurned);
}

TEST(OrientationCheck, ClaimsNothingOfNumbersWithoutMeaning) {
  const Measured measured = measured_with(welder(), {}, 7);
  tests::Random random(7);
  const scrambled::Folder folder;
  const auto files =
      case_of(folder, measured, {kFixed, kDegrees, [&](const Reading&) {
                                   return std::vector<double>{random.uniform(-180, 180),
                                                              random.uniform(-80, 80),
                                                              random.uniform(-180, 180)};
                                 }});
  const Check check = check_cell(files.cell, files.measured);
  EXPECT_EQ(check.orientations.judged.kind, Kind::kUnexplained);
  EXPECT_EQ(check.exit, Exit::kDone) << verdict(check);
  EXPECT_NE(verdict(check).find("Usable for positions alone"), std::string::npos);
  EXPECT_FALSE(can_be_fixed(check));
}

// ----------------------------------------------------------------------------------- noise

TEST(OrientationCheck, ScatterBeyondTheStatedIsFoundAndDoesNoHarm) {
  for (const TestArm& arm : {welder(), collaborative()})
    for (const double urad :
         arm.standard ? std::vector{300.0, 3000.0} : std::vector{1000.0, 15000.0}) {
      SCOPED_TRACE(urad);
      Measured measured = measured_with(arm, {.urad = urad}, 8);
      measured.stated_urad = 50;
      const scrambled::Folder folder;
      const auto files = case_of(folder, measured, as_quaternion());
      Cell without = files.cell;
      without.measurement.sigma_rad.reset();
      const Fit alone = fit_cell(without, files.measured);
      const Fit fit = fit_cell(files.cell, files.measured);
      EXPECT_EQ(fit.orientations.kind, Kind::kScattered);
      EXPECT_NEAR(fit.orientations.left_rad, urad * 1e-6, 0.25 * urad * 1e-6);
      EXPECT_LT(fit.held.mean, 1.1 * alone.held.mean);
      EXPECT_EQ(fit.remarks.back().code, "W-FIT-ORIENTATION");
      EXPECT_NE(fit.remarks.back().help.find("sigma_urad = "), std::string::npos);
      const Check check = check_cell(files.cell, files.measured);
      EXPECT_EQ(check.orientations.judged.kind, Kind::kScattered);
      EXPECT_EQ(check.exit, Exit::kDone);
      EXPECT_EQ(alone.remarks.back().code, "N-FIT-ORIENTATION");
      EXPECT_NEAR(alone.orientations.left_rad, urad * 1e-6, 0.25 * urad * 1e-6);
    }
}

TEST(OrientationCheck, RepeatsThatAgreeBlameTheModelAndNotTheInstrument) {
  Measured measured = measured_with(welder(), {.urad = 0}, 9);
  tests::Random random(9);
  std::vector<Reading> twice;
  for (Reading& one : measured.readings) {
    // The last joint turns by more than its encoder says, which the point hardly shows.
    one.turn *= Matrix::Identity();
    const Vector error(600e-6 * std::sin(7 * one.q_deg[5]), 600e-6 * std::cos(3 * one.q_deg[4]),
                       600e-6 * std::sin(5 * one.q_deg[3]));
    for (int k = 0; k < 2; ++k) {
      Reading again = one;
      Matrix off = Matrix::Identity();
      for (int axis = 0; axis < 3; ++axis)
        off = about(axis, error(axis) + 30e-6 * gauss(random)) * off;
      again.turn = off * one.turn;
      twice.push_back(again);
    }
  }
  measured.readings = twice;
  const scrambled::Folder folder;
  const auto files = case_of(folder, measured, as_quaternion());
  EXPECT_EQ(fit_cell(files.cell, files.measured).orientations.kind, Kind::kMissed);
}

// --------------------------------------------------------------------------------- healthy

TEST(OrientationCheck, HealthyOrientationsAreFittedAsStatedAndNothingIsSaid) {
  for (const TestArm& arm : {welder(), collaborative(), seven_axes()})
    for (const double urad : {0.0, 30.0, 2000.0})
      for (const int poses : {40, 90}) {
        SCOPED_TRACE(testing::Message() << urad << " " << poses);
        Measured measured = measured_with(arm, {.urad = urad}, 10, poses);
        measured.stated_urad = std::max(urad, 10.0);
        const scrambled::Folder folder;
        const auto files = case_of(folder, measured, as_quaternion());
        const OrientationCheck found = check_orientations(files.cell, files.measured);
        EXPECT_EQ(found.judged.kind, Kind::kGood);
        EXPECT_FALSE(orientation_finding(found));
        const Cell judged = with_orientations_as_judged(files.cell, found.judged);
        EXPECT_EQ(judged.measurement.sigma_rad, files.cell.measurement.sigma_rad);
      }
}

TEST(OrientationCheck, AWristThatOnlyOrientationsShowIsNoScatter) {
  // Points of 200 um and a reflector near the last axes say little of the wrist.
  Measured measured = measured_with(welder(), {.um = 200, .urad = 20}, 11, 60);
  measured.stated_urad = 20;
  const scrambled::Folder folder;
  const auto files = case_of(folder, measured, as_quaternion());
  EXPECT_EQ(check_orientations(files.cell, files.measured).judged.kind, Kind::kGood);
}

TEST(OrientationCheck, AllNamesOfRotationsAreReadAsTheySay) {
  const Measured measured = measured_with(collaborative(), {}, 12);
  const std::vector<std::pair<std::string, std::function<std::vector<double>(const Reading&)>>> all{
      {"xyz-moving", [](const Reading& r) { return moving(r.turn, 0, 1, 2); }},
      {"zyx-moving", [](const Reading& r) { return moving(r.turn, 2, 1, 0); }},
      {"zyz-moving", [](const Reading& r) { return moving(r.turn, 2, 1, 2); }},
      {"rotation-vector", [](const Reading& r) { return rotation_vector_of(r.turn); }},
  };
  for (const auto& [name, numbers] : all) {
    const scrambled::Folder folder;
    const auto files =
        case_of(folder, measured, {"# rot: " + name, "rx_rad,ry_rad,rz_rad", numbers});
    EXPECT_EQ(check_orientations(files.cell, files.measured).judged.kind, Kind::kGood) << name;
  }
}

/// Quaternions whose scalar part stands last, under headings that put it first.
Written with_scalar_last() {
  return {"", "qw,qx,qy,qz", [](const Reading& r) {
            const auto q = wxyz(r.turn);
            return std::vector<double>{q[1], q[2], q[3], q[0]};
          }};
}

OrientationCheck checked_alone(double stated_urad, const Written& written) {
  Measured measured = measured_with(welder(), {});
  measured.stated_urad = stated_urad;
  const scrambled::Folder folder;
  const auto c = case_of(folder, measured, written);
  return check_orientations(c.cell, c.measured);
}

TEST(OrientationCheckAlone, StopsOnlyWhereTheCellAsksForWhatIsMeantOtherwise) {
  for (const double stated_urad : {40.0, 0.0}) {
    const OrientationCheck right = checked_alone(stated_urad, as_quaternion());
    EXPECT_FALSE(right.stops());
    EXPECT_TRUE(right.edit.empty());
    EXPECT_FALSE(orientation_finding(right));

    const OrientationCheck wrong = checked_alone(stated_urad, with_scalar_last());
    EXPECT_EQ(wrong.judged.kind, Kind::kOtherwise);
    ASSERT_EQ(wrong.meant.size(), 1U);
    EXPECT_FALSE(wrong.edit.empty()) << "one interpretation fits";
    EXPECT_EQ(wrong.stops(), stated_urad > 0.0);
    const auto found = orientation_finding(wrong);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->code, stated_urad > 0.0 ? "E-CHECK-ORIENTATION" : "W-CHECK-ORIENTATION");
    EXPECT_EQ(found->severity, stated_urad > 0.0 ? Severity::kError : Severity::kWarning);
    EXPECT_EQ(found->help, "plumb check --fix");
  }
}

/// Several ways of reading them that fit alike leave the choice to the user.
TEST(OrientationCheckAlone, IsNoReasonToStopWhereSeveralInterpretationsFit) {
  OrientationCheck check = checked_alone(40.0, with_scalar_last());
  check.meant.push_back("something else");
  check.edit = {};
  EXPECT_FALSE(check.stops());
  const auto found = orientation_finding(check);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->code, "W-CHECK-ORIENTATION");
  EXPECT_NE(found->help, "plumb check --fix");
}

TEST(OrientationCheckAlone, OfFilesWithoutOrientationsIsNone) {
  const SimulatedArm arm = simulated_arm(1, 30);
  const OrientationCheck none = check_orientations(arm.cell, arm.measured);
  EXPECT_EQ(none.judged.kind, Kind::kNone);
  EXPECT_FALSE(none.stops());
  EXPECT_FALSE(orientation_finding(none));
}

}  // namespace
}  // namespace plumb::offline
