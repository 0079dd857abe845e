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

  /// How the controller packs its registers otherwise than the map of registers says.
  struct Packing {
    bool words = false;       // the two registers of every number are swapped
    bool bytes = false;       // the two bytes of every register are swapped
    int shift = 0;            // registers by which everything stands too far on
    bool sum_before = false;  // the check sum is formed before that
  };

  RawArm(const format::Chain& arm, std::uint32_t robot) : RawArm(arm, robot, {}) {}
  RawArm(const format::Chain& arm, std::uint32_t robot, Packing packing)
      : arm_(arm), coupling_(arm.coupling), robot_(robot), packing_(packing) {}

  struct Buttons {
    bool acknowledge = false;
    bool another_tool = false;  // the pose shown is not the nominal arm's
  };

  /// The blocks of one cycle: first register, and the registers as bytes.
  std::vector<std::pair<std::uint16_t, Bytes>> beat(const Buttons& buttons) {
    const Transformd X_BA = arm_.forward(angles());
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
      out.emplace_back(static_cast<std::uint16_t>(message.first_register + packing_.shift),
                       block(message, values, counter_));
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
    const Bytes content = packing_.sum_before ? out : packed(out);
    const int address = message.first_register + (packing_.sum_before ? 0 : packing_.shift);
    Bytes sum{static_cast<std::uint8_t>(address), static_cast<std::uint8_t>(address >> 8), 0, 0};
    sum.insert(sum.end(), content.begin(), content.end());
    Bytes end;
    put_pair(end, crc(sum));
    Bytes all = packed(out);
    const Bytes packed_end = packed(end);
    all.insert(all.end(), packed_end.begin(), packed_end.end());
    return all;
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

  /// Numbers of four bytes, and a counter of two behind them if there is one.
  Bytes packed(Bytes bytes) const {
    for (std::size_t i = 0; packing_.words && i + 3 < bytes.size(); i += 4) {
      std::swap(bytes[i], bytes[i + 2]);
      std::swap(bytes[i + 1], bytes[i + 3]);
    }
    for (std::size_t i = 0; packing_.bytes && i + 1 < bytes.size(); i += 2)
      std::swap(bytes[i], bytes[i + 1]);
    return bytes;
  }

  /// Of the links; what the controller shows as values is q_.
  std::vector<double> angles() const {
    std::vector<double> out = q_;
    for (const format::JointCoupling& one : coupling_) out[one.joint] += one.ratio * q_[one.by];
    return out;
  }

  Chain arm_;
  std::vector<format::JointCoupling> coupling_;
  std::uint32_t robot_;
  Packing packing_;
  std::uint16_t counter_ = 0;
  std::map<std::uint16_t, Vector3> targets_;
  double phase_ = 0.0;
  std::vector<double> rest_{0.3, -1.0, 1.2, -0.4, 1.1, 0.2};
  std::vector<double> q_ = rest_;
};

}  // namespace plumb::tests
