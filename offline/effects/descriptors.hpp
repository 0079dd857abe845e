// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/descriptor.hpp"
#include "effects/fitted_laws.hpp"

/// One function for each law of the library, found by the law's type and defined in the file of
/// that law. Used by the registry alone; everybody else asks the registry.
namespace plumb::offline {

const EffectDescriptor& geometry_descriptor();
const EffectDescriptor& local_tree_descriptor();

const EffectDescriptor& law_descriptor(effects::AxisWobble);
const EffectDescriptor& law_descriptor(effects::BacklashLoad);
const EffectDescriptor& law_descriptor(effects::BaseCompliance);
const EffectDescriptor& law_descriptor(effects::CrossCompliance);
const EffectDescriptor& law_descriptor(effects::Drift);
const EffectDescriptor& law_descriptor(effects::DriveCoupling);
const EffectDescriptor& law_descriptor(effects::EncoderEccentricity);
const EffectDescriptor& law_descriptor(effects::EncoderScale);
const EffectDescriptor& law_descriptor(effects::Formula);
const EffectDescriptor& law_descriptor(effects::GearHarmonics);
const EffectDescriptor& law_descriptor(effects::GearRipple);
const EffectDescriptor& law_descriptor(effects::GravityCompensator);
const EffectDescriptor& law_descriptor(effects::GravityFree);
const EffectDescriptor& law_descriptor(effects::JointCompliance);
const EffectDescriptor& law_descriptor(effects::JointComplianceSoft);
const EffectDescriptor& law_descriptor(effects::JointSeries);
const EffectDescriptor& law_descriptor(effects::JointTable);
const EffectDescriptor& law_descriptor(effects::LinkFlexure);
const EffectDescriptor& law_descriptor(effects::PayloadCompliance);
const EffectDescriptor& law_descriptor(effects::PitchError);
const EffectDescriptor& law_descriptor(effects::RailBow);
const EffectDescriptor& law_descriptor(effects::Reversal);
const EffectDescriptor& law_descriptor(effects::SettlingLag);
const EffectDescriptor& law_descriptor(effects::Step);
const EffectDescriptor& law_descriptor(effects::ThermalGrowth);
const EffectDescriptor& law_descriptor(effects::ToolSag);
const EffectDescriptor& law_descriptor(effects::Tracker);
const EffectDescriptor& law_descriptor(effects::WrenchCompliance);
const EffectDescriptor& law_descriptor(effects::WristCoupling);

}  // namespace plumb::offline
