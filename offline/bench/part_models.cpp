// SPDX-License-Identifier: Apache-2.0
#include "bench/part_models.hpp"

namespace plumb::offline::bench {

format::Model chain_alone(format::Model model) {
  model.effects.clear();
  model.trees = {};
  return model;
}

format::Model with_one_effect(format::Model model, std::size_t effect) {
  model.effects = {model.effects.at(effect)};
  model.trees = {};
  return model;
}

format::Model with_trees_alone(format::Model model) {
  model.effects.clear();
  return model;
}

std::string effect_label(const format::Model& model, std::size_t effect) {
  const format::Effect& chosen = model.effects.at(effect);
  std::string out = chosen.name;
  if (!chosen.formula.name.empty()) out += ":" + chosen.formula.name;
  for (std::size_t i = 0; i < chosen.joints.size(); ++i)
    out += (i == 0 ? ":" : "+") + model.nominal.joints.at(chosen.joints[i]).name;
  return out;
}

}  // namespace plumb::offline::bench
