// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"
#include "plumb/runtime/detail/formula_code.hpp"

namespace plumb::effects {

/// A law of the user's own: its target moves by the value of an expression, which runs as stack
/// code. If the value is not finite (a division by zero, the logarithm of a negative number) or
/// larger than any error of an arm (kMaxFormulaMotion), nothing is moved and Motion::undefined is
/// set.
struct Formula {
  static constexpr EffectInfo kInfo{.name = "formula",
                                    .version = 1,
                                    .title = "own formula",
                                    .domain = EffectDomain::kRobot,  // unless it says otherwise
                                    .needs = 0,
                                    .per_joint = false,
                                    .repeats = true,
                                    .parameters = {}};
  static int count(const EffectShape& shape) {
    return shape.formula == nullptr ? 0 : static_cast<int>(shape.formula->parameters.size());
  }

  /// The input that an instruction reads; NaN if it is unknown.
  static double read(format::FormulaOp op, std::size_t which, const EffectShape& shape,
                     const Situation& at) noexcept {
    using format::FormulaOp;
    switch (op) {
      case FormulaOp::kPosition:
        return at.q[which];
      case FormulaOp::kTorque:
        return at.torque(static_cast<int>(which));
      case FormulaOp::kDirection:
        return at.direction(which);
      case FormulaOp::kTravel:
        return at.travel(which);
      case FormulaOp::kTime:
        return at.time_s();
      case FormulaOp::kTemperature:
        return at.temperature_degC(shape, which);
      case FormulaOp::kPayload:
        return at.payload_kg();
      case FormulaOp::kTip:
        return at.frames.tip.p(static_cast<Eigen::Index>(which));
      default:  // kMove and kRow, which are known only of measured poses
        return kUnknown;
    }
  }

  /// The frame before a joint's motion, found by undoing the motion in the frame after it.
  static Transformd ahead(const Situation& at, int j) noexcept {
    Transformd out = at.frames.joint[j];
    const double moved = at.q[j] * at.chain.scale(j);
    if (!at.chain.revolute(j)) {
      out.p -= out.R.col(2) * moved;
      return out;
    }
    const auto t = portable::sin_cos(moved);
    const Vector3 x = out.R.col(0), y = out.R.col(1);
    out.R.col(0) = x * t.cos - y * t.sin;
    out.R.col(1) = x * t.sin + y * t.cos;
    return out;
  }

  static Transformd frame(const format::Formula& f, const Situation& at) noexcept {
    using format::FormulaTarget;
    switch (f.target) {
      case FormulaTarget::kPre:
        return ahead(at, f.joint);
      case FormulaTarget::kPost:
        return at.frames.joint[f.joint];
      case FormulaTarget::kTool:
        return at.frames.tip;
      case FormulaTarget::kTip:
        return {Matrix3::Identity(), at.frames.tip.p};
      default:
        return Transformd{};
    }
  }

  template <class S>
  static void apply(std::span<const S> theta, const EffectShape& shape, const Situation& at,
                    Motion<S>& out) {
    apply(theta, shape, at, out,
          [&](format::FormulaOp op, std::size_t which) { return read(op, which, shape, at); });
  }

  /// The same with inputs that reader(op, operand) returns.
  template <class S, class Reader>
  static void apply(std::span<const S> theta, const EffectShape& shape, const Situation& at,
                    Motion<S>& out, const Reader& reader) {
    using formula::is_number;
    using plumb::plain;
    if (shape.formula == nullptr) return;
    const format::Formula& f = *shape.formula;
    const S motion = formula::evaluate(f, theta, reader);
    const double size = plain(motion) < 0.0 ? -plain(motion) : plain(motion);
    if (!is_number(motion) || size > format::kMaxFormulaMotion) {
      out.undefined = true;
      return;
    }
    if (f.target == format::FormulaTarget::kJoint) {
      out.dq[f.joint] += motion;
      return;
    }
    Vec3<S> twist[2] = {{S(0.0), S(0.0), S(0.0)}, {S(0.0), S(0.0), S(0.0)}};
    twist[f.component / 3](f.component % 3) = motion;
    out.twist(frame(f, at), at.frames.tip.p, twist[0], twist[1]);
  }
};

}  // namespace plumb::effects
