// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <tuple>
#include <utility>

#include "plumb/runtime/detail/effects/axis_wobble.hpp"
#include "plumb/runtime/detail/effects/backlash_load.hpp"
#include "plumb/runtime/detail/effects/base_compliance.hpp"
#include "plumb/runtime/detail/effects/cross_compliance.hpp"
#include "plumb/runtime/detail/effects/drive_coupling.hpp"
#include "plumb/runtime/detail/effects/encoder_eccentricity.hpp"
#include "plumb/runtime/detail/effects/encoder_scale.hpp"
#include "plumb/runtime/detail/effects/formula.hpp"
#include "plumb/runtime/detail/effects/gear_harmonics.hpp"
#include "plumb/runtime/detail/effects/gear_ripple.hpp"
#include "plumb/runtime/detail/effects/gravity_compensator.hpp"
#include "plumb/runtime/detail/effects/gravity_free.hpp"
#include "plumb/runtime/detail/effects/joint_compliance.hpp"
#include "plumb/runtime/detail/effects/joint_compliance_soft.hpp"
#include "plumb/runtime/detail/effects/joint_series.hpp"
#include "plumb/runtime/detail/effects/joint_table.hpp"
#include "plumb/runtime/detail/effects/link_flexure.hpp"
#include "plumb/runtime/detail/effects/payload_compliance.hpp"
#include "plumb/runtime/detail/effects/pitch_error.hpp"
#include "plumb/runtime/detail/effects/rail_bow.hpp"
#include "plumb/runtime/detail/effects/reversal.hpp"
#include "plumb/runtime/detail/effects/thermal_growth.hpp"
#include "plumb/runtime/detail/effects/tool_sag.hpp"
#include "plumb/runtime/detail/effects/wrench_compliance.hpp"
#include "plumb/runtime/detail/effects/wrist_coupling.hpp"

namespace plumb {

/// All laws of the robot and of its surroundings. A new law is one header and one line here.
using EffectLaws =
    std::tuple<effects::JointCompliance, effects::JointComplianceSoft, effects::GravityFree,
               effects::LinkFlexure, effects::GearHarmonics, effects::GearRipple,
               effects::JointTable, effects::JointSeries, effects::EncoderScale,
               effects::EncoderEccentricity, effects::Reversal, effects::BacklashLoad,
               effects::AxisWobble, effects::RailBow, effects::PitchError, effects::WristCoupling,
               effects::DriveCoupling, effects::CrossCompliance, effects::ThermalGrowth,
               effects::BaseCompliance, effects::ToolSag, effects::GravityCompensator,
               effects::PayloadCompliance, effects::WrenchCompliance, effects::Formula>;

inline constexpr int kEffectLaws = static_cast<int>(std::tuple_size_v<EffectLaws>);

/// Calls f(Law{}) with law number `index` of the tuple Laws; false if there is no such law.
template <class Laws = EffectLaws, class F>
bool with_law(int index, F&& f) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return ((index == static_cast<int>(I) ? (f(std::tuple_element_t<I, Laws>{}), true) : false) ||
            ...);
  }
  (std::make_index_sequence<std::tuple_size_v<Laws>>{});
}

const EffectInfo& effect_info(int law) noexcept;

/// Number of the law with this name, or -1.
int find_effect_law(std::string_view name) noexcept;

/// How many parameters the law has for this shape.
int effect_parameter_count(int law, const EffectShape& shape) noexcept;

}  // namespace plumb
