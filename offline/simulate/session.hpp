// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/truth.hpp"
#include "simulate/visible.hpp"

namespace plumb::offline::sim {

/// Pose of the reflector in the measurement frame at one visit, bent by some laws.
Isometry3d bent_pose(const World& world, const std::vector<HiddenLaw>& laws, int row);

/// Laws for the effects of a plan. An effect whose size is given in sigma gets the size in SI that
/// leaves so much visible; numbers that a law took from this session are written down, so that the
/// same effects can be measured in another one. Throws Failure (kUsage) where that is not possible.
struct SizedLaws {
  std::vector<HiddenLaw> laws;
  std::vector<HiddenEffect> effects;
  std::vector<EffectSize> sizes;
};
SizedLaws make_laws(const std::vector<HiddenEffect>& effects, const World& world,
                    const SimulationPlan& plan);

}  // namespace plumb::offline::sim
