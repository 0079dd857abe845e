// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::tests {

/// What a controller puts into its registers, made of the map of registers alone: numbers and check
/// sums are its own. Its arm swings, and is the nominal one.
class RawArm {
 public:
  using Bytes = std::vector<std::uint8_t>;
  using Kind = drivers::MessageKind;

  RawArm(const format::Chain& arm, std::uint32_t robot) : arm_(arm), robot_(robot) {}

  struct Buttons {
    bool acknowledge = false;
    bool another_tool = false;  // the pose shown is not the nominal arm's
  };

  /// The blocks of one cycle: first register, and the registers as bytes.
  std::vector<std::pair<std::uint16_t, Bytes>> beat(const Buttons& buttons) {
    const Transformd X_BA = arm_.forward(q_);
    const Vector3 r = rotation_vector(X_BA.R);
    const std::vector<double> pose{X_BA.p(0), X_BA.p(1), X_BA.p(2), r(0), r(1), r(2)};
    std::vector<double> shown = pose;
    shown[2] += buttons.another_tool ? 0.02 : 0.0;
    const unsigned flags = 1 + 2 + 8 + (buttons.acknowledge ? 16 : 0);
    ++counter_;
    targets_[counter_] = X_BA.p;
    std::vector<std::pair<std::uint16_t, Bytes>> out;
    const auto add = [&](Kind kind, const std::vector<double>& values) {
      const auto& message = *layout.find(kind);
      out.emplace_back(message.first_register, block(message, values, counter_));
    };
    add(Kind::kController, {static_cast<double>(flags), 0, 0, 0});
    add(Kind::kRobot, {static_cast<double>(robot_)});
    add(Kind::kJoints, q_);
    add(Kind::kActual, shown);
    add(Kind::kTarget, pose);
    phase_ += 0.005;
    for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = rest_[i] + 0.3 * std::sin(phase_);
    return out;
  }

  /// The target that was sent under this counter [m]; null: none was.
  const Vector3* target(std::uint16_t counter) const {
    const auto found = targets_.find(counter);
    return found == targets_.end() ? nullptr : &found->second;
  }

  Bytes block(const drivers::MessageLayout& message, const std::vector<double>& values,
              std::uint16_t counter) const {
    Bytes out;
    for (std::size_t i = 0; i < values.size(); ++i)
      put_pair(out, static_cast<std::uint32_t>(static_cast<std::int32_t>(
                        std::lround(values[i] / message.signals[i].scale))));
    put(out, counter);
    Bytes sum{static_cast<std::uint8_t>(message.first_register),
              static_cast<std::uint8_t>(message.first_register >> 8), 0, 0};
    sum.insert(sum.end(), out.begin(), out.end());
    put_pair(out, crc(sum));
    return out;
  }

  static void put(Bytes& out, std::uint32_t word) {
    out.push_back(static_cast<std::uint8_t>(word >> 8));
    out.push_back(static_cast<std::uint8_t>(word));
  }

  drivers::BusLayout layout = drivers::default_layout(6, 0.004);

 private:
  /// CRC-32P4 of AUTOSAR: polynomial F4ACFB13, reflected.
  static std::uint32_t crc(const Bytes& bytes) {
    std::uint32_t out = 0xFFFFFFFF;
    for (const std::uint8_t byte : bytes) {
      out ^= byte;
      for (int i = 0; i < 8; ++i) out = (out >> 1) ^ ((out & 1) != 0 ? 0xC8DF352F : 0);
    }
    return ~out;
  }

  void put_pair(Bytes& out, std::uint32_t value) const {
    const bool big = layout.word_order == drivers::ByteOrder::kBig;
    put(out, (big ? value >> 16 : value) & 0xFFFF);
    put(out, (big ? value : value >> 16) & 0xFFFF);
  }

  Chain arm_;
  std::uint32_t robot_;
  std::uint16_t counter_ = 0;
  std::map<std::uint16_t, Vector3> targets_;
  double phase_ = 0.0;
  std::vector<double> rest_{0.3, -1.0, 1.2, -0.4, 1.1, 0.2};
  std::vector<double> q_ = rest_;
};

}  // namespace plumb::tests
