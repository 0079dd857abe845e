// SPDX-License-Identifier: Apache-2.0
#include "show/check_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "show/text_table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

constexpr std::size_t kMostReadings = 6;

std::string residual(double metres, double size) {
  return metres < size ? fmt::format("{:.3f}", to_mm(metres)) : "no fit";
}

std::string readings_text(const Cell& cell, const Detection& d) {
  if (!d.why_not.empty()) return "  conventions not checked: " + d.why_not + "\n";
  const Convention& labels = d.present.convention;
  TextTable table({"placed [mm]", "fitted [mm]", "how the files are read"});
  table.left_from(2);
  std::vector<Reading> rows = d.table;
  const auto is_best = [&](const Reading& r) { return r.convention == d.best.convention; };
  std::stable_partition(rows.begin(), rows.end(), is_best);
  if (rows.size() > kMostReadings) rows.resize(kMostReadings);
  const auto labelled = [&](const Reading& r) { return r.convention == labels; };
  if (std::none_of(rows.begin(), rows.end(), labelled)) rows.push_back(d.present);
  for (const auto& r : rows) {
    const auto words = in_words(cell, labels, r.convention);
    const std::string name =
        words.empty() ? "as labelled" : fmt::format("{}", fmt::join(words, "; "));
    table.add({residual(r.placed_m, r.size_m), residual(r.fitted_m, r.size_m),
               (is_best(r) ? "best: " : "") + name});
  }
  return table.text() + fmt::format("  {} readings tried\n", d.tried);
}

std::string coverage_text(const Cell& cell, const Coverage& coverage) {
  TextTable table({"joint", "used", "", "limits", "share", ""});
  table.left_from(5);
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
  return table.text() + fmt::format("  {} poses, {} readings; reflector in the base frame: {} mm\n",
                                    coverage.poses, coverage.readings, box);
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

std::string parameters_text(const IdentifiabilityReport& p) {
  const auto& o = p.observability;
  std::string out = fmt::format(
      "  rank {} of {} candidates, {} fitted; scaled condition {:.3g}; calibrability {:.3g}\n"
      "  observability O1 {:.3g}, O2 {:.3g}, O3 {:.3g}, O4 {:.3g}, O5 {:.3g}\n",
      p.rank, p.candidates, p.calibration.estimates.size(), p.scaled_condition,
      p.calibration.calibrability, o.O1, o.O2, o.O3, o.O4, o.O5);
  int choices = 0;
  for (const auto& s : p.separations) {
    if (s.cause == Separation::Cause::kChoice)
      ++choices;
    else
      out += "  " + s.text + "\n";
  }
  if (choices > 0)
    out += fmt::format("  {} more are a choice of where base and tool begin: no harm\n", choices);
  return out;
}

std::string effects_text(const std::vector<Testable>& effects) {
  static const char* const kAnswers[] = {"no", "weakly", "yes"};
  TextTable table({"effect", "testable", "why", "to measure"});
  table.left_from(1);
  for (const auto& e : effects)
    table.add({e.effect, kAnswers[static_cast<int>(e.answer)], e.why, e.measure});
  return table.text();
}

}  // namespace

std::string check_text(const Cell& cell, const Check& check) {
  std::string out = verdict(check) + "\n\n" + readings_text(cell, check.detection) + "\n";
  if (check.coverage) out += coverage_text(cell, *check.coverage) + noise_text(check) + "\n";
  if (check.parameters) out += parameters_text(*check.parameters) + "\n";
  return out + effects_text(check.effects);
}

}  // namespace plumb::offline::show
