// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/single_poses.hpp"

#include <algorithm>

namespace plumb {
namespace {

double turn_of(const Transformd& X_BD, const Transformd& X_BC) noexcept {
  return rotation_vector(X_BC.R * X_BD.R.transpose()).norm();
}

/// Whether the context (payload, wrench, temperatures) may be the cause, rather than target and
/// seed: for an arm under an impossible load the solver finds no solution.
bool may_be_of_context(Status refusal) noexcept {
  return refusal == Status::kNotConverged || refusal == Status::kNotFinite ||
         refusal == Status::kFarFromSeed || refusal == Status::kOtherConfiguration;
}

bool finite(std::span<const double> numbers) noexcept {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return x - x == 0.0; });
}

bool same(const Transformd& A, const Transformd& B) noexcept { return A.R == B.R && A.p == B.p; }

}  // namespace

bool beyond_guard(const Transformd& X_BD, const Transformd& X_BC,
                  const format::GuardLimits& limits) noexcept {
  if ((X_BC.p - X_BD.p).norm() > limits.max_correction_m) return true;
  return limits.corrects == format::Corrects::kPose &&
         turn_of(X_BD, X_BC) > limits.max_rotation_rad;
}

Correction guarded(const Correction& correction, const Transformd& X_BD,
                   const format::GuardLimits& limits) noexcept {
  Correction out = correction;
  if (refused(correction.status) || !beyond_guard(X_BD, correction.X_BC, limits)) return out;
  const Vector3 shift = correction.X_BC.p - X_BD.p;
  const double far = shift.norm();
  if (far > limits.max_correction_m) out.X_BC.p = X_BD.p + shift * (limits.max_correction_m / far);
  if (limits.corrects == format::Corrects::kPose) {
    const Vector3 e = rotation_vector(correction.X_BC.R * X_BD.R.transpose());
    const double angle = e.norm();
    if (angle > limits.max_rotation_rad)
      out.X_BC.R = rotation_of(e * (limits.max_rotation_rad / angle)) * X_BD.R;
  }
  out.status = Status::kLimited;
  return out;
}

SinglePoses::SinglePoses(const format::Model& model) noexcept : corrector_(model), known_(model) {
  const auto& box = model.domain;
  const std::size_t joints = std::min({middle_.size(), box.q_min.size(), box.q_max.size()});
  for (std::size_t i = 0; i < joints; ++i) middle_[i] = 0.5 * (box.q_min[i] + box.q_max[i]);
}

Prediction SinglePoses::predict(std::span<const double> q, const Context& context) const noexcept {
  Prediction out = corrector_.forward_model().predict(q, context);
  if (refused(out.status)) return out;
  if (known_.look(q, context).outside)
    out.status = Status::kOutsideDomain;
  else if ((out.status == Status::kOk || out.status == Status::kContextFallback) &&
           beyond_guard(corrector_.nominal().forward(q), out.X_BT, corrector_.limits()))
    out.status = Status::kLimited;
  return out;
}

Correction SinglePoses::correct(const Transformd& X_BD, std::span<const double> seed, SeedKind kind,
                                const Context& context) const noexcept {
  Correction out = guarded(corrector_.solve(X_BD, seed, kind, context), X_BD, corrector_.limits());
  if (refused(out.status)) {
    const bool sound = same(out.X_BC, X_BD) && finite(seed);
    if (sound && may_be_of_context(out.status) && faded_everywhere(context))
      out.status = Status::kOutsideDomain;
  } else if (known_.look(std::span(out.q).first(seed.size()), context).outside) {
    out.status = Status::kOutsideDomain;
  }
  return out;
}

bool SinglePoses::faded_everywhere(const Context& context) const noexcept {
  const auto joints = static_cast<std::size_t>(corrector_.nominal().joints());
  return !(known_.look(std::span(middle_).first(joints), context).weight > 0.0);
}

}  // namespace plumb
