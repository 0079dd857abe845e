// SPDX-License-Identifier: Apache-2.0
#include "show/diagnose_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "diagnose/alternatives.hpp"
#include "diagnose/certainty.hpp"
#include "diagnose/effect_domain.hpp"
#include "diagnose/effect_words.hpp"
#include "diagnose/formula_words.hpp"
#include "diagnose/scan.hpp"
#include "fit/verdict.hpp"
#include "show/error_table.hpp"
#include "show/heads.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

constexpr std::size_t kShown = 8;

/// Of very many poses an even choice decides which effects there are.
Blocks choosing_note(const Diagnosis& d) {
  if (d.poses_choosing >= d.poses_fit) return {};
  return {under(fmt::format("{} of the {} fitted poses, evenly spread, chose the effects; {}",
                            d.poses_choosing, d.poses_fit,
                            d.added.empty() ? "the error now is that of a fit to all"
                                            : "the line of the last one is a fit to all"))};
}

/// The same of orientations.
Table turn_steps(const Cell& cell, const Diagnosis& d) {
  Table table{.name = "orientation_steps",
              .caption = "Held-out orientation error [deg] as the model grows",
              .head = {"held-out orientation error [deg]", head::kMean, head::kP95, head::kMax}};
  const auto add = [&](const std::string& name, const ErrorStats& e) {
    table.add({name, deg(e.mean), deg(e.p95), deg(e.max)});
  };
  add("now", d.turns->before);
  for (const auto& a : d.added) add("+ " + in_words(cell, a), a.turns);
  table.add({"noise floor", deg(d.turns->floor.mean_rad)});
  return table;
}

Blocks steps_blocks(const Cell& cell, const Diagnosis& d) {
  Table table{.name = "steps",
              .caption = "Held-out error [mm] as the model grows",
              .head = {head::kHeldOutError, head::kMean, head::kRms, head::kP95, head::kMax}};
  const auto add = [&](const std::string& name, const ErrorStats& e) {
    table.add({name, mm(e.mean), mm(e.rms), mm(e.p95), mm(e.max)});
  };
  add("now", d.before);
  for (const auto& a : d.added) add("+ " + in_words(cell, a), a.held);
  if (d.nested && !d.added.empty()) add("all, chosen anew in every fold", d.after);
  if (d.floor.source != NoiseFloor::Source::kNone)
    table.add({"noise floor", mm(d.floor.mean_m), mm(d.floor.rms_m)});
  Blocks out{std::move(table)};
  if (d.turns) out.emplace_back(turn_steps(cell, d));
  append(out, folds_note(d.folds, d.poses_fit));
  append(out, choosing_note(d));
  return out;
}

std::string candidates_caption(const Diagnosis& d) {
  return std::string(d.added.empty() ? "Candidates" : "Candidates before any was added") +
         ": held-out error [mm] alone, and together with the first one";
}

std::string error_cell(const ErrorStats& stats) { return stats.n > 0 ? mm(stats.mean) : "-"; }

/// Everything that is known of every candidate.
Table full_table(const Cell& cell, const Diagnosis& d) {
  Table table{.name = "candidates",
              .caption = candidates_caption(d),
              .captioned = true,
              .head = {head::kLnBayes, head::kFall, head::kAlone, head::kWithFirst, head::kSize,
                       head::kShare, head::kAbsorbed, head::kSupported, head::kEffect}};
  table.left_from = 7;
  for (const Candidate& c : d.candidates)
    table.add({fmt::format("{:8.1f}", c.ln_bayes), fmt::format("{:.0f} %", 100 * c.gain),
               mm(c.alone.mean), mm(c.after.mean), mm(c.largest_m),
               fmt::format("{:.0f} %", 100 * c.explained),
               fmt::format("{:.0f} %", 100 * c.absorbed), support_words(d, c),
               command_name(cell, c.entry)});
  return table;
}

/// Whether an effect, known by its key, is one of what the first candidate may be instead.
bool is_alternative(const Cell& cell, const Diagnosis& d, const std::string& key) {
  return std::any_of(d.alternatives.begin(), d.alternatives.end(),
                     [&](const Alternative& other) { return key_of(cell, other.entry) == key; });
}

/// How far the first candidate moves the measured point, and what it may be mistaken for; one
/// sentence a line.
std::string first_candidate_text(const Cell& cell, const Diagnosis& d) {
  const Candidate& first = d.candidates.front();
  std::string out = fmt::format(
      "The first moves the measured point by up to {} mm in a way that geometry "
      "cannot imitate.",
      mm(first.largest_m));
  std::vector<std::string> near, similar;
  for (const auto& other : d.alternatives)
    near.push_back(in_words(cell, other.entry, other.cycles));
  for (const auto& key : first.confounded_with) {
    if (is_alternative(cell, d, key)) continue;
    (is_near_rival(cell, d, key) ? near : similar).push_back(key_in_words(key));
  }
  if (!near.empty())
    out += fmt::format(
        "\nHard to tell from: {}.{}", fmt::join(near, ", "),
        first.separate.empty() ? "" : " To tell them apart, measure " + first.separate + ".");
  if (!similar.empty())
    out += fmt::format("\nSimilar, but explaining these poses clearly worse: {}.",
                       fmt::join(similar, ", "));
  return out;
}

/// What most people need: which effect, and how far the error falls.
Table short_table(const Cell& cell, const Diagnosis& d) {
  Table table{.name = "candidates",
              .caption = candidates_caption(d),
              .captioned = true,
              .head = {" #", head::kAlone, head::kWithFirst, head::kSupported, head::kEffect},
              .left_from = 3};
  for (std::size_t i = 0; i < std::min(kShown, d.candidates.size()); ++i) {
    const Candidate& c = d.candidates[i];
    table.add({fmt::format("{:>2}", i + 1), error_cell(c.alone), error_cell(c.after),
               support_words(d, c), in_words(cell, c)});
  }
  return table;
}

Blocks candidates_blocks(const Cell& cell, const Diagnosis& d, Candidates shown) {
  if (d.candidates.empty()) return {};
  const bool all = shown == Candidates::kAll || d.candidates.size() <= kShown;
  Blocks out{shown == Candidates::kAll ? full_table(cell, d) : short_table(cell, d)};
  if (!all)
    out.emplace_back(
        under(fmt::format("and {} more: plumb diagnose --all", d.candidates.size() - kShown)));
  if (d.candidates.front().supported) out.emplace_back(Note{first_candidate_text(cell, d)});
  return out;
}

/// Laws that fit what no effect of the library explains, a line each.
Blocks formula_blocks(const Cell& cell, const Diagnosis& d) {
  std::vector<std::string> lines;
  for (const auto& offer : d.formulas) lines.push_back(formula_sentence(cell, offer, lines.size()));
  if (lines.empty()) return {};
  return {Note{fmt::format("{}", fmt::join(lines, "\n"))}};
}

Table not_testable_table(const Diagnosis& d) {
  Table table{.name = "not_testable",
              .caption = "Not testable with these data",
              .captioned = true,
              .head = {"effect", "why", "measure"},
              .left_from = 1,
              .as_lines = true};
  for (const auto& t : d.not_testable) table.add({t.effect, t.why, t.measure});
  return table;
}

}  // namespace

const char* class_of(Finding finding) {
  return name_of(finding == Finding::kComplete ? Grade::kGood : Grade::kPartly);
}

std::string support_words(const Diagnosis& d, const Candidate& c) {
  const bool either = is_either(d, c.entry);
  if (!c.supported && !either) return "no";
  if (!c.plausible) return "unlikely";
  if (!helps(d, c)) return "no gain";
  return either ? fmt::format("one of {}", 1 + d.alternatives.size() + (d.slow_motion ? 1 : 0))
                : "yes";
}

Blocks diagnosis_blocks(const Cell& cell, const Diagnosis& d, Candidates shown) {
  Blocks out{Sentence{d.text, class_of(d.finding)}};
  if (d.finding_after) out.emplace_back(Sentence{d.text_after, class_of(*d.finding_after)});
  append(out, formula_blocks(cell, d));
  append(out, steps_blocks(cell, d));
  out.emplace_back(Figure{"evidence"});
  append(out, candidates_blocks(cell, d, shown));
  if (!d.outliers.empty())
    out.emplace_back(
        Note{fmt::format("Left out, the others contradict {}: {}",
                         d.outliers.size() == 1 ? "it" : "them", fmt::join(d.outliers, ", "))});
  out.emplace_back(not_testable_table(d));
  return out;
}

}  // namespace plumb::offline::show
