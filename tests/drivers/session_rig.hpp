// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plumb/drivers/session.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb::tests {

using namespace drivers;

constexpr std::uint32_t kRobot = 4711;
constexpr std::int64_t kCycle_ns = 4'000'000;

inline ControllerState ready() {
  return {
      .drives_on = true, .automatic = true, .protective_stop = false, .correction_enabled = true};
}

constexpr std::uint32_t kModel = 99;
inline std::unique_ptr<const LoadedModel> loaded(format::Model model = one_arm()) {
  return LoadedModel::make(std::move(model), kModel);
}

/// A controller, a session and the bus between them, in time that passes as the test says. The arm
/// swings slowly; what the session says is checked against the laws at every cycle.
class SessionRig {
 public:
  explicit SessionRig(SessionSettings settings = {}, format::Model arm = one_arm())
      : model(loaded(std::move(arm))), slot(*model) {
    settings.robot = kRobot;
    session = std::make_unique<Session>(slot, settings);
  }

  /// The messages of this cycle, in the order of a controller.
  std::vector<BusMessage> controller_says() {
    const auto& nominal = model->corrector().nominal();
    std::vector<BusMessage> out;
    const auto add = [&](BusMessage message) {
      message.time_ns = now_ns;
      out.push_back(message);
    };
    add(controller_message(state, counter));
    add(robot_message(robot, counter));
    add(joints_message(MessageKind::kJoints, q, counter));
    Transformd X_BA = nominal.forward(q);
    X_BA.p += pose_error;
    add(pose_message(MessageKind::kActual, X_BA, counter));
    Transformd X_BD = nominal.forward(q);
    X_BD.p += jump;
    targets[counter] = X_BD;
    add(pose_message(MessageKind::kTarget, X_BD, counter));
    return out;
  }

  void swing() {
    if (!swings) return;
    phase += pace;
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = rest[i] + 0.3 * std::sin(phase);
  }

  /// One cycle with everything the controller says.
  SessionOutput cycle() { return cycle(controller_says()); }

  /// One cycle in which only these messages arrive.
  SessionOutput cycle(std::span<const BusMessage> messages) {
    for (const auto& message : messages) session->hear(message);
    tick.now_ns = now_ns;
    const SessionOutput out = session->step(tick);
    ++cycles_;
    check(out);
    now_ns += kCycle_ns;
    ++counter;
    swing();
    return out;
  }

  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) cycle();
  }

  /// Until the session is there; false: it does not come.
  bool run_to(SessionState to, int most = 2000) {
    for (int i = 0; i < most && session->state() != to; ++i) cycle();
    return session->state() == to;
  }

  /// The correction that an answer of this cycle put on its target [m].
  static std::optional<BusMessage> answer_in(const SessionOutput& out) {
    for (const auto& message : out.sent())
      if (message.kind == MessageKind::kCorrected || message.kind == MessageKind::kOffset)
        return message;
    return std::nullopt;
  }

  std::unique_ptr<const LoadedModel> model;
  ModelSlot slot;
  std::unique_ptr<Session> session;
  SessionTick tick;
  ControllerState state = ready();
  std::uint32_t robot = kRobot;
  std::vector<double> rest{0.3, -1.0, 1.2, -0.4, 1.1, 0.2};
  std::vector<double> q = rest;
  double phase = 0.0;
  double pace = 0.002;  // of the phase [rad] a cycle
  bool swings = true;
  Vector3 pose_error = Vector3::Zero();
  Vector3 jump = Vector3::Zero();
  std::int64_t now_ns = 1'000'000'000;
  std::uint16_t counter = 0;
  std::vector<Transformd> targets = std::vector<Transformd>(65536);  // by counter
  Vector3 last_correction = Vector3::Zero();
  long answers = 0;
  double largest_step_m = 0.0;  // of the correction, from cycle to cycle

 private:
  long cycles_ = 0;
  long last_answer_ = 0;
  std::int64_t last_answer_ns_ = 0;

  /// Laws of every cycle: the correction never steps, and what is sent answers a target heard.
  void check(const SessionOutput& out) {
    const auto answer = answer_in(out);
    if (!answer) return;
    ++answers;
    const auto X_BC = answer->kind == MessageKind::kCorrected
                          ? pose_in(*answer)
                          : std::optional(add_offset(targets[answer->counter], *answer));
    ASSERT_TRUE(X_BC.has_value());
    const Vector3 correction = X_BC->p - targets[answer->counter].p;
    const double step = (correction - last_correction).norm();
    // A session that was silent for a while has moved on at its slew limit meanwhile.
    const bool stalled = answers > 1 && now_ns - last_answer_ns_ > 100'000'000;
    const long cycles = answers == 1 ? 1
                        : stalled    ? (now_ns - last_answer_ns_) / kCycle_ns
                                     : cycles_ - last_answer_;
    const double most =
        model->limits().slew_m_per_s * 2.0 * model->limits().cycle_s * static_cast<double>(cycles);
    largest_step_m = std::max(largest_step_m, step / static_cast<double>(cycles));
    EXPECT_LE(step, most + 1e-9);
    EXPECT_LE(correction.norm(), model->limits().max_correction_m + 1e-9);
    last_correction = correction;
    last_answer_ = cycles_;
    last_answer_ns_ = now_ns;
  }
};

}  // namespace plumb::tests
