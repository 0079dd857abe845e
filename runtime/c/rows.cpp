// SPDX-License-Identifier: Apache-2.0
// Lists of poses, outside of the cycle: nothing here allocates, locks or throws.
#include <limits>

#include "check.hpp"
#include "plumb/runtime/coupling.hpp"
#include "plumb/runtime/single_poses.hpp"
#include "pose.hpp"

namespace {

using namespace plumb;

double magnitude(double x) noexcept { return x < 0.0 ? -x : x; }

/// Number i of an array that may be missing; what is larger than any quantity is unknown, too.
double number(const double* from, std::size_t i, double most) noexcept {
  if (from == nullptr) return kUnknown;
  return magnitude(from[i]) <= most ? from[i] : kUnknown;
}

template <std::size_t N>
void read(const double* from, std::size_t row, std::size_t width, double most,
          std::array<double, N>& out) noexcept {
  for (std::size_t k = 0; k < width; ++k) out[k] = number(from, row * width + k, most);
}

/// One robot that answers row after row.
class Rows {
 public:
  Rows(const plumb_robot& robot, const plumb_rows& rows) noexcept
      : rows_(rows),
        joints_(static_cast<std::size_t>(robot.joints)),
        sensors_(static_cast<std::size_t>(robot.sensor_count)),
        coupling_(robot.robot->model().nominal.coupling),
        poses_(robot.robot->model()) {}

  void predict(plumb_pose* X_BT, std::int32_t* status) const noexcept {
    for (std::size_t row = 0; row < count(); ++row) {
      const Angles q = angles(row);
      const Prediction arm = poses_.predict(std::span(q).first(joints_), context(row));
      X_BT[row] = c::pose_of(refused(arm.status) ? Transformd{} : arm.X_BT);
      status[row] = static_cast<std::int32_t>(arm.status);
    }
  }

  void correct(const plumb_pose* X_BD, plumb_pose* X_BC, double* q,
               std::int32_t* status) const noexcept {
    const auto kind = rows_.seed == PLUMB_COMMANDED ? SeedKind::kCommanded : SeedKind::kMeasured;
    for (std::size_t row = 0; row < count(); ++row) {
      const Angles seed = angles(row);
      Correction found = poses_.correct(c::transform_of(X_BD[row]), std::span(seed).first(joints_),
                                        kind, context(row));
      X_BC[row] = c::pose_of(found.X_BC);
      status[row] = static_cast<std::int32_t>(found.status);
      if (q == nullptr) continue;
      coupling_.to_values(found.q);
      std::copy_n(refused(found.status) ? rows_.q + row * joints_ : found.q.data(), joints_,
                  q + row * joints_);
    }
  }

 private:
  using Angles = std::array<double, kMaxJoints>;
  static constexpr double kMost = ContextInputs::kMaxReading;

  std::size_t count() const noexcept { return static_cast<std::size_t>(rows_.count); }

  Angles angles(std::size_t row) const noexcept {
    Angles out{};
    std::copy_n(rows_.q + row * joints_, joints_, out.begin());
    coupling_.to_angles(out);
    return out;
  }

  Context context(std::size_t row) const noexcept {
    Context out;
    out.payload_kg = number(rows_.payload_kg, row, kMost);
    if (rows_.payload_kg != nullptr) read(rows_.payload_com_m, row, 3, kMost, out.payload_com_m);
    read(rows_.temperature_degC, row, sensors_, kMost, out.temperature_degC);
    out.time_s = number(rows_.time_s, row, kMost);
    read(rows_.direction, row, joints_, 1.0, out.direction);
    read(rows_.travel, row, joints_, kMost, out.travel);
    return out;
  }

  const plumb_rows& rows_;
  std::size_t joints_, sensors_;
  Coupling coupling_;
  SinglePoses poses_;
};

/// What every call of the rows asks for: `poses` and `status` are written, `q` is read.
plumb_result check(const plumb_robot* robot, const plumb_rows* rows, const plumb_pose* poses,
                   const std::int32_t* status) noexcept {
  plumb_result found = c::first_of(c::check_robot(robot), c::check_struct(rows));
  if (found != PLUMB_OK || rows->count == 0) return found;
  found = c::first_of(c::check_pointer(poses), c::check_pointer(status));
  found = c::first_of(found, c::check_pointer(rows->q));
  for (const double* numbers : {rows->payload_kg, rows->payload_com_m, rows->temperature_degC,
                                rows->time_s, rows->direction, rows->travel})
    if (numbers != nullptr) found = c::first_of(found, c::check_pointer(numbers));
  return found;
}

}  // namespace

extern "C" {

plumb_result plumb_predict_rows(const plumb_robot* robot, const plumb_rows* rows, plumb_pose* X_BT,
                                std::int32_t* status) {
  const plumb_result found = check(robot, rows, X_BT, status);
  if (found != PLUMB_OK) return found;
  const plumb_rows in = plumb::c::copy_in(rows);
  Rows(*robot, in).predict(X_BT, status);
  return PLUMB_OK;
}

plumb_result plumb_correct_rows(const plumb_robot* robot, const plumb_rows* rows,
                                const plumb_pose* X_BD, plumb_pose* X_BC, double* q,
                                std::int32_t* status) {
  const plumb_result found = check(robot, rows, X_BC, status);
  if (found != PLUMB_OK) return found;
  const plumb_rows in = plumb::c::copy_in(rows);
  if (in.seed != PLUMB_MEASURED && in.seed != PLUMB_COMMANDED) return PLUMB_BAD_NUMBER;
  if (in.count == 0) return PLUMB_OK;
  plumb_result arrays = plumb::c::check_pointer(X_BD);
  if (q != nullptr) arrays = plumb::c::first_of(arrays, plumb::c::check_pointer(q));
  if (arrays == PLUMB_OK) Rows(*robot, in).correct(X_BD, X_BC, q, status);
  return arrays;
}

}  // extern "C"
