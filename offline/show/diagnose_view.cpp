// SPDX-License-Identifier: Apache-2.0
#include "show/diagnose_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "diagnose/verdict.hpp"
#include "show/effect_arguments.hpp"
#include "show/text_table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

constexpr std::size_t kShown = 8;
constexpr std::size_t kNumbersShown = 4;

std::string in_common_unit(const CandidateNumber& n) {
  if (n.unit == "rad") return fmt::format("{:.0f} ± {:.0f} µrad", n.value * 1e6, 1.96e6 * n.std);
  if (n.unit == "m") return fmt::format("{:.1f} ± {:.1f} µm", n.value * 1e6, 1.96e6 * n.std);
  return fmt::format("{:.3g} ± {:.2g} {}", n.value, 1.96 * n.std, n.unit == "1" ? "" : n.unit);
}

std::string errors_text(const Cell& cell, const Diagnosis& d) {
  TextTable table({"held-out error [mm]", "mean", "RMS", "95 %", "max"});
  const auto add = [&](const std::string& name, const ErrorStats& e) {
    table.add({name, mm(e.mean), mm(e.rms), mm(e.p95), mm(e.max)});
  };
  add("now", d.before);
  for (const auto& a : d.added) add("+ " + in_words(cell, a.entry, a.cycles), a.held);
  if (d.nested && !d.added.empty()) add("all, chosen anew in every fold", d.after);
  std::string out = table.text();
  if (d.floor.source != NoiseFloor::Source::kNone)
    out += fmt::format("  noise floor  mean {}  RMS {}\n", mm(d.floor.mean_m), mm(d.floor.rms_m));
  return out;
}

std::string candidates_text(const Cell& cell, const Diagnosis& d) {
  if (d.candidates.empty()) return {};
  TextTable table({"candidate", "ln Bayes", "fall", "alone", "after #1", "share", "absorbed", ""});
  table.left_from(7);
  std::string numbers;
  for (std::size_t i = 0; i < std::min(kShown, d.candidates.size()); ++i) {
    const Candidate& c = d.candidates[i];
    table.add({fmt::format("{} {}", i + 1, in_words(cell, c.entry, c.cycles)),
               fmt::format("{:.1f}", c.ln_bayes),
               fmt::format("{:.1f} ± {:.1f} %", 100 * c.gain, 100 * c.gain_se), mm(c.alone.mean),
               mm(c.after.mean), fmt::format("{:.0f} %", 100 * c.explained),
               fmt::format("{:.0f} %", 100 * c.absorbed),
               !c.supported   ? "not supported"
               : !c.plausible ? "supported, but of an unlikely size"
                              : "supported"});
  }
  std::string out =
      "\nCandidates: held-out error [mm] alone and with the first one\n" + table.text();
  if (d.candidates.size() > kShown)
    out += fmt::format("  and {} more: --json\n", d.candidates.size() - kShown);
  const Candidate& best = d.candidates.front();
  if (!best.supported) return out;
  out += "\n  " + in_words(cell, best.entry, best.cycles) + ":";
  for (std::size_t i = 0; i < std::min(kNumbersShown, best.numbers.size()); ++i)
    out += fmt::format("{} {}", i == 0 ? "" : ",", in_common_unit(best.numbers[i]));
  if (best.numbers.size() > kNumbersShown)
    out += fmt::format(", {} more", best.numbers.size() - kNumbersShown);
  if (!best.confounded_with.empty())
    out += fmt::format("\n  hard to tell from {}{}", fmt::join(best.confounded_with, ", "),
                       best.separate.empty() ? "" : "; measure " + best.separate);
  if (best.rival)
    out += fmt::format("\n  poses for that: plumb plan --separate {},{}",
                       planning_argument(cell, best.entry), planning_argument(cell, *best.rival));
  return out + "\n";
}

std::string not_testable_text(const Diagnosis& d) {
  if (d.not_testable.empty()) return {};
  TextTable table({"not testable with these data", "why", "measure"});
  table.left_from(1);
  for (const auto& t : d.not_testable) table.add({t.effect, t.why, t.measure});
  return "\n" + table.text();
}

std::string next_text(const Cell& cell, const Diagnosis& d) {
  if (d.finding_after || d.finding != Finding::kMissing) return {};
  return fmt::format(
      "\nAdd it:            plumb add {}\nOr go all the way: plumb diagnose --apply\n",
      adding_arguments(cell, d.candidates.front().entry, d.candidates.front().cycles));
}

}  // namespace

std::string diagnose_text(const Cell& cell, const Diagnosis& d) {
  std::string out = d.text + "\n";
  if (d.finding_after) out += d.text_after + "\n";
  out += "\n" + errors_text(cell, d) + candidates_text(cell, d);
  if (!d.outliers.empty())
    out += fmt::format("\nLeft out, the others contradict them: {}\n", fmt::join(d.outliers, ", "));
  return out + not_testable_text(d) + next_text(cell, d);
}

}  // namespace plumb::offline::show
