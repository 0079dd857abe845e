// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <tuple>
#include <utility>

#include "plumb/runtime/effects/axis_wobble.hpp"
#include "plumb/runtime/effects/backlash_load.hpp"
#include "plumb/runtime/effects/base_compliance.hpp"
#include "plumb/runtime/effects/cross_compliance.hpp"
#include "plumb/runtime/effects/drift.hpp"
#include "plumb/runtime/effects/encoder_eccentricity.hpp"
#include "plumb/runtime/effects/encoder_scale.hpp"
#include "plumb/runtime/effects/formula.hpp"
#include "plumb/runtime/effects/gear_harmonics.hpp"
#include "plumb/runtime/effects/gear_ripple.hpp"
#include "plumb/runtime/effects/gravity_compensator.hpp"
#include "plumb/runtime/effects/gravity_free.hpp"
#include "plumb/runtime/effects/joint_compliance.hpp"
#include "plumb/runtime/effects/joint_compliance_soft.hpp"
#include "plumb/runtime/effects/joint_table.hpp"
#include "plumb/runtime/effects/link_flexure.hpp"
#include "plumb/runtime/effects/payload_compliance.hpp"
#include "plumb/runtime/effects/reversal.hpp"
#include "plumb/runtime/effects/settling_lag.hpp"
#include "plumb/runtime/effects/step.hpp"
#include "plumb/runtime/effects/thermal_growth.hpp"
#include "plumb/runtime/effects/tool_sag.hpp"
#include "plumb/runtime/effects/tracker.hpp"
#include "plumb/runtime/effects/wrench_compliance.hpp"
#include "plumb/runtime/effects/wrist_coupling.hpp"

namespace plumb {

/// Every law there is; a new one is one header and one line here.
using EffectLaws =
    std::tuple<effects::JointCompliance, effects::JointComplianceSoft, effects::GravityFree,
               effects::LinkFlexure, effects::GearHarmonics, effects::GearRipple,
               effects::JointTable, effects::EncoderScale, effects::EncoderEccentricity,
               effects::Reversal, effects::BacklashLoad, effects::SettlingLag, effects::AxisWobble,
               effects::WristCoupling, effects::CrossCompliance, effects::ThermalGrowth,
               effects::BaseCompliance, effects::ToolSag, effects::GravityCompensator,
               effects::PayloadCompliance, effects::WrenchCompliance, effects::Drift, effects::Step,
               effects::Tracker, effects::Formula>;

inline constexpr int kEffectLaws = static_cast<int>(std::tuple_size_v<EffectLaws>);

/// Calls f(Law{}) of law number `index`; false if there is none.
template <class F, std::size_t... I>
bool with_law(int index, F&& f, std::index_sequence<I...>) {
  return (
      (index == static_cast<int>(I) ? (f(std::tuple_element_t<I, EffectLaws>{}), true) : false) ||
      ...);
}
template <class F>
bool with_law(int index, F&& f) {
  return with_law(index, f, std::make_index_sequence<std::tuple_size_v<EffectLaws>>{});
}

const EffectInfo& effect_info(int law) noexcept;

/// Number of the law of that name, or -1.
int find_effect_law(std::string_view name) noexcept;

/// How many parameters the law has for this shape.
int effect_parameter_count(int law, const EffectShape& shape) noexcept;

/// Adds what the effect does at one pose; theta: shape (effect_parameter_count,).
template <class S>
void apply_effect(int law, std::span<const S> theta, const EffectShape& shape, const Situation& at,
                  Motion<S>& out) {
  with_law(law, [&](auto found) { decltype(found)::apply(theta, shape, at, out); });
}

}  // namespace plumb
