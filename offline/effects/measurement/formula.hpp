// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/measured_context.hpp"
#include "plumb/runtime/detail/effects/formula.hpp"

namespace plumb::effects {

/// The user's own formula at a measured pose, where it may also read the joints' last moves (u1,
/// u2, …) and the row. All other inputs are those of the cycle.
template <class S>
void apply_measured(Formula, std::span<const S> theta, const EffectShape& shape,
                    const Situation& at, const offline::MeasuredContext& measured, Motion<S>& out) {
  using format::FormulaOp;
  Formula::apply(theta, shape, at, out, [&](FormulaOp op, std::size_t which) {
    if (op == FormulaOp::kMove) return measured.step[which];
    if (op == FormulaOp::kRow) return measured.order + 1.0;
    return Formula::read(op, which, shape, at);
  });
}

}  // namespace plumb::effects
