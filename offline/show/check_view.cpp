// SPDX-License-Identifier: Apache-2.0
#include "show/check_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fit/verdict.hpp"
#include "program/counted_words.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

constexpr std::size_t kMostReadings = 6;
constexpr double kGoodCondition = 100.0, kFairCondition = 1000.0;

std::string residual(double metres, double size) {
  return metres < size ? fmt::format("{:.3f}", to_mm(metres)) : "no fit";
}

Blocks readings_blocks(const Cell& cell, const Detection& d) {
  Table table{.name = "readings",
              .caption = "How the files can be read",
              .head = {"placed [mm]", "fitted [mm]", "how the files are read"},
              .left_from = 2};
  if (!d.why_not.empty()) {
    table.head = {"", "why"};
    table.as_lines = true;
    table.add({"conventions not checked", d.why_not});
    return {std::move(table)};
  }
  const Convention& labels = d.present.convention;
  std::vector<Interpretation> rows = d.table;
  const auto is_best = [&](const Interpretation& r) { return r.convention == d.best.convention; };
  std::stable_partition(rows.begin(), rows.end(), is_best);
  // Ways to read the files that predict the same points describe the same arm, mirrored or counted
  // otherwise. They are not listed.
  const std::size_t all = rows.size();
  std::erase_if(rows, [&](const Interpretation& r) {
    return !(r.convention == labels) &&
           std::any_of(d.same.begin(), d.same.end(),
                       [&](const Interpretation& same) { return same.convention == r.convention; });
  });
  const std::size_t hidden = all - rows.size();
  if (rows.size() > kMostReadings) rows.resize(kMostReadings);
  const auto labelled = [&](const Interpretation& r) { return r.convention == labels; };
  if (std::none_of(rows.begin(), rows.end(), labelled)) rows.push_back(d.present);
  for (const auto& r : rows) {
    const auto words = in_words(cell, labels, r.convention);
    const std::string name =
        words.empty() ? "as labelled" : fmt::format("{}", fmt::join(words, "; "));
    table.add({residual(r.placed_m, r.size_m), residual(r.fitted_m, r.size_m),
               (is_best(r) ? "best: " : "") + name});
  }
  return {
      std::move(table),
      under(fmt::format(
          "{} ways to read the files tried{}", d.tried,
          hidden == 0 ? ""
                      : fmt::format("; {} more name the same arm, mirrored or counted otherwise",
                                    hidden)))};
}

Blocks coverage_blocks(const Cell& cell, const Coverage& coverage) {
  Table table{.name = "coverage",
              .caption = "What the poses cover",
              .head = {"joint", "used", "", "limits", "share", ""},
              .left_from = 5};
  for (std::size_t j = 0; j < coverage.joints.size(); ++j) {
    const auto& c = coverage.joints[j];
    const bool length = slides(cell.nominal.joints[j]);
    const auto span = [&](double a, double b) {
      return fmt::format("{:.0f} .. {:.0f}", shown(a, length), shown(b, length));
    };
    table.add({c.joint, span(c.q_min, c.q_max), unit(length), span(c.limit_min, c.limit_max),
               fmt::format("{:.0f} %", 100.0 * c.share), c.text});
  }
  std::string box;
  for (int k = 0; k < 3; ++k)
    box += fmt::format("{}{} {:.0f} .. {:.0f}", k > 0 ? ", " : "", "xyz"[k],
                       to_mm(coverage.box_min[k]), to_mm(coverage.box_max[k]));
  return {std::move(table),
          under(fmt::format("{}, {}; reflector in the base frame: {} mm",
                            counted_words(coverage.poses, "pose", "poses"),
                            counted_words(coverage.readings, "reading", "readings"), box))};
}

Blocks noise_notes(const Check& check) {
  const auto& f = check.floor;
  Blocks out{
      under(f.source == NoiseFloor::Source::kNone
                ? "noise: unknown"
                : fmt::format("noise: {:.1f} um per axis, {}", f.sigma_m * 1e6,
                              f.source == NoiseFloor::Source::kRepeats ? "from repeated poses"
                                                                       : "as stated"))};
  if (check.rounding)
    out.emplace_back(under(fmt::format(
        "joint readings are multiples of {:g} {}: {:.2g} mm at the tool",
        check.rounding->step_in_unit, check.rounding->unit, to_mm(check.rounding->at_tool_m))));
  return out;
}

const char* condition_words(double condition) {
  return condition < kGoodCondition ? "well" : condition < kFairCondition ? "fairly" : "poorly";
}

/// What the poses tell of the numbers, a line each.
Table parameters_lines(const IdentifiabilityReport& p) {
  Table table{.name = "identifiability",
              .caption = "What these poses tell apart",
              .head = {"numbers that are fitted"},
              .as_lines = true};
  table.add({fmt::format(
      "{} numbers fitted, of {} candidates; these poses show them {} (condition {:.3g})",
      p.calibration.estimates.size(), p.candidates, condition_words(p.scaled_condition),
      p.scaled_condition)});
  int choices = 0;
  for (const auto& s : p.separations) {
    if (s.cause == Separation::Cause::kChoice)
      ++choices;
    else
      table.add({s.text});
  }
  if (choices > 0)
    table.add({fmt::format(
        "{} more only say where base and tool frame are placed, which is free: no harm", choices)});
  return table;
}

Table effects_table(const std::vector<Testable>& effects, Testable::Answer answer, const char* name,
                    const char* caption) {
  Table table{.name = name,
              .caption = caption,
              .captioned = true,
              .head = {"effect", "why", "measure"},
              .left_from = 1,
              .as_lines = true};
  for (const auto& e : effects)
    if (e.answer == answer) table.add({e.effect, e.why, e.measure});
  return table;
}

/// The testable effects in one sentence; for the others, why they are not and what to measure.
Blocks effects_blocks(const std::vector<Testable>& effects) {
  std::string yes;
  for (const auto& e : effects)
    if (e.answer == Testable::Answer::kYes) yes += (yes.empty() ? "" : ", ") + e.effect;
  return {Sentence{"These data can show: " + (yes.empty() ? "no effect" : yes)},
          effects_table(effects, Testable::Answer::kWeakly, "weakly", "They can show weakly"),
          effects_table(effects, Testable::Answer::kNo, "not_testable", "They cannot show")};
}

Grade grade_of(Usability usable) {
  if (usable == Usability::kNotAsLabelled || usable == Usability::kNothing) return Grade::kBad;
  return usable == Usability::kAll ? Grade::kGood : Grade::kPartly;
}

}  // namespace

Verdict check_verdict(const Check& check) {
  const std::string words = verdict(check);
  return {words.substr(0, words.find_first_of(":,")), name_of(grade_of(usability(check)))};
}

Blocks check_blocks(const Cell& cell, const Check& check) {
  Blocks out{Sentence{verdict(check), check_verdict(check).found}};
  append(out, readings_blocks(cell, check.detection));
  if (check.coverage) {
    append(out, coverage_blocks(cell, *check.coverage));
    append(out, noise_notes(check));
  }
  if (check.parameters) out.emplace_back(parameters_lines(*check.parameters));
  append(out, effects_blocks(check.effects));
  return out;
}

}  // namespace plumb::offline::show
