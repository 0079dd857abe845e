// SPDX-License-Identifier: Apache-2.0
#include "arm/fitted_effects.hpp"

#include "plumb/format/formula.hpp"

namespace plumb::offline {

FittedEffects::FittedEffects(const format::Model& model) {
  for (const format::Effect& effect : model.effects) {
    const int law = find_fitted_law(effect.name);
    const EffectShape shape = effect_shape(model, effect);
    effects_.push_back(
        {law, shape, is_measurement_law(law) || format::reads_measurement(effect.formula)});
    fallbacks_.add(effect, shape);
  }
  weights_ = effect_weights(model, fallbacks_);
}

void FittedEffects::survey(const ChainFrames& frames, const MeasuredContext& context,
                           Surroundings& out) const {
  out.context = &context;
  weights_.weigh(frames, context.known, out.loads);
}

}  // namespace plumb::offline
