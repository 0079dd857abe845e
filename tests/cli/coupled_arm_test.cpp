// SPDX-License-Identifier: Apache-2.0
// An arm whose controller shows J3 = q3 + q2, from its readings to its corrected commands, beside a
// forward kinematics of the test's own.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "sandbox.hpp"

namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kTool_mm = 100.0, kMicrometre_mm = 1e-3;

using Matrix = std::array<std::array<double, 3>, 3>;
using Point = std::array<double, 3>;
using Joints = std::array<double, 6>;

struct Pose {
  Matrix R{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Point p{};
};

Pose times(const Pose& a, const Pose& b) {
  Pose out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.p[i] = a.p[i];
    for (std::size_t j = 0; j < 3; ++j) {
      out.p[i] += a.R[i][j] * b.p[j];
      out.R[i][j] = 0.0;
      for (std::size_t k = 0; k < 3; ++k) out.R[i][j] += a.R[i][k] * b.R[k][j];
    }
  }
  return out;
}

struct Row {
  double alpha, a, d, theta;  // standard Denavit-Hartenberg [deg, mm]
};
using Arm = std::array<Row, 6>;

constexpr Arm kNominal{{{-90, 25, 400, 0},
                        {0, 455, 0, 0},
                        {90, 35, 0, 90},
                        {-90, 0, 420, 0},
                        {90, 0, 0, 0},
                        {0, 0, 80, 0}}};

Arm true_arm() {
  Arm out = kNominal;
  out[1].a += 0.5;
  out[2].theta += 0.03;
  out[2].a -= 0.2;
  out[3].d += 0.3;
  out[4].theta -= 0.05;
  return out;
}

/// Of the values that the controller shows [deg]: J3 turns by its value less that of J2.
Pose forward(const Arm& arm, Joints q) {
  q[2] -= q[1];
  Pose out;
  for (std::size_t j = 0; j < 6; ++j) {
    const double t = (arm[j].theta + q[j]) * kDegree, w = arm[j].alpha * kDegree;
    const double ct = std::cos(t), st = std::sin(t), ca = std::cos(w), sa = std::sin(w);
    out = times(out, {{{{ct, -st * ca, st * sa}, {st, ct * ca, -ct * sa}, {0, sa, ca}}},
                      {arm[j].a * ct, arm[j].a * st, arm[j].d}});
  }
  return out;
}

Point seen_at(const Pose& flange, const Point& target_mm) {
  return times(flange, {.R = Pose{}.R, .p = target_mm}).p;
}

/// w, x, y, z of a rotation that turns by less than half a turn.
std::array<double, 4> quaternion(const Matrix& R) {
  const double w = std::sqrt(std::max(0.0, 1.0 + R[0][0] + R[1][1] + R[2][2])) / 2.0;
  return {w, (R[2][1] - R[1][2]) / (4 * w), (R[0][2] - R[2][0]) / (4 * w),
          (R[1][0] - R[0][1]) / (4 * w)};
}

Matrix rotation(const std::array<double, 4>& q) {
  const auto& [w, x, y, z] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

using Twist = std::array<double, 6>;

/// What takes `from` to `to`: mm, and nearby radians times 100 mm.
Twist between(const Pose& from, const Pose& to) {
  Twist out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = to.p[i] - from.p[i];
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    for (std::size_t c = 0; c < 3; ++c)
      out[3 + i] += 50.0 * (from.R[j][c] * to.R[k][c] - from.R[k][c] * to.R[j][c]);
  }
  return out;
}

/// The x of A x = b, by Gauss with row exchange.
Twist solved(std::array<Twist, 6> A, Twist b) {
  for (std::size_t k = 0; k < 6; ++k) {
    std::size_t best = k;
    for (std::size_t i = k; i < 6; ++i)
      if (std::abs(A[i][k]) > std::abs(A[best][k])) best = i;
    std::swap(A[k], A[best]);
    std::swap(b[k], b[best]);
    for (std::size_t i = 0; i < 6; ++i) {
      if (i == k) continue;
      const double share = A[i][k] / A[k][k];
      for (std::size_t j = k; j < 6; ++j) A[i][j] -= share * A[k][j];
      b[i] -= share * b[k];
    }
  }
  for (std::size_t k = 0; k < 6; ++k) b[k] /= A[k][k];
  return b;
}

/// What a controller that believes in the nominal arm does with a pose of the flange: Newton's
/// method from joints nearby.
Joints commanded(const Pose& wanted, Joints q) {
  for (int step = 0; step < 8; ++step) {
    std::array<Twist, 6> A{};
    const Pose now = forward(kNominal, q);
    for (std::size_t j = 0; j < 6; ++j) {
      Joints moved = q;
      moved[j] += 1e-4;
      const Twist column = between(now, forward(kNominal, moved));
      for (std::size_t i = 0; i < 6; ++i) A[i][j] = column[i] / 1e-4;
    }
    const Twist change = solved(A, between(now, wanted));
    for (std::size_t j = 0; j < 6; ++j) q[j] += change[j];
  }
  return q;
}

/// Joint values that the controller shows, away from stretched and folded postures.
std::vector<Joints> random_joints(std::size_t n, unsigned seed) {
  std::mt19937 bits(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(bits()) / 4294967296.0;
  };
  std::vector<Joints> out;
  while (out.size() < n) {
    Joints q{uniform(-120, 120), uniform(-130, -20), 0,
             uniform(-120, 120), uniform(20, 100),   uniform(-120, 120)};
    q[2] = q[1] + uniform(-20, 70);
    const Matrix R = forward(kNominal, q).R;
    if (R[0][0] + R[1][1] + R[2][2] > -0.9) out.push_back(q);
  }
  return out;
}

std::string number(double value) {
  char out[40];
  std::snprintf(out, sizeof out, ",%.12g", value);
  return out;
}

/// One row of a table.
template <class... Lists>
std::string row_of(const Lists&... lists) {
  std::string out;
  const auto add = [&](const auto& list) {
    for (const double value : list) out += number(value);
  };
  (add(lists), ...);
  return out.substr(1) + "\n";
}

class CoupledArm : public testing::Test {
 protected:
  static constexpr Point kTarget_mm{60, 40, 130};

  void SetUp() override {
    ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
    std::string cell = box.read("cell/cell.toml");
    const auto put = [&](const std::string& old, const std::string& now) {
      ASSERT_NE(cell.find(old), std::string::npos) << old;
      cell.replace(cell.find(old), old.size(), now);
    };
    put("gravity = [", "coupling = [{ joint = \"J3\", of = \"J2\", share = 1 }]\ngravity = [");
    put("q = [-120, 156]", "q = [-310, 200]");
    put("frame = \"fit\"", "frame = { xyz = [0, 0, 0], rpy = [0, 0, 0] }");
    put("target = \"fit\"", "target = [60, 40, 30]");
    put("sigma_um = 10 ", "sigma_um = 0.1 ");
    box.write("cell/cell.toml", cell);
    std::string readings = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n";
    for (const Joints& q : random_joints(120, 3)) {
      readings += row_of(q, seen_at(forward(true_arm(), q), kTarget_mm));
    }
    box.write("cell/measurements.csv", readings);
    const Ran compiled = box.plumb({"-C", "cell", "compile", "-o", "m.plumb"});
    ASSERT_EQ(compiled.exit, 0) << compiled.err;
  }

  Sandbox box;
};

TEST_F(CoupledArm, IsPredictedWhereItIs) {
  const auto poses = random_joints(20, 4);
  std::string rows = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n";
  for (const Joints& q : poses) rows += row_of(q);
  box.write("poses.csv", rows);
  const Ran ran = box.plumb({"predict", "m.plumb", "--data", "poses.csv", "-o", "out.csv"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Csv csv = box.csv("out.csv");
  ASSERT_EQ(csv.rows(), poses.size());
  const auto x = csv.numbers("px_mm"), y = csv.numbers("py_mm"), z = csv.numbers("pz_mm");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Point p = seen_at(forward(true_arm(), poses[i]), {0, 0, kTool_mm});
    EXPECT_LT(std::hypot(x[i] - p[0], y[i] - p[1], z[i] - p[2]), kMicrometre_mm) << i;
  }
}

TEST_F(CoupledArm, LosesItsCouplingInAUrdfWhichIsSaid) {
  const Ran ran = box.plumb({"-C", "cell", "export", "-o", "arm.urdf", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.out.find("coupling of J3 with J2"), std::string::npos) << ran.out;
}

TEST_F(CoupledArm, ReachesItsTargetsWithTheCommandsOfCorrect) {
  const auto poses = random_joints(20, 5);
  std::string rows = "x_mm,y_mm,z_mm,qw,qx,qy,qz,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n";
  std::vector<Point> targets;
  for (const Joints& q : poses) {
    const Pose flange = forward(kNominal, q);
    targets.push_back(seen_at(flange, {0, 0, kTool_mm}));
    rows += row_of(targets.back(), quaternion(flange.R), q);
  }
  box.write("targets.csv", rows);
  const Ran ran = box.plumb({"correct", "m.plumb", "--data", "targets.csv", "-o", "out.csv"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Csv csv = box.csv("out.csv");
  ASSERT_EQ(csv.rows(), poses.size());
  int corrected = 0;
  const auto column = [&](const char* name) { return csv.numbers(name); };
  const auto x = column("cx_mm"), y = column("cy_mm"), z = column("cz_mm"), qw = column("cqw"),
             qx = column("cqx"), qy = column("cqy"), qz = column("cqz");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (csv.columns.at("status")[i] != "ok") continue;  // outside of what was measured
    ++corrected;
    Pose sent{.R = rotation({qw[i], qx[i], qy[i], qz[i]}), .p = {x[i], y[i], z[i]}};
    sent.p = seen_at(sent, {0, 0, -kTool_mm});
    const Joints q = commanded(sent, poses[i]);
    const Point p = seen_at(forward(true_arm(), q), {0, 0, kTool_mm}), &t = targets[i];
    EXPECT_LT(std::hypot(p[0] - t[0], p[1] - t[1], p[2] - t[2]), kMicrometre_mm) << i;
    const Point nominal = seen_at(forward(true_arm(), poses[i]), {0, 0, kTool_mm});
    EXPECT_GT(std::hypot(nominal[0] - t[0], nominal[1] - t[1], nominal[2] - t[2]), 0.1) << i;
  }
  EXPECT_GE(corrected, 12);
}

}  // namespace
