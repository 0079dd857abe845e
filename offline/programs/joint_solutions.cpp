// SPDX-License-Identifier: Apache-2.0
#include "programs/joint_solutions.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "plumb/runtime/coupling.hpp"

namespace plumb::offline::programs {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kStarts = 120;       // finds all eight solutions of usual arms, see the tests
constexpr int kSteps = 40;         // of Newton's method
constexpr double kStep_rad = 0.5;  // the longest
constexpr double kSame_rad = 1e-5;
constexpr double kReached = 1e-10;    // [m] and [rad]
constexpr double kBeyond_rad = 1e-6;  // a solution on a joint limit is within it
constexpr double kClearly = 0.7;      // the nearest solution is taken if it is this much nearer,
// and no farther than a third of the half turn by which the other one of a wrist differs.
constexpr double kNear_rad = 60.0 * kDegree;

Vector3 vector_of(const std::array<double, 4>& v) { return {v[0], v[1], v[2]}; }

/// The point of the second axis that is nearest to the first.
Vector3 crossing(const ChainAxes::Axis& first, const ChainAxes::Axis& second) {
  const Vector3 a = vector_of(first.along), b = vector_of(second.along);
  const Vector3 between = vector_of(second.through) - vector_of(first.through);
  const double ab = a.dot(b), under = 1.0 - ab * ab;
  if (under < 1e-9) return vector_of(second.through);
  return vector_of(second.through) + b * ((ab * a.dot(between) - b.dot(between)) / under);
}

}  // namespace

double distance(const Joints& a, const Joints& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, std::abs(a[i] - b[i]));
  return out;
}

JointSolutions::JointSolutions(const format::Chain& arm) : arm_(&arm), chain_(arm) {}

bool JointSolutions::turns(std::size_t i) const {
  return arm_->joints[i].type == format::JointType::kRevolute;
}

Joints JointSolutions::of_controller(std::span<const double> values) const {
  if (values.size() != arm_->joints.size()) return {};
  Joints out;
  for (std::size_t i = 0; i < values.size(); ++i)
    out.push_back(turns(i) ? values[i] * kDegree : values[i] * 1e-3);
  Coupling(arm_->coupling).to_angles(out);
  return out;
}

std::vector<double> JointSolutions::to_controller(Joints q) const {
  Coupling(arm_->coupling).to_values(q);
  for (std::size_t i = 0; i < q.size(); ++i) q[i] *= turns(i) ? 1.0 / kDegree : 1e3;
  return q;
}

bool JointSolutions::converge(const Transformd& X_BT, Joints& q) const {
  const auto n = static_cast<Eigen::Index>(q.size());
  for (int step = 0; step < kSteps; ++step) {
    ChainFrames frames;
    chain_.frames(q, frames);
    Eigen::Matrix<double, 6, 1> error;
    error.head<3>() = X_BT.p - frames.tip.p;
    error.tail<3>() = rotation_vector(times_transposed(X_BT.R, frames.tip.R));
    if (error.norm() < kReached) return true;
    Jacobian J;
    jacobian(chain_, frames, J);
    const Eigen::MatrixXd A = J.leftCols(n);
    const double damping = 1e-4 * std::min(1.0, error.squaredNorm());
    const Eigen::MatrixXd H = A.transpose() * A + damping * Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd dq = H.ldlt().solve(A.transpose() * error);
    const double longest = dq.cwiseAbs().maxCoeff();
    if (!std::isfinite(longest)) return false;
    if (longest > kStep_rad) dq *= kStep_rad / longest;
    for (Eigen::Index i = 0; i < n; ++i) q[static_cast<std::size_t>(i)] += dq(i);
  }
  return false;
}

/// Leaves whole turns out.
void JointSolutions::unwind(Joints& q) const {
  for (std::size_t i = 0; i < q.size(); ++i)
    if (turns(i)) q[i] -= kTurn * std::round(q[i] / kTurn);
}

std::vector<Joints> JointSolutions::all(const Transformd& X_BT, const Joints& last) const {
  std::vector<Joints> found;
  const std::size_t n = arm_->joints.size();
  const auto look = [&](Joints q) {
    if (!converge(X_BT, q)) return;
    unwind(q);
    const bool known = std::any_of(found.begin(), found.end(), [&](const Joints& other) {
      double far = 0.0;
      for (std::size_t i = 0; i < n; ++i)
        far = std::max(
            far, std::abs(turns(i) ? std::remainder(q[i] - other[i], kTurn) : q[i] - other[i]));
      return far < kSame_rad;
    });
    if (!known) found.push_back(std::move(q));
  };
  if (!last.empty()) look(last);
  std::mt19937_64 random(1);
  for (int start = 0; start < kStarts; ++start) {
    Joints q(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double share = static_cast<double>(random() >> 11) * 0x1p-53;
      const auto& joint = arm_->joints[i];
      q[i] = turns(i) ? (share - 0.5) * kTurn : joint.q_min + share * (joint.q_max - joint.q_min);
    }
    look(std::move(q));
  }
  return found;
}

/// The same solution with all whole turns that the joint limits leave; where `last` says where the
/// joints were before, only the nearest of them.
std::vector<Joints> JointSolutions::turned(const Joints& q, const Joints& last) const {
  std::vector<Joints> out{q};
  for (std::size_t i = 0; i < q.size(); ++i) {
    std::vector<double> ways;
    const auto& joint = arm_->joints[i];
    for (int turn = turns(i) ? -2 : 0; turn <= (turns(i) ? 2 : 0); ++turn) {
      const double way = q[i] + kTurn * turn;
      if (way >= joint.q_min - kBeyond_rad && way <= joint.q_max + kBeyond_rad) ways.push_back(way);
    }
    if (ways.size() > 1 && !last.empty())
      ways = {*std::min_element(ways.begin(), ways.end(), [&](double a, double b) {
        return std::abs(a - last[i]) < std::abs(b - last[i]);
      })};
    std::vector<Joints> more;
    for (const Joints& one : out)
      for (const double way : ways) {
        more.push_back(one);
        more.back()[i] = way;
      }
    out = std::move(more);
    if (out.size() > 1000) out.resize(1000);  // far more than one: which is meant is not known
  }
  return out;
}

/// Seen from the arm as axis 1 turns it, from where it looks along the x axis of its base.
JointSolutions::Posture JointSolutions::posture(const Joints& q) const {
  ChainAxes axes;
  chain_.frames(q, axes);
  const Transformd X_B0 = from_pose(arm_->base);
  const Vector3 up = vector_of(axes.joint[0].along);
  const double sense = up.dot(X_B0.R.col(2)) < 0.0 ? -1.0 : 1.0;
  const double value = to_controller(q)[0] * kDegree * sense;
  const Vector3 forward = rotation_of(X_B0.R.col(2) * value) * Vector3(X_B0.R.col(0));
  const Vector3 left = Vector3(X_B0.R.col(2)).cross(forward);
  const Vector3 wrist = crossing(axes.joint[3], axes.joint[4]);
  const Vector3 O1 = vector_of(axes.joint[0].through), O2 = vector_of(axes.joint[1].through);
  const Vector3 O3 = vector_of(axes.joint[2].through);
  return {.front = forward.dot(wrist - O1) > 0.0,
          .elbow_front = left.dot((O3 - O2).cross(wrist - O2)) > 0.0};
}

bool JointSolutions::agrees(const Configuration& wanted, const Joints& q) const {
  const auto values = to_controller(q);
  for (const auto& range : wanted.ranges) {
    const auto i = static_cast<std::size_t>(range.joint);
    constexpr double kRound_deg = kBeyond_rad / kDegree;
    if (i >= values.size() || values[i] < range.low_deg - kRound_deg ||
        values[i] > range.high_deg + kRound_deg)
      return false;
  }
  if (!wanted.front || q.size() != 6) return true;
  const Posture is = posture(q);
  if (is.front != *wanted.front) return false;
  // What lies before the lower arm is a matter of convention where the wrist is behind axis 1.
  return !is.front || !wanted.elbow_front || is.elbow_front == *wanted.elbow_front;
}

/// The solution next to `last`, if a configuration that no second one can have says that it is the
/// one: wrist and elbow are told, and the turns leave one way. Nearly every target of a program is
/// found so, in a few steps.
std::optional<Joints> JointSolutions::next_to(const Transformd& X_BT, const Configuration& wanted,
                                              const Joints& last) const {
  if (last.size() != 6 || wanted.ranges.size() < 4 || !wanted.elbow_front) return std::nullopt;
  Joints q = last;
  if (!converge(X_BT, q)) return std::nullopt;
  unwind(q);
  std::vector<Joints> left = turned(q, {});
  std::erase_if(left, [&](const Joints& way) { return !agrees(wanted, way); });
  if (left.size() != 1 || !posture(left.front()).front) return std::nullopt;
  return std::move(left.front());
}

JointSolutions::Answer JointSolutions::find(const Transformd& X_BT, const Configuration& wanted,
                                            const Joints& last) const {
  if (arm_->joints.size() > 6)
    return {.q = {},
            .why = "the pose does not say where the joints of an arm with more than six are",
            .help = "correct it with plumb correct, from commanded joints"};
  if (auto next = next_to(X_BT, wanted, last))
    return {.q = *std::move(next), .why = "", .help = ""};
  std::vector<Joints> left;
  bool any = false;
  for (const Joints& q : all(X_BT, last))
    for (Joints& way : turned(q, wanted.ranges.empty() ? last : Joints{})) {
      any = true;
      if (agrees(wanted, way)) left.push_back(std::move(way));
    }
  if (left.empty())
    return {.q = {},
            .why = any ? "no joint positions of the nominal arm have the configuration that is "
                         "stated"
                       : "the nominal arm does not reach it within its joint limits",
            .help =
                "compare its tool, its frame and the joint limits in cell.toml with the "
                "controller"};
  if (left.size() == 1) return {.q = left.front(), .why = "", .help = ""};
  const bool behind =
      arm_->joints.size() == 6 &&
      std::any_of(left.begin(), left.end(), [&](const Joints& q) { return !posture(q).front; });
  if (wanted.elbow_front && behind)
    return {.q = {},
            .why =
                "its wrist is behind axis 1, where the elbow that it states is not read, and "
                "several joint positions reach it",
            .help = "move to joints instead, or turn the arm so that the wrist is in front"};
  const auto far = [&](const Joints& q) { return last.empty() ? 0.0 : distance(q, last); };
  std::sort(left.begin(), left.end(),
            [&](const Joints& a, const Joints& b) { return far(a) < far(b); });
  if (!last.empty() && far(left[0]) < kNear_rad && far(left[0]) < kClearly * far(left[1]))
    return {.q = left.front(), .why = "", .help = ""};
  return {.q = {},
          .why = last.empty() || far(left[0]) < kNear_rad
                     ? "several joint positions reach it, and which is meant is not known"
                     : "several joint positions reach it, and none is near where the arm was",
          .help =
              "move to a target of joints before it, or say where the joints are before the "
              "first move: --start 0,-90,90,0,90,0"};
}

}  // namespace plumb::offline::programs
