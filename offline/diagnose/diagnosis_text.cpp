// SPDX-License-Identifier: Apache-2.0
#include "diagnose/diagnosis_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/artefacts.hpp"
#include "cell/effects_edit.hpp"
#include "cell/formula_reader.hpp"
#include "diagnose/alternatives.hpp"
#include "diagnose/certainty.hpp"
#include "diagnose/confounding.hpp"
#include "diagnose/constants.hpp"
#include "diagnose/effect_domain.hpp"
#include "diagnose/effect_sentence.hpp"
#include "diagnose/effect_words.hpp"
#include "diagnose/few_digits.hpp"
#include "diagnose/left_beside.hpp"
#include "diagnose/other_gravity.hpp"
#include "diagnose/scan.hpp"
#include "effects/registry.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kAlternativesShown = 3;

std::string mm(double metres) { return digits_mm(metres) + " mm"; }

/// ", orientations 0.0110 deg -> 0.0020 deg", from the start to `then`; empty where none are
/// fitted.
std::string turns_fall(const Diagnosis& d, ErrorStats FoundTurns::*then) {
  if (!d.turns) return {};
  return fmt::format(", orientations {} -> {}", angle_words(d.turns->before.mean),
                     angle_words((*d.turns.*then).mean));
}

/// What the joints scatter, as a sentence of its own; empty: nothing is seen of it.
std::string repeatability_words(const Cell& cell, const Diagnosis& d) {
  if (!d.repeatability.supported()) return "";
  const std::string scatter = in_words(cell, d.repeatability);
  if (!(d.floor.inferred_m > 0.0))
    return fmt::format(" Repeatability of the joints: {} (1 sigma).", scatter);
  return fmt::format(
      " Repeatability of the joints, inferred from what the model leaves: {} (1 sigma), which "
      "would "
      "make an error of {}; to measure it, repeat some poses, each approached anew.",
      scatter, mm(d.floor.inferred_m));
}

enum class Held { kSay, kSaid };

/// @param said  Whether the held-out error stands in the same sentence already.
std::string complete_words(const Diagnosis& d, const ErrorStats& held, Held said) {
  const std::string error =
      said == Held::kSay ? fmt::format("held-out error {}, ", mm(held.mean)) : "";
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
  if (d.held_out_excess && d.held_out_excess->lack_of_fit())
    return fmt::format(
        "{}; but what is left is {:.1f} times the {}: something that these poses do not name. A "
        "local tree may learn it, or more poses may show it",
        out, d.held_out_excess->times, floor);
  if (turned(d))
    return fmt::format(
        "{}; {}{}; but {}: something turns the tool that these poses do not name, or "
        "the orientations have errors that repeats do not show",
        out, error, floor, missed_words(d.turns->after.mean, d.turns->floor));
  if (d.held_out_excess && d.held_out_excess->few_poses())
    return fmt::format(
        "{}; {}{} (so few poses leave up to {:.1f} times that even "
        "to a model that is right)",
        out, error, floor, d.held_out_excess->unavoidable);
  return fmt::format("{}; {}{}", out, error, floor);
}

/// What an effect does to the error of poses that it has not seen: it need not fall.
std::string fall_words(double before_m, double after_m) {
  if (falls(before_m, after_m))
    return fmt::format("{} -> {} on unseen poses", digits_mm(before_m), mm(after_m));
  return fmt::format("the error on unseen poses does not fall ({} -> {})", mm(before_m),
                     mm(after_m));
}

/// The same of the first candidate, with what it does to orientations.
std::string fall_words(const Diagnosis& d, const Candidate& c) {
  if (!d.turns || !helps(d, c)) return fall_words(d.before.mean, c.alone.mean);
  return fmt::format("{} -> {} on unseen poses, orientations {} -> {}", digits_mm(d.before.mean),
                     mm(c.alone.mean), angle_words(d.turns->before.mean),
                     angle_words(c.alone_turns.mean));
}

/// ", or a law that these poses cannot show: bending of links (link_flexure:J2) (no mass is
/// stated)".
std::string not_shown_words(const Cell& cell, const std::vector<Alternative>& others) {
  std::string out;
  for (std::size_t i = 0; i < others.size(); ++i) {
    const std::string law = in_words(cell, others[i].entry, others[i].cycles);
    const bool goes_on = i > 0 && others[i].not_shown == others[i - 1].not_shown;
    out += fmt::format("{}{}", goes_on ? " or " : ", or a law that these poses cannot show: ", law);
    if (i + 1 == others.size() || others[i].not_shown != others[i + 1].not_shown)
      out += fmt::format(" ({})", others[i].not_shown);
  }
  return out;
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
  return out + not_shown_words(cell, unknown.alternatives);
}

/// "J2 yields under load, or the error of J3 repeats once and twice a turn": an effect and what it
/// may be instead.
std::string either_words(const Cell& cell, const std::string& first,
                         const std::vector<Alternative>& others) {
  std::string out = first;
  const std::size_t shown = std::min(others.size(), kAlternativesShown);
  std::vector<Alternative> not_shown;
  for (std::size_t i = 0; i < shown; ++i)
    if (others[i].not_shown.empty())
      out += ", or " + effect_sentence(cell, others[i].entry, others[i].cycles);
    else
      not_shown.push_back(others[i]);
  out += not_shown_words(cell, not_shown);
  if (others.size() == shown + 1) out += ", or another one (--json)";
  if (others.size() > shown + 1)
    out += fmt::format(", or one of {} others (--json)", others.size() - shown);
  return out;
}

/// What to measure so that an effect can be told from what it may be instead.
std::string telling_words(const Cell& cell, const EffectEntry& first,
                          const std::vector<Alternative>& others) {
  std::string out;
  for (const auto& other : others) {
    if (!other.not_shown.empty()) continue;
    out = "To tell them apart: " + separating_measurement(first, other.entry);
    if (!has_artefacts(cell.measurement))
      out += fmt::format(" (plumb plan --separate {},{})", planning_argument(cell, first),
                         planning_argument(cell, other.entry));
    out += ".";
    break;
  }
  for (const auto& other : others) {
    if (other.not_shown.empty() || other.measure.empty()) continue;
    out += fmt::format("{}To show {}: {}.", out.empty() ? "" : " ", title_of(other.entry.name),
                       other.measure);
    break;
  }
  return out;
}

/// "joint 3 moves with time, as no law of the library does (61 % of what the model leaves, ...)".
std::string slow_words(const Cell& cell, const UnknownStructure& slow) {
  return unknown_words(cell, slow) + ", which no law of the library describes";
}

constexpr const char* kTellsStepFromSlowMotion =
    "To tell a step from a slow motion: measure a few poses again and again through one session, "
    "also when the arm is cold.";

/// The step that was added in the place of the first candidate, beside others: with other moves.
const Addition* moved_otherwise(const Cell& cell, const Diagnosis& d) {
  const Candidate& best = d.candidates.front();
  if (best.moves.empty()) return nullptr;
  for (const Addition& added : d.added)
    if (key_of(cell, added.entry) == key_of(cell, best.entry) &&
        added.moves.size() != best.moves.size())
      return &added;
  return nullptr;
}

/// Why effects that were added may be parts of something else.
std::string part_words(PartOf part, bool several) {
  const char* const so = several ? "they may be parts" : "it may be a part";
  return part == PartOf::kLargerRest
             ? fmt::format("more is left than {} explains, so that {} of another cause",
                           several ? "each of them" : "it", so)
             : fmt::format("unknown structure is left at the same joint, so that {} of that", so);
}

/// The effects that were added and may be parts of something else, by the reason.
std::string parts_words(const Cell& cell, const Diagnosis& d) {
  std::string out;
  for (const PartOf part : {PartOf::kLargerRest, PartOf::kRestOfItsJoint}) {
    std::vector<std::string> names;
    for (const auto& added : d.added)
      if (part_of(d, added) == part) names.push_back(in_words(cell, added.entry, added.cycles));
    if (!names.empty())
      out += fmt::format("; {}: {}", fmt::join(names, ", "), part_words(part, names.size() > 1));
  }
  return out;
}

std::string sure_words(const Cell& cell, const Diagnosis& d) {
  const Candidate& best = d.candidates.front();
  if (const Addition* added = moved_otherwise(cell, d))
    return fmt::format("Beside the other effects that were added, only this is left of it: {}.",
                       effect_sentence(cell, *added));
  if (d.slow_motion) return kTellsStepFromSlowMotion;
  if (!d.alternatives.empty()) return telling_words(cell, best.entry, d.alternatives);
  if (explains_little(d))
    return fmt::format(
        "It explains {:.0f} % of the error only: most of it has another cause, and "
        "what that leaves may be mistaken for this.",
        100.0 * (1.0 - best.alone.mean / d.before.mean));
  if (const PartOf part = part_of_first(d); part != PartOf::kNothing)
    return fmt::format("Doubtful, though these poses speak for it: {}.", part_words(part, false));
  const Candidate* const rival = near_rival(cell, d);
  const double ahead = nats_ahead(cell, d);
  std::string out = ahead >= kCertain_nats      ? "Certain"
                    : ahead >= kVeryLikely_nats ? "Very likely"
                                                : "Likely";
  if (!best.plausible) out += ", but of an unlikely size: something else may be behind it";
  if (rival != nullptr)
    out += fmt::format("{} these poses hardly tell it from {}", best.plausible ? ", but" : ";",
                       in_words(cell, *rival));
  return out + ".";
}

std::string missing_words(const Cell& cell, const Diagnosis& d) {
  const Candidate& best = d.candidates.front();
  const std::string peaks = best.peaks.empty() ? "" : ", " + best.peaks;
  std::string effect = either_words(cell, effect_sentence(cell, best) + peaks, d.alternatives);
  if (d.slow_motion) effect += ", or " + slow_words(cell, *d.slow_motion);
  if (may_be_another(d)) effect += ": these poses cannot tell";
  if (!helps(d, best))
    return fmt::format(
        "Doubtful: perhaps {}. The fitted poses speak for it, but {}, {}. More poses would tell.",
        effect, fall_words(d.before.mean, best.alone.mean), floor_words(d.floor));
  if (d.refused)
    return fmt::format(
        "Undecidable: perhaps {}. The fitted poses speak for it, but chosen anew without some of "
        "them it does not predict these better: {} -> {} on average, {} -> {} RMS{}, {}. More "
        "poses would tell.",
        effect, digits_mm(d.before.mean), mm(d.refused->mean), digits_mm(d.before.rms),
        mm(d.refused->rms), turns_fall(d, &FoundTurns::refused), floor_words(d.floor));
  const bool undecidable = d.finding == Finding::kUndecidable;
  return fmt::format("{}: {}. Adding {}: {}, {}. {}",
                     undecidable                                                  ? "Undecidable"
                     : explains_little(d) || part_of_first(d) != PartOf::kNothing ? "Perhaps"
                                                                                  : "Missing",
                     effect, may_be_another(d) ? "the first" : "it", fall_words(d, best),
                     floor_words(d.floor), sure_words(cell, d));
}

/// Effects that were added, but may be something else.
std::string unsure_words(const Cell& cell, const Diagnosis& d) {
  std::string out;
  for (const auto& added : d.added) {
    if (added.alternatives.empty()) continue;
    out += fmt::format("; {}: these poses cannot tell",
                       either_words(cell, effect_sentence(cell, added), added.alternatives));
    if (!names_what_is_not_shown(added.alternatives)) out += ", and predict as well with either";
  }
  return out + parts_words(cell, d);
}

/// Why an effect was not added, though it is supported: "joint compliance (joint_compliance:J2) is
/// supported, but it may be drift (drift) instead ...".
std::string undecided_words(const Cell& cell, const Undecided& u) {
  if (u.slow_motion)
    return fmt::format(
        "{} is supported, but it may be instead that {}: these poses cannot tell. {}",
        in_words(cell, u.entry, u.cycles), slow_words(cell, *u.slow_motion),
        kTellsStepFromSlowMotion);
  const auto other =
      std::find_if(u.alternatives.begin(), u.alternatives.end(),
                   [&](const Alternative& a) { return a.compiled != is_compiled(u.entry); });
  if (other == u.alternatives.end()) return {};
  return fmt::format(
      "{} is supported, but it may be {} instead, and these poses cannot tell: one is an error of "
      "the arm, which is compiled, the other one of the measurement, which is not. {}",
      in_words(cell, u.entry, u.cycles), in_words(cell, other->entry, other->cycles),
      telling_words(cell, u.entry, {*other}));
}

/// Effects that were added although hardly any arm has them that large.
std::string unlikely_words(const Cell& cell, const Diagnosis& d) {
  std::string out;
  for (const auto& one : d.unlikely)
    out += fmt::format("; supported, but of an unlikely size: {}, {:.0f} times the usual one",
                       in_words(cell, one.entry), one.times);
  return out;
}

std::string tie_words(const Cell& cell, const Diagnosis& d) {
  const Candidate& first = d.candidates.front();
  return fmt::format("one of them serves, but these poses cannot tell {} from {}: measure {}",
                     in_words(cell, first), in_words(cell, *d.tied),
                     separating_measurement(first.entry, *d.tied));
}

std::string finding_text(const Cell& cell, const Diagnosis& d) {
  switch (d.finding) {
    case Finding::kMissing:
      return missing_words(cell, d);
    case Finding::kUnknown:
      return fmt::format(
          "Unknown: {}; no effect of the library explains it{}. Held-out error {}, {}.",
          unknown_words(cell, *d.unknown),
          d.unknown->alternatives.empty() ? "" : " under the loads that cell.toml states",
          mm(d.before.mean), floor_words(d.floor));
    case Finding::kUndecidable:
      if (!d.tied && (may_be_another(d) || d.refused || (d.gravity && !d.candidates.empty())))
        return missing_words(cell, d);
      if (d.tied)
        return fmt::format(
            "Undecidable: {}, or {} ({} or {}): they explain these poses equally well. With "
            "either: {}, {}. To tell them apart, measure {}.",
            effect_sentence(cell, d.candidates.front()), effect_sentence(cell, *d.tied, {}),
            in_words(cell, d.candidates.front()), in_words(cell, *d.tied),
            fall_words(d, d.candidates.front()), floor_words(d.floor),
            separating_measurement(d.candidates.front().entry, *d.tied));
      if (d.floor.source == NoiseFloor::Source::kNone)
        return fmt::format(
            "Undecidable: nothing is supported, but without a noise floor nobody "
            "knows whether {} is good: repeat some poses, or state sigma_um.",
            mm(d.before.mean));
      if ((d.held_out_excess && d.held_out_excess->lack_of_fit()) || turned(d))
        return "Undecidable: " + complete_words(d, d.before, Held::kSay) + "." +
               repeatability_words(cell, d);
      return fmt::format("Undecidable: {} cannot tell what is missing.",
                         counted_words(d.poses_fit, "pose", "poses"));
    default:
      return "Complete: " + complete_words(d, d.before, Held::kSay) + "." +
             repeatability_words(cell, d);
  }
}

}  // namespace

std::string gravity_text(const std::array<double, 3>& g) {
  const auto plain = [](double x) { return x == 0.0 ? 0.0 : x; };  // no -0
  return fmt::format("[{:g}, {:g}, {:g}]", plain(g[0]), plain(g[1]), plain(g[2]));
}

std::string verdict_text(const Cell& cell, const Diagnosis& d) {
  const std::string found = finding_text(cell, d);
  if (!d.gravity) return found;
  const std::string along = gravity_text(d.gravity->found);
  if (!d.gravity->certain)
    return fmt::format(
        "{} Or gravity acts along {} in the base frame, not along {} as cell.toml says ({}): these "
        "poses cannot tell; look how the arm stands.",
        found, along, gravity_text(d.gravity->stated), standing_words(d.gravity->found));
  return fmt::format(
      "Gravity acts along {} in the base frame, not along {} as cell.toml says: {}. Set gravity = "
      "{} in [robot], if it stands so, and diagnose again. With that: {}",
      along, gravity_text(d.gravity->stated), standing_words(d.gravity->found), along, found);
}

std::string verdict_after_text(const Cell& cell, const Diagnosis& d) {
  if (!d.finding_after) return {};
  if (d.gravity && d.gravity->certain)
    return fmt::format(
        "Nothing was added: under gravity = {} it would be another effect. Correct "
        "gravity in cell.toml first.",
        gravity_text(d.gravity->stated));
  const std::string fall =
      d.added.empty()
          ? "Nothing was added"
          : fmt::format("{} added: held-out error {} -> {}{}",
                        counted_words(d.added.size(), "effect", "effects"), mm(d.before.mean),
                        mm(d.after.mean), turns_fall(d, &FoundTurns::after));
  switch (*d.finding_after) {
    case Finding::kUnknown:
      return fmt::format("{}{}; {}: {}.", fall, unsure_words(cell, d),
                         d.unknown_after->instead ? "but something unknown is behind it"
                                                  : "unknown structure is left",
                         unknown_words(cell, *d.unknown_after));
    case Finding::kUndecidable:
      if (d.undecided)
        return fmt::format("{}{}; {}", fall, unsure_words(cell, d),
                           undecided_words(cell, *d.undecided));
      if (d.tied && !d.added.empty()) return fmt::format("{}; {}.", fall, tie_words(cell, d));
      if (d.floor.source == NoiseFloor::Source::kNone)
        return fmt::format("{}{}; what is left cannot be judged without a noise floor.", fall,
                           unsure_words(cell, d));
      break;
    default:
      break;
  }
  return fmt::format("{}{}; {}{}.{}", fall, unsure_words(cell, d),
                     complete_words(d, d.after, d.added.empty() ? Held::kSay : Held::kSaid),
                     unlikely_words(cell, d), repeatability_words(cell, d));
}

}  // namespace plumb::offline
