// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/truth.hpp"
#include "simulate/visible.hpp"

namespace plumb::offline::sim {

/// The pose of the reflector in the measurement frame at one visit, with the deflections of these
/// laws and the scatter of the joints.
Isometry3d bent_pose(const World& world, const std::vector<HiddenLaw>& laws, int row);

/// The laws for the effects of a plan. An effect whose size is given in sigma gets the SI size at
/// which that much is visible. Numbers that a law took from this session are stored in `effects`,
/// so that the same effects can be measured in another session. Throws Failure (kUsage) where that
/// is not possible.
struct SizedLaws {
  std::vector<HiddenLaw> laws;
  std::vector<HiddenEffect> effects;
  std::vector<EffectSize> sizes;
};
SizedLaws make_laws(const std::vector<HiddenEffect>& effects, const World& world,
                    const SimulationPlan& plan);

}  // namespace plumb::offline::sim
