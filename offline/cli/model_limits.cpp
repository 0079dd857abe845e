// SPDX-License-Identifier: Apache-2.0
#include "cli/model_limits.hpp"

#include <fmt/format.h>

#include "compile/compiler.hpp"
#include "effects/registry.hpp"
#include "plumb/format/limits.hpp"
#include "program/problem.hpp"

namespace plumb::offline::cli {
namespace {

[[noreturn]] void unsound(const std::string& why, std::string help) {
  throw Failure(Exit::kNumbersSayNo, {.code = "E-MODEL-UNSOUND",
                                      .message = "the model is not sound: " + why,
                                      .help = std::move(help)});
}

}  // namespace

void check_effect_sizes(const std::vector<format::Effect>& bound) {
  for (const auto& effect : bound) {
    // The numbers of a series have no covariance; those of all others share one.
    const std::size_t most =
        is_series(effect.name) ? format::kMaxEffectParameters : format::kMaxParameters;
    if (!runs_online(effect) || effect.parameters.size() <= most) continue;
    unsound(fmt::format("effect '{}' has too many parameters: {}, at most {}", effect.name,
                        effect.parameters.size(), most),
            effect.joints.size() > 1
                ? fmt::format("name fewer joints, for example: plumb add {} --joints J{}",
                              effect.name, effect.joints.front() + 1)
                : "plumb explain " + effect.name);
  }
}

void check_parameter_count(const format::Model& compiled) {
  const std::size_t count = compiled.provenance.parameter_names.size();
  if (count > format::kMaxParameters)
    unsound(fmt::format("there are too many fitted parameters: {}, at most {}", count,
                        format::kMaxParameters),
            "drop an effect that gains little: plumb compare");
}

}  // namespace plumb::offline::cli
