// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "program/verb_options.hpp"

namespace plumb::offline::cli {

inline constexpr const char* kFormulaExample =
    "plumb add formula --formula \"dq2 = k * tau2\" --parameter \"k [rad/(N m)] ~ 1e-6\"";

/// An effect on the command line: NAME [--joints J2,J3] [--set KEY=VALUE ...], and for the user's
/// own formula --formula "dq2 = k * tau2" --parameter "k [rad/(N m)] ~ 1e-6" --name N --domain D.
/// --set cycles_per_turn=7.91,17.49 is two effects.
struct EffectOptions {
  std::string name;
  std::vector<std::string> joints;
  std::vector<std::string> set;
  std::string formula;
  std::vector<std::string> parameters;
  std::string formula_name;
  std::string domain;

  /// The options that name an effect; `law_too` adds those that define a formula.
  void add_to(VerbOptions& verb, bool law_too);

  /// The effects that the options describe, complete as in a cell file. Throws Failure (kUsage)
  /// with "did you mean".
  std::vector<EffectEntry> to_add(const Cell& cell) const;

  /// The effects to drop, with those joints and settings alone that the options name. Throws
  /// Failure (kUsage) with "did you mean".
  std::vector<EffectEntry> to_drop(const Cell& cell) const;

  /// The option that a place in the text of a cell with these effects comes from:
  /// "--formula 'dq2 = tau9'".
  std::string option_at(const Place& place) const;

  /// The same as a place. Inside --formula its column counts characters of the option's text, from
  /// 1; its line is 0.
  Place place_at(const Place& place) const;
};

}  // namespace plumb::offline::cli
