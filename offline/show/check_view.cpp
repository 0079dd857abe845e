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

std::string readings_text(const Cell& cell, const Detection& d) {
  if (!d.why_not.empty()) return "  conventions not checked: " + d.why_not + "\n";
  const Convention& labels = d.present.convention;
  Table table{.head = {"placed [mm]", "fitted [mm]", "how the files are read"}};
  table.left_from = 2;
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
  return text_of(table) + fmt::format("  {} ways to read the files tried{}\n", d.tried,
                                      hidden == 0
                                          ? ""
                                          : fmt::format("; {} more name the same arm, mirrored "
                                                        "or counted otherwise",
                                                        hidden));
}

std::string coverage_text(const Cell& cell, const Coverage& coverage) {
  Table table{.head = {"joint", "used", "", "limits", "share", ""}};
  table.left_from = 5;
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
  return text_of(table) + fmt::format("  {}, {}; reflector in the base frame: {} mm\n",
                                      counted_words(coverage.poses, "pose", "poses"),
                                      counted_words(coverage.readings, "reading", "readings"), box);
}

std::string noise_text(const Check& check) {
  const auto& f = check.floor;
  std::string out = "  noise: unknown\n";
  if (f.source != NoiseFloor::Source::kNone)
    out =
        fmt::format("  noise: {:.1f} um per axis, {}\n", f.sigma_m * 1e6,
                    f.source == NoiseFloor::Source::kRepeats ? "from repeated poses" : "as stated");
  if (check.rounding)
    out += fmt::format("  joint readings are multiples of {:g} {}: {:.2g} mm at the tool\n",
                       check.rounding->step_in_unit, check.rounding->unit,
                       to_mm(check.rounding->at_tool_m));
  return out;
}

const char* condition_words(double condition) {
  return condition < kGoodCondition ? "well" : condition < kFairCondition ? "fairly" : "poorly";
}

std::string parameters_text(const IdentifiabilityReport& p) {
  std::string out = fmt::format(
      "  {} numbers fitted, of {} candidates; these poses show them {} (condition "
      "{:.3g})\n",
      p.calibration.estimates.size(), p.candidates, condition_words(p.scaled_condition),
      p.scaled_condition);
  int choices = 0;
  for (const auto& s : p.separations) {
    if (s.cause == Separation::Cause::kChoice)
      ++choices;
    else
      out += "  " + s.text + "\n";
  }
  if (choices > 0)
    out += fmt::format(
        "  {} more only say where base and tool frame are placed, which is free: no harm\n",
        choices);
  return out;
}

/// The testable effects on one line; for the others, why they are not and what to measure.
std::string effects_text(const std::vector<Testable>& effects) {
  std::string yes, weakly, no;
  for (const auto& e : effects) {
    const std::string why = fmt::format("  {}: {}{}\n", e.effect, e.why,
                                        e.measure.empty() ? "" : "; measure " + e.measure);
    if (e.answer == Testable::Answer::kYes) yes += (yes.empty() ? "" : ", ") + e.effect;
    if (e.answer == Testable::Answer::kWeakly) weakly += why;
    if (e.answer == Testable::Answer::kNo) no += why;
  }
  std::string out = "These data can show: " + (yes.empty() ? "no effect" : yes) + "\n";
  if (!weakly.empty()) out += "\nThey can show weakly\n" + weakly;
  if (!no.empty()) out += "\nThey cannot show\n" + no;
  return out;
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

std::string check_text(const Cell& cell, const Check& check) {
  std::string out = verdict(check) + "\n\n" + readings_text(cell, check.detection) + "\n";
  if (check.coverage) out += coverage_text(cell, *check.coverage) + noise_text(check) + "\n";
  if (check.parameters) out += parameters_text(*check.parameters) + "\n";
  return out + effects_text(check.effects);
}

}  // namespace plumb::offline::show
