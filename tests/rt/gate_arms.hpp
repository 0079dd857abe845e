// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string_view>

#include "tests/rt/cycle_model.hpp"
#include "tests/rt/every_effect.hpp"
#include "tests/rt/one_arm.hpp"
#include "tests/rt/own_formula.hpp"
#include "tests/runtime/random_tree.hpp"

/// The arms that the real-time gates run.
namespace plumb::tests {

inline void add_effect(format::Model& model, std::string_view name) {
  const int law = find_effect_law(name);
  if (law < 0) throw std::invalid_argument("no effect of that name");
  const int joints = static_cast<int>(model.nominal.joints.size());
  model.effects.push_back(typical_effect(model, law, joints));
}

/// Crisp trees with affine leaves, one an axis, no split in common.
inline void add_trees(format::Model& model, int leaves) {
  Random random(1);
  const test::TreeKind kind{.inputs = static_cast<int>(model.nominal.joints.size()),
                            .leaves = leaves};
  for (format::Tree& tree : model.trees) {
    tree = test::random_tree(random, kind);
    tree.sigma.clear();
  }
}

/// The arm of the budget with trees of uneven depth, as trees that are grown have.
inline format::Model uneven_arm() {
  format::Model model = cycle_model();
  add_trees(model, 100);
  return model;
}

/// Every law of the catalogue, a formula that often has no value, and blended trees.
inline format::Model every_law_arm() {
  format::Model model = blended_arm();
  add_masses(model);
  for (int law = 0; law < kEffectLaws; ++law)
    if (effect_info(law).name != "formula") add_effect(model, effect_info(law).name);
  model.effects.push_back(own_formula());
  return model;
}

}  // namespace plumb::tests
