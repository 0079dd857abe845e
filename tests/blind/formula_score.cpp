// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/formula_score.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cell/formula_reader.hpp"
#include "diagnose/formula_words.hpp"

namespace plumb::tests {
namespace {

using namespace offline;

/// Whether the text has that name, not as the beginning of a longer one.
bool reads(const std::string& text, const std::string& name) {
  for (auto at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0) &&
        (end == text.size() || std::isdigit(static_cast<unsigned char>(text[end])) == 0))
      return true;
  }
  return false;
}

/// "previous q2" is read as q2 and travel2.
bool reads_input(const std::string& text, const std::string& input) {
  constexpr std::string_view kPrevious = "previous q";
  if (!input.starts_with(kPrevious))
    return reads(text, input) || (input == "temp" && text.find("temp") != std::string::npos);
  const std::string joint = input.substr(kPrevious.size());
  return reads(text, "q" + joint) && reads(text, "travel" + joint);
}

bool right_variables(const HiddenCase& drawn, const BlindCase& blind, const FormulaOffer& first) {
  const FormulaText text = formula_text(first.entry);
  if (text.target != fmt::format("dq{}", drawn.hidden.front().joint + 1)) return false;
  const auto truth = nlohmann::json::parse(blind.truth_json);
  for (const auto& effect : truth["effects"])
    if (effect.contains("inputs"))
      for (const auto& input : effect["inputs"])
        if (!reads_input(text.expression, input.get<std::string>())) return false;
  return true;
}

double shown(const ArmState& arm, const Simulation& fresh, double sigma) {
  return std::hypot(sigma, true_error(arm, fresh));
}

}  // namespace

FormulaScore formula_score(const HiddenCase& drawn, const BlindCase& blind, const Seen& seen,
                           const Diagnosis& d) {
  FormulaScore out;
  out.offered = static_cast<int>(d.formulas.size());
  if (out.offered == 0) return out;
  const FormulaOffer& first = d.formulas.front();
  out.law = law_of(first);
  out.held_ratio = first.after.mean / first.before.mean;
  if (drawn.group != Group::kUnknown) return out;
  out.variables_right = right_variables(drawn, blind, first);
  BlindRequest nothing = drawn.request;
  nothing.effects.clear();
  const BlindCase clean = make_blind_case(nothing);
  const double sigma = drawn.request.sigma_m;
  const Seen clean_seen = written_and_read(clean, drawn.request.seed);
  const double of_true_law =
      shown(fitted(clean_seen, clean_seen.cell.effects), clean.fresh_robot, sigma);
  std::vector<EffectEntry> effects = d.effects;
  out.before_over_true_law = shown(fitted(seen, effects), blind.fresh_robot, sigma) / of_true_law;
  effects.push_back(first.entry);
  out.over_true_law = shown(fitted(seen, effects), blind.fresh_robot, sigma) / of_true_law;
  return out;
}

}  // namespace plumb::tests
