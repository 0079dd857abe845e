// SPDX-License-Identifier: Apache-2.0
#include "diagnose/formula_proposal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "cell/formula_reader.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/few_digits.hpp"
#include "diagnose/formula_choice.hpp"
#include "diagnose/formula_terms.hpp"
#include "diagnose/refit.hpp"
#include "diagnose/unless_refused.hpp"
#include "diagnose/whitened_fit.hpp"
#include "effects/registry.hpp"
#include "fit/few_poses.hpp"

namespace plumb::offline {
namespace {

/// What a formula may move: one number of the pattern's subject.
struct Moved {
  std::string name;  // "dq5", "base.dx"
  bool turns = true;
  double usual = kAngle_rad;
};

constexpr std::array kComponents = {"dx", "dy", "dz", "rx", "ry", "rz"};

std::vector<Moved> moved_by(const Pattern& pattern) {
  if (pattern.joint >= 0) return {{fmt::format("dq{}", pattern.joint + 1)}};
  std::vector<Moved> out;
  const bool base = pattern.subject == kTheBase;
  for (std::size_t k = 0; k < (base ? 6U : 3U); ++k)
    out.push_back({fmt::format("{}.{}", base ? "base" : "tool", kComponents[k]), k >= 3,
                   k < 3 ? kShift_m : kTurn_rad});
  return out;
}

/// The size of a term's factor that counts as 1, as a cell states it.
double typical_of(const Moved& moved, const FormulaTerm& term) {
  return with_digits(moved.usual / term.value.abs().maxCoeff(), 1);
}

Regressor columns_of(const WhitenedFit& s, const Pattern& pattern, const Moved& moved,
                     Eigen::Index component, const std::vector<FormulaTerm>& terms) {
  Regressor out;
  out.pattern = pattern;
  out.joint = pattern.joint;
  const auto count = static_cast<Eigen::Index>(terms.size());
  const bool of_joint = pattern.joint >= 0;
  out.columns.resize(of_joint ? s.poses() : s.table.lines(), count);
  out.typical.resize(count);
  const Eigen::MatrixXd& carriers = pattern.subject == kTheBase ? s.base : s.tool;
  for (Eigen::Index c = 0; c < count; ++c) {
    const FormulaTerm& term = terms[static_cast<std::size_t>(c)];
    out.typical(c) = typical_of(moved, term);
    for (Eigen::Index i = 0; i < out.columns.rows(); ++i)
      out.columns(i, c) =
          out.typical(c) *
          (of_joint ? term.value(i) : term.value(s.table.reading(i)) * carriers(i, component));
  }
  return out;
}

/// "rad", "rad/(N m)"
std::string factor_unit(const Moved& moved, const FormulaTerm& term) {
  const std::string of = moved.turns ? "rad" : "m";
  return term.unit == "1" ? of : fmt::format("{}/({})", of, term.unit);
}

/// Where the law belongs: time is of these measurements alone.
std::string formula_domain_of(const Pattern& pattern) {
  for (const auto& name : pattern.depends_on) {
    if (name == "t") return "measurement";
    if (name.starts_with("temp")) return "environment";
  }
  return "robot";
}

/// A name that no formula of the list has; empty: that of its target is free.
std::string free_name(const std::string& target, const std::vector<EffectEntry>& effects) {
  std::set<std::string> taken;
  for (const auto& effect : effects)
    if (is_formula(effect.name)) taken.insert(formula_label(formula_text(effect)));
  FormulaText text;
  text.target = target;
  const std::string label = formula_label(text);
  if (!taken.contains(label)) return "";
  int number = 2;
  while (taken.contains(fmt::format("{}_{}", label, number))) ++number;
  return fmt::format("{}_{}", label, number);
}

/// One formula that may be offered.
struct Draft {
  Moved moved;
  FormulaChoice choice;
  EffectEntry entry;
};

EffectEntry entry_of_draft(const FormulaQuestion& asked, const Moved& moved,
                           const std::vector<FormulaTerm>& terms, const FormulaChoice& choice) {
  std::string expression;
  std::vector<std::string> parameters;
  for (const std::size_t place : choice.terms) {
    const FormulaTerm& term = terms[place];
    const std::string name = fmt::format("k{}", parameters.size() + 1);
    expression += fmt::format("{}{}*{}", parameters.empty() ? "" : " + ", name, term.text);
    parameters.push_back(
        fmt::format("{} [{}] ~ {:g}", name, factor_unit(moved, term), typical_of(moved, term)));
  }
  EffectEntry out;
  out.name = formula_effect();
  out.options["target"] = moved.name;
  out.options["expression"] = expression;
  out.options["parameters"] = parameters;
  if (const auto domain = formula_domain_of(asked.pattern); domain != "robot")
    out.options["domain"] = domain;
  if (const auto name = free_name(moved.name, asked.effects); !name.empty())
    out.options["name"] = name;
  return out;
}

/// Everything that the terms are made of, at the whitened fit of the model.
struct Screened {
  std::vector<FormulaInput> inputs;
  std::vector<FormulaTerm> terms;
  std::vector<Draft> drafts;  // best first
};

Screened screened(const FormulaQuestion& asked) {
  Cell with = asked.cell;
  with.effects = asked.effects;
  const WhitenedFit s =
      make_whitened_fit(with, asked.measured, asked.calibration,
                        without_outliers(asked.choosing, asked.calibration.outliers), {});
  Screened out;
  out.inputs = formula_inputs(s, asked.pattern);
  out.terms = formula_terms(asked.pattern, out.inputs, out.inputs);
  if (out.terms.empty()) return out;
  const Scorer scorer(s);
  const auto all = moved_by(asked.pattern);
  for (std::size_t m = 0; m < all.size(); ++m)
    for (const auto& choice : choose_formulas(
             scorer, columns_of(s, asked.pattern, all[m], static_cast<Eigen::Index>(m), out.terms),
             out.terms))
      out.drafts.push_back({all[m], choice, entry_of_draft(asked, all[m], out.terms, choice)});
  std::stable_sort(out.drafts.begin(), out.drafts.end(),
                   [](const Draft& a, const Draft& b) { return a.choice.nats > b.choice.nats; });
  if (out.drafts.size() > kMostFormulas) out.drafts.resize(kMostFormulas);
  return out;
}

/// Mean fall of the error of unseen poses, and its standard error.
struct Fall {
  double mean = 0.0, se = 0.0;
};

Fall fall_of(const std::vector<double>& falls) {
  Fall out;
  const auto n = static_cast<double>(falls.size());
  if (falls.size() < 2) return out;
  for (const double fall : falls) out.mean += fall / n;
  double squares = 0.0;
  for (const double fall : falls) squares += (fall - out.mean) * (fall - out.mean);
  out.se = std::sqrt(squares / (n - 1.0) / n);
  return out;
}

/// The fall with a formula; nothing if a fold disagrees.
std::optional<Fall> agreed_fall(const FormulaQuestion& asked, const HeldOutPredictions& after) {
  const auto rows = held_rows(asked.split);
  const auto then_m = asked.before.errors_m(), now_m = after.errors_m();
  std::vector<double> falls;
  std::vector<double> by_fold(static_cast<std::size_t>(std::max(1, asked.split.folds)), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<std::size_t>(rows[i]);
    if (asked.bad.rows.contains(rows[i])) continue;
    const double fall = then_m[i] - now_m[i];
    falls.push_back(fall);
    by_fold[static_cast<std::size_t>(asked.split.folds > 0 ? std::max(0, asked.split.fold[row])
                                                           : 0)] += fall;
  }
  if (std::any_of(by_fold.begin(), by_fold.end(), [](double fall) { return !(fall > 0.0); }))
    return std::nullopt;
  return fall_of(falls);
}

std::vector<FormulaNumber> numbers_of(const EffectEntry& entry, const Calibration& fitted) {
  const std::string prefix = "formula." + formula_label(formula_text(entry)) + ".";
  std::vector<FormulaNumber> out;
  for (const auto& estimate : fitted.estimates)
    if (estimate.name.starts_with(prefix))
      out.push_back(
          {estimate.name.substr(prefix.size()), estimate.unit, estimate.value, estimate.std});
  return out;
}

/// The formula along the first of its inputs; the others stay at their mean, and the joints come
/// from below.
void draw(const Pattern& pattern, const Screened& all, const FormulaChoice& choice,
          FormulaOffer& out) {
  out.input = all.terms[choice.terms.front()].first;
  std::vector<FormulaInput> over = all.inputs;
  Eigen::ArrayXd along;
  for (auto& input : over) {
    const bool this_one = input.name == out.input;
    if (this_one) {
      along =
          Eigen::ArrayXd::LinSpaced(kFormulaCurve, input.value.minCoeff(), input.value.maxCoeff());
      out.input_unit = input.unit;
      input.value = along;
    } else {
      const double still = input.name.starts_with("dir") ? 1.0 : input.value.mean();
      input.value = Eigen::ArrayXd::Constant(kFormulaCurve, still);
    }
  }
  const auto terms = formula_terms(pattern, all.inputs, over);
  Eigen::ArrayXd value = Eigen::ArrayXd::Zero(kFormulaCurve);
  for (std::size_t k = 0; k < choice.terms.size(); ++k)
    value += out.numbers[k].value * terms[choice.terms[k]].value;
  for (Eigen::Index i = 0; i < kFormulaCurve; ++i) out.curve.push_back({along(i), value(i)});
}

std::optional<FormulaOffer> judged_draft(const FormulaQuestion& asked, const Screened& all,
                                         const Draft& draft) {
  std::vector<EffectEntry> effects = asked.effects;
  effects.push_back(draft.entry);
  std::optional<FormulaOffer> out;
  const bool made = unless_refused([&] {
    const Calibration fitted =
        refitted(asked.cell, asked.measured, asked.fit, effects, asked.calibration);
    FormulaOffer offer;
    offer.entry = draft.entry;
    offer.numbers = numbers_of(draft.entry, fitted);
    if (offer.numbers.size() != draft.choice.terms.size()) return;  // one is not determined
    const HeldOutPredictions after = asked.held_out(effects, fitted);
    const auto fall = agreed_fall(asked, after);
    offer.before = asked.before.stats(asked.bad);
    offer.after = after.stats(asked.bad);
    if (!fall || !(fall->mean > kFormulaFallSe * fall->se) ||
        !(offer.after.mean < (1.0 - kFormulaFall) * offer.before.mean))
      return;
    offer.fall_m = fall->mean;
    offer.fall_se_m = fall->se;
    offer.nats = draft.choice.nats;
    offer.turns = draft.moved.turns;
    draw(asked.pattern, all, draft.choice, offer);
    out = std::move(offer);
  });
  return made ? out : std::nullopt;
}

}  // namespace

std::vector<FormulaOffer> formula_offers(const FormulaQuestion& asked) {
  std::vector<FormulaOffer> out;
  if (asked.effects.size() >= kMostEffects) return out;
  const Screened all = screened(asked);
  for (const auto& draft : all.drafts)
    if (auto offer = judged_draft(asked, all, draft)) out.push_back(std::move(*offer));
  if (out.empty()) return out;
  const double best_m = std::min_element(out.begin(), out.end(), [](const auto& a, const auto& b) {
                          return a.after.mean < b.after.mean;
                        })->after.mean;
  std::erase_if(
      out, [&](const FormulaOffer& offer) { return offer.after.mean > kFormulaNearly * best_m; });
  return out;
}

}  // namespace plumb::offline
