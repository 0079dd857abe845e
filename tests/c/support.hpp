// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "plumb.h"
#include "plumb/format/writer.hpp"
#include "plumb/runtime/chain.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb::tests {

using Bytes = std::vector<std::byte>;

inline Bytes file_of(const format::Model& model) {
  const auto written = format::write_model(model);
  return {written.begin(), written.end()};
}

/// An arm that must be told direction, payload, temperature and time.
inline format::Model informed_arm() {
  using format::ContextInput;
  format::Model model = one_arm();
  model.serial = "C-1";
  model.guard.ramp_s = 0.2;
  model.mechanics.payload_kg = 5.0;
  const auto add = [&model](const char* name, std::vector<double> parameters,
                            format::ContextNeed need, std::vector<double> constants) {
    format::Effect& effect = model.effects.emplace_back();
    effect.name = name;
    effect.joints = {1};
    effect.parameters = std::move(parameters);
    effect.context = {std::move(need)};
    effect.constants = std::move(constants);
  };
  add("reversal", {1e-4}, {ContextInput::kDirection, "", 0.0}, {0.005});
  add("payload_compliance", {1e-6}, {ContextInput::kPayload, "", 5.0}, {});
  add("thermal_growth", {1e-5, 0.0, 0.0}, {ContextInput::kTemperature, "temp_arm", 20.0}, {20.0});
  return model;
}

inline const double* home() {
  static const double q[PLUMB_MAX_JOINTS] = {0.1, -1.2, 1.4, 0.3, 1.1, -0.3, 0.0, 0.0, 0.0};
  return q;
}

inline plumb_pose pose_of(const Transformd& X) {
  plumb_pose out{};
  for (int i = 0; i < 3; ++i) {
    out.p_m[i] = X.p(i);
    for (int j = 0; j < 3; ++j) out.R[3 * i + j] = X.R(i, j);
  }
  return out;
}

/// Everything arrived, everything sound.
inline plumb_input sound_input() {
  static const plumb_pose X_BD = pose_of(Chain(one_arm().nominal).forward(std::span(home(), 6)));
  plumb_input in;
  EXPECT_EQ(plumb_input_init(&in), PLUMB_OK);
  in.arrived = PLUMB_TARGET | PLUMB_MEASURED | PLUMB_PAYLOAD | PLUMB_TIME | PLUMB_TEMPERATURE(0);
  in.X_BD = X_BD;
  std::copy_n(home(), PLUMB_MAX_JOINTS, in.q_measured);
  std::copy_n(home(), PLUMB_MAX_JOINTS, in.q_commanded);
  in.payload_kg = {8.0, 0.0};
  in.temperature_degC[0] = {31.0, 0.0};
  in.time_s = {100.0, 0.0};
  return in;
}

/// A loaded robot, unloaded at the end.
class Robot {
 public:
  explicit Robot(const format::Model& model = informed_arm()) {
    const Bytes file = file_of(model);
    char why[200] = "";
    EXPECT_EQ(plumb_load_bytes(file.data(), file.size(), nullptr, &robot_, why, sizeof why),
              PLUMB_OK)
        << why;
  }
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;
  ~Robot() { EXPECT_EQ(plumb_unload(robot_), PLUMB_OK); }

  plumb_robot* get() const { return robot_; }

 private:
  plumb_robot* robot_ = nullptr;
};

constexpr std::int64_t kTick_ns = 4'000'000;
constexpr double kSlew_m = 0.01 * 2.0 * 0.004;  // in one cycle, at most
constexpr double kSize_m = 0.003;

/// What every output of the C interface must be, cycle after cycle.
class Laws {
 public:
  /// target: what the output lies on top of.
  void hold(const plumb_output& out, const plumb_pose& target) {
    finite(out);
    if (out.status >= 0) valid_ = true;
    ASSERT_EQ(out.has_output != 0, valid_);
    double size = 0.0, step = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double added = out.X_BC.p_m[i] - target.p_m[i];
      size += added * added;
      step += (added - added_[i]) * (added - added_[i]);
      added_[i] = added;
    }
    ASSERT_LE(std::sqrt(size), kSize_m + 1e-12);
    ASSERT_LE(std::sqrt(step), kSlew_m * (1.0 + unseen_) + 1e-12);
    unseen_ = 0;
  }

  /// A cycle whose target lies so far away that sums with it lose the correction.
  void look_away() { ++unseen_; }

  static void finite(const plumb_output& out) {
    for (const double p : out.X_BC.p_m) ASSERT_TRUE(std::isfinite(p));
    for (const double r : out.X_BC.R) ASSERT_LE(std::abs(r), 1.0 + 1e-5);
    for (const double q : out.q) ASSERT_TRUE(std::isfinite(q));
    ASSERT_TRUE(std::isfinite(out.residual_m));
    ASSERT_TRUE(std::isfinite(out.residual_rad));
  }

 private:
  double added_[3]{};
  int unseen_ = 0;
  bool valid_ = false;
};

inline plumb_output blank_output() {
  plumb_output out{};
  out.size = sizeof out;
  return out;
}

}  // namespace plumb::tests
