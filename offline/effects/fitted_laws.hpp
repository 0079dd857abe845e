// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <tuple>
#include <type_traits>

#include "effects/measurement/drift.hpp"
#include "effects/measurement/formula.hpp"
#include "effects/measurement/settling_lag.hpp"
#include "effects/measurement/step.hpp"
#include "effects/measurement/tracker.hpp"
#include "plumb/runtime/detail/effect_library.hpp"

/// All laws that a fit knows: those of the runtime, and those of the measurement. The latter are
/// fitted so that they do not distort the other parameters; no model file contains them.
namespace plumb::offline {

using MeasurementLaws =
    std::tuple<effects::SettlingLag, effects::Drift, effects::Step, effects::Tracker>;
using FittedLaws = decltype(std::tuple_cat(EffectLaws{}, MeasurementLaws{}));

/// Laws 0 to kEffectLaws - 1 are the runtime's, in its order.
inline constexpr int kFittedLaws = static_cast<int>(std::tuple_size_v<FittedLaws>);

const EffectInfo& fitted_law_info(int law);

/// Number of the law with this name, or -1.
int find_fitted_law(std::string_view name);

/// Whether the law belongs to the measurement, so that no model file contains it.
inline bool is_measurement_law(int law) { return law >= kEffectLaws; }

/// How many parameters the law has for this shape.
int fitted_parameter_count(int law, const EffectShape& shape);

/// Adds the motion of the effect at one measured pose to `out`; theta: shape
/// (fitted_parameter_count,). `at` holds what the runtime knows in a control cycle, `measured` all
/// that is known of the pose.
template <class S>
void apply_fitted_law(int law, std::span<const S> theta, const EffectShape& shape,
                      const Situation& at, const MeasuredContext& measured, Motion<S>& out) {
  with_law<FittedLaws>(law, [&](auto found) {
    using Law = decltype(found);
    if constexpr (std::is_same_v<Law, effects::Formula>)
      effects::apply_measured(found, theta, shape, at, measured, out);
    else if constexpr (requires { Law::template apply<S>(theta, shape, at, measured, out); })
      Law::template apply<S>(theta, shape, at, measured, out);
    else
      Law::template apply<S>(theta, shape, at, out);
  });
}

}  // namespace plumb::offline
