// SPDX-License-Identifier: Apache-2.0
#include "arm/predicted_points.hpp"

#include <algorithm>
#include <span>

#include "arm/effect_binding.hpp"
#include "arm/measured_arm.hpp"
#include "numbers/jobs.hpp"
#include "observe/reading.hpp"

namespace plumb::offline {
namespace {

constexpr Eigen::Index kBlock = 512;  // rows that one thread predicts as one job

/// Calls one(row) for every row, on all processors where there are many.
template <class One>
void for_rows(Eigen::Index rows, const One& one) {
  run_jobs(static_cast<int>((rows + kBlock - 1) / kBlock), [&](int block) {
    const Eigen::Index first = block * kBlock, last = std::min(rows, first + kBlock);
    for (Eigen::Index i = first; i < last; ++i) one(i);
  });
}

std::span<const double> row_of(const RowsN& q, Eigen::Index i) {
  return {q.row(i).data(), static_cast<std::size_t>(q.cols())};
}

}  // namespace

MeasuredContext context_of(const Measurements& at, Eigen::Index row,
                           const std::vector<std::string>& sensors, const Transformd& X_MB) {
  MeasuredContext out = context_at(at.context, row, sensors);
  const Transformd X_BM = X_MB.inverse();
  for (int k = 0; k < 3; ++k) {
    out.tracker_B[k] = X_BM.p(k);
    out.tracker_up_B[k] = X_BM.R(k, 2);
  }
  return out;
}

namespace {

/// Frame and reflector of every set-up.
struct SetupPoses {
  std::vector<Transformd> X_MB, X_TG;
  explicit SetupPoses(const ArmState& state) {
    for (int k = 0; k < state.setups(); ++k) {
      X_MB.push_back(from_pose(state.frame(k)));
      X_TG.push_back(from_pose(state.target(k)));
    }
  }
};

}  // namespace

Rows3 predict_points(const ArmState& state, const Measurements& at) {
  const MeasuredArm arm(state.arm);
  const auto sensors = temperature_names(state.arm);
  const SetupPoses placed(state);
  const bool departed = at.departure_B.rows() > 0;
  const bool has_effects = !state.arm.effects.empty();
  Rows3 out(at.q.rows(), 3);
  for_rows(at.q.rows(), [&](Eigen::Index i) {
    const auto setup = static_cast<std::size_t>(setup_of(at, i));
    const Transformd& X_MB = placed.X_MB[setup];
    const Prediction predicted =
        has_effects ? arm.predict(row_of(at.q, i), context_of(at, i, sensors, X_MB))
                    : arm.predict(row_of(at.q, i), {});
    out.row(i) = (X_MB * (predicted.X_BT * placed.X_TG[setup].p)).transpose();
    if (departed) out.row(i) += at.departure_B.row(i) * X_MB.R.transpose();
    if (at.of_artefact(i))
      out.row(i) = read_at(at.kind_of(i), Vector3(out.row(i)), state.length(setup_of(at, i)));
  });
  return out;
}

Rows3 predict_points(const ArmState& state, const RowsN& q) {
  const MeasuredArm arm(state.arm);
  const Transformd X_MB = from_pose(state.X_MB);
  const Vector3 target_T(state.X_TG.p[0], state.X_TG.p[1], state.X_TG.p[2]);
  Rows3 out(q.rows(), 3);
  for_rows(q.rows(), [&](Eigen::Index i) {
    out.row(i) = (X_MB * (arm.predict(row_of(q, i), {}).X_BT * target_T)).transpose();
  });
  return out;
}

Rows3 turns_of_target(const ArmState& state, const Measurements& measured) {
  const MeasuredArm arm(state.arm);
  const auto sensors = temperature_names(state.arm);
  const SetupPoses placed(state);
  Rows3 out(measured.q.rows(), 3);
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    const auto setup = static_cast<std::size_t>(setup_of(measured, i));
    const Transformd& X_MB = placed.X_MB[setup];
    const MeasuredContext context = context_of(measured, i, sensors, X_MB);
    const Matrix3 R_MG =
        X_MB.R * arm.predict(row_of(measured.q, i), context).X_BT.R * placed.X_TG[setup].R;
    const auto quat = measured.quat_M.row(i);
    const Matrix3 read = from_pose({{}, {quat(0), quat(1), quat(2), quat(3)}}).R;
    out.row(i) = rotation_vector(R_MG.transpose() * read).transpose();
  }
  return out;
}

Eigen::VectorXd turn_errors(const ArmState& state, const Measurements& measured) {
  return turns_of_target(state, measured).rowwise().norm();
}

Rows3 residuals(const Measurements& measured, const Rows3& predicted) {
  Rows3 out = measured.p_M - predicted;
  for (int k = 0; k < 3; ++k) {
    if (measured.kind.empty() && !measured.has_axis[k]) out.col(k).setZero();
    for (Eigen::Index i = 0; i < out.rows() && !measured.kind.empty(); ++i)
      if (!measured.reads(i, k)) out(i, k) = 0.0;
  }
  return out;
}

Rows3 predict_targets(const ArmState& state, const Measurements& at) {
  Measurements as_positions = at;
  as_positions.kind.clear();
  return predict_points(state, as_positions);
}

namespace {

std::vector<Transformd> frames_of(const ArmState& state) {
  std::vector<Transformd> out;
  for (int k = 0; k < state.setups(); ++k) out.push_back(from_pose(state.frame(k)));
  return out;
}

}  // namespace

Rows3 places_B(const ArmState& state, const Measurements& at) {
  const std::vector<Transformd> X_MB = frames_of(state);
  Rows3 out = at.kind.empty() ? at.p_M : predict_targets(state, at);
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    if (at.kind_of(i) == ReadingKind::kPosition || at.kind_of(i) == ReadingKind::kPoint)
      out.row(i) = at.p_M.row(i);
    const Transformd& X = X_MB[static_cast<std::size_t>(setup_of(at, i))];
    out.row(i) = (out.row(i) - X.p.transpose()) * X.R;
  }
  return out;
}

Rows3 to_base(const ArmState& state, const Measurements& at, const Rows3& v_M) {
  const std::vector<Transformd> X_MB = frames_of(state);
  const bool radial = std::any_of(at.kind.begin(), at.kind.end(),
                                  [](ReadingKind kind) { return descriptor_of(kind).radial; });
  const Rows3 targets_M = radial ? predict_targets(state, at) : Rows3();
  Rows3 out(v_M.rows(), 3);
  for (Eigen::Index i = 0; i < v_M.rows(); ++i) {
    const Matrix3& R_MB = X_MB[static_cast<std::size_t>(setup_of(at, i))].R;
    out.row(i) = descriptor_of(at.kind_of(i)).radial
                     ? (v_M(i, 0) * targets_M.row(i).normalized() * R_MB).eval()
                     : (v_M.row(i) * R_MB).eval();
  }
  return out;
}

}  // namespace plumb::offline
