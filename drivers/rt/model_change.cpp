// SPDX-License-Identifier: Apache-2.0
#include "rt/model_change.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace plumb::drivers::rt {
namespace {

class ComparedPoses {
 public:
  explicit ComparedPoses(const format::Model& model) : model_(model) {}

  /// Joint positions of pose number i: within the trained range if i is odd.
  std::vector<double> joints(int i) {
    std::vector<double> out;
    for (std::size_t j = 0; j < model_.nominal.joints.size(); ++j) {
      const auto& row = model_.nominal.joints[j];
      const bool trained = i % 2 == 1 && j < model_.domain.q_min.size();
      double low = trained ? model_.domain.q_min[j] : row.q_min;
      double high = trained ? model_.domain.q_max[j] : row.q_max;
      if (row.type == format::JointType::kRevolute) {
        low = std::max(low, -std::numbers::pi);
        high = std::min(high, std::numbers::pi);
      }
      out.push_back(low + (high - low) * unit());
    }
    return out;
  }

  /// What is known at pose number i: nothing, or all of it at random.
  Context context(int i) {
    Context out;
    if (i % 4 < 2) return out;
    for (auto& one : out.direction) one = unit() < 0.5 ? -1.0 : 1.0;
    for (auto& one : out.travel) one = unit();
    out.payload_kg = 20.0 * unit();
    for (auto& one : out.payload_com_m) one = 0.1 * unit();
    for (auto& one : out.temperature_degC) one = 15.0 + 20.0 * unit();
    return out;
  }

 private:
  /// The standard fixes the numbers of the engine, but not those of its distributions.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  const format::Model& model_;
  std::mt19937_64 engine_{1};
};

struct Moved {
  Vector3 translation, rotation;
};

Vector3 cut(const Vector3& value, double most) {
  const double length = value.norm();
  return length > most ? Vector3(value * (most / length)) : value;
}

Moved moved_by(const Transformd& X_BD, const Transformd& X_BC, const format::GuardLimits& limits) {
  return {cut(X_BC.p - X_BD.p, limits.max_correction_m),
          cut(rotation_vector(times_transposed<double>(X_BC.R, X_BD.R)), limits.max_rotation_rad)};
}

}  // namespace

ModelChange find_change(const LoadedModel& running, const LoadedModel& next) {
  ModelChange out;
  ComparedPoses poses(next.model());
  const Chain nominal(next.model().nominal);
  const bool turns = running.limits().corrects == format::Corrects::kPose ||
                     next.limits().corrects == format::Corrects::kPose;
  for (int i = 0; i < kComparedPoses; ++i) {
    const auto q = poses.joints(i);
    const Context context = poses.context(i);
    const Transformd X_BD = nominal.forward(q);
    const auto solved = [&](const LoadedModel& model) {
      return model.corrector().solve(X_BD, q, SeedKind::kCommanded, context);
    };
    const Correction before = solved(running), after = solved(next);
    if (refused(before.status) || refused(after.status)) continue;
    ++out.compared;
    const Moved a = moved_by(X_BD, before.X_BC, running.limits());
    const Moved b = moved_by(X_BD, after.X_BC, next.limits());
    const double moved = (b.translation - a.translation).norm();
    if (moved > out.position_m) {
      out.position_m = moved;
      out.q = q;
      next.coupling().to_values(out.q);
    }
    if (turns) out.rotation_rad = std::max(out.rotation_rad, (b.rotation - a.rotation).norm());
  }
  return out;
}

}  // namespace plumb::drivers::rt
