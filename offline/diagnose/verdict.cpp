// SPDX-License-Identifier: Apache-2.0
#include "diagnose/verdict.hpp"

#include <fmt/format.h>

#include "cell/formula_reader.hpp"
#include "diagnose/confounding.hpp"
#include "plumb/runtime/effect_library.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kWavesShown = 4;
constexpr double kFewPoses = 1.15;  // times the noise: worth a word

std::string mm(double metres) { return fmt::format("{:.3f} mm", metres * 1e3); }

std::string floor_words(const NoiseFloor& floor) {
  if (floor.source == NoiseFloor::Source::kNone) return "noise floor unknown";
  return "noise floor " + mm(floor.mean_m);
}

std::string unknown_words(const Cell& cell, const UnknownStructure& unknown) {
  std::string size = mm(unknown.rms_m);
  if (unknown.rms_rad > 0.0) size = fmt::format("{:.0f} µrad, {}", unknown.rms_rad * 1e6, size);
  std::string out =
      fmt::format("{} {} ({:.0f} % of what the model leaves, {} RMS)", unknown.pattern.subject,
                  unknown.pattern.words, 100.0 * unknown.share, size);
  if (unknown.instead && unknown.instead->possible)
    out += fmt::format("; the {} that imitates it would be {:.0f} times its usual size",
                       in_words(cell, unknown.instead->entry), unknown.instead->times);
  else if (unknown.instead)
    out +=
        fmt::format("; the {} that imitates it would need a sign or a size that its law rules out",
                    in_words(cell, unknown.instead->entry));
  return out;
}

std::string complete_words(const Diagnosis& d, const ErrorStats& held) {
  if (d.floor.source == NoiseFloor::Source::kNone)
    return fmt::format("nothing more is supported by these poses; held-out error {}",
                       mm(held.mean));
  const std::string floor = floor_words(d.floor);
  if (d.full)
    return fmt::format(
        "more is supported, but a model holds no more effects; held-out error {}, {:.1f} times the "
        "{}: a local tree may learn the rest",
        mm(held.mean), held.mean / d.floor.mean_m, floor);
  const std::string out = "nothing more is supported by these poses";
  if (d.left_over && d.left_over->lack_of_fit())
    return fmt::format(
        "{}; but what is left is {:.1f} times the {}: something that these poses do not name. A "
        "local tree may learn it, or more poses may show it",
        out, d.left_over->times, floor);
  if (d.left_over && d.left_over->unavoidable > kFewPoses)
    return fmt::format(
        "{}; held-out error {}, {} (so few poses leave {:.1f} times that even to a "
        "model that is right)",
        out, mm(held.mean), floor, d.left_over->unavoidable);
  return fmt::format("{}; held-out error {}, {}", out, mm(held.mean), floor);
}

/// How a held-out error goes on: it need not fall.
std::string fall_words(double before_m, double after_m) {
  if (mm(after_m) != mm(before_m) && after_m < before_m)
    return fmt::format("the held-out error falls from {} to {}", mm(before_m), mm(after_m));
  return fmt::format("the held-out error does not fall ({} -> {})", mm(before_m), mm(after_m));
}

/// Effects that were added although hardly any arm has them that large.
std::string unlikely_words(const Cell& cell, const Diagnosis& d) {
  std::string out;
  for (const auto& one : d.unlikely)
    out += fmt::format("; supported, but of an unlikely size: {}, {:.0f} times the usual",
                       in_words(cell, one.entry), one.times);
  return out;
}

std::string tie_words(const Cell& cell, const Diagnosis& d) {
  const Candidate& first = d.candidates.front();
  return fmt::format("one of them serves, but these poses cannot tell {} from {}: measure {}",
                     in_words(cell, first.entry, first.cycles), in_words(cell, *d.tied),
                     separating_measurement(first.entry, *d.tied));
}

const double* number_in(const EffectEntry& entry, const char* key) {
  const auto it = entry.options.find(key);
  return it == entry.options.end() ? nullptr : std::get_if<double>(&it->second);
}

std::string step_words(const Cell& cell, const EffectEntry& entry) {
  const auto of = entry.options.find("of");
  const auto* moved = of == entry.options.end() ? nullptr : std::get_if<std::string>(&of->second);
  std::string out = "step";
  if (!entry.joints.empty())
    out += " of the encoder of " + cell.nominal.joints[entry.joints.front()].name;
  else if (moved != nullptr)
    out += " of the " + (*moved == "joint" ? "encoder" : *moved);
  if (const double* row = number_in(entry, "after_row"))
    out += fmt::format(" behind row {:g}", *row);
  return out;
}

}  // namespace

std::string in_words(const Cell& cell, const EffectEntry& entry) {
  if (entry.name == "formula" && entry.options.contains("target"))
    return fmt::format("formula {}", formula_label(formula_text(entry)));
  const int law = find_effect_law(entry.name);
  std::string out = law >= 0 ? effect_info(law).title : entry.name;
  for (std::size_t i = 0; i < entry.joints.size(); ++i)
    out +=
        fmt::format("{}{}", i == 0 ? " of " : " and ", cell.nominal.joints[entry.joints[i]].name);
  if (const double* cycles = number_in(entry, "cycles_per_turn"))
    out += fmt::format(", {:g} cycles a turn", *cycles);
  if (entry.name == "step") out = step_words(cell, entry);
  return out;
}

std::string in_words(const Cell& cell, const EffectEntry& entry,
                     const std::vector<double>& cycles) {
  if (cycles.size() < 2) return in_words(cell, entry);
  EffectEntry plain = entry;
  plain.options.erase("cycles_per_turn");
  std::string out = in_words(cell, plain) + ",";
  const std::size_t shown = std::min(cycles.size(), kWavesShown);
  for (std::size_t i = 0; i < shown; ++i)
    out += fmt::format("{} {:g}",
                       i == 0                                     ? ""
                       : i + 1 == shown && shown == cycles.size() ? " and"
                                                                  : ",",
                       cycles[i]);
  if (shown < cycles.size()) out += fmt::format(" and {} more", cycles.size() - shown);
  return out + " cycles a turn";
}

std::string verdict_text(const Cell& cell, const Diagnosis& d) {
  switch (d.finding) {
    case Finding::kMissing: {
      const Candidate& best = d.candidates.front();
      return fmt::format("Missing: {} (ln Bayes {:.0f}); with it {}, {}.",
                         in_words(cell, best.entry, best.cycles), best.ln_bayes,
                         fall_words(d.before.mean, best.alone.mean), floor_words(d.floor));
    }
    case Finding::kUnknown:
      return fmt::format(
          "Unknown: {}; no effect of the library explains it. Held-out error {}, {}.",
          unknown_words(cell, *d.unknown), mm(d.before.mean), floor_words(d.floor));
    case Finding::kUndecidable:
      if (d.tied)
        return fmt::format(
            "Undecidable: {} and {} explain these poses equally well (ln Bayes {:.0f}); with "
            "either {}, {}. To tell them apart: {}.",
            in_words(cell, d.candidates.front().entry, d.candidates.front().cycles),
            in_words(cell, *d.tied), d.candidates.front().ln_bayes,
            fall_words(d.before.mean, d.candidates.front().alone.mean), floor_words(d.floor),
            separating_measurement(d.candidates.front().entry, *d.tied));
      if (d.floor.source == NoiseFloor::Source::kNone)
        return fmt::format(
            "Undecidable: nothing is supported, but without a noise floor nobody "
            "knows whether {} is good: repeat some poses, or state sigma_um.",
            mm(d.before.mean));
      return fmt::format("Undecidable: {} poses cannot tell what is missing.", d.poses_fit);
    default:
      return "Complete: " + complete_words(d, d.before) + ".";
  }
}

std::string verdict_after_text(const Cell& cell, const Diagnosis& d) {
  if (!d.finding_after) return {};
  const std::string fall = d.added.empty()
                               ? "Nothing was added"
                               : fmt::format("{} {} added: held-out error {} -> {}", d.added.size(),
                                             d.added.size() == 1 ? "effect" : "effects",
                                             mm(d.before.mean), mm(d.after.mean));
  switch (*d.finding_after) {
    case Finding::kUnknown:
      return fmt::format("{}; {}: {}.", fall,
                         d.unknown_after->instead ? "but something unknown is behind it"
                                                  : "unknown structure is left",
                         unknown_words(cell, *d.unknown_after));
    case Finding::kUndecidable:
      if (d.tied && !d.added.empty()) return fmt::format("{}; {}.", fall, tie_words(cell, d));
      return fall + "; what is left cannot be judged without a noise floor.";
    default:
      return fmt::format("{}; {}{}.", fall, complete_words(d, d.after), unlikely_words(cell, d));
  }
}

}  // namespace plumb::offline
