// SPDX-License-Identifier: Apache-2.0
#include "show/recheck_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "effects/registry.hpp"
#include "fit/verdict.hpp"
#include "noise/orientation_floor.hpp"
#include "program/counted_words.hpp"
#include "recheck/constants.hpp"
#include "show/heads.hpp"
#include "show/parameter_unit.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

using recheck::Alternative;
using recheck::FoundChange;
using recheck::Recheck;
using recheck::RecheckPlan;
using recheck::Visibility;

const std::string& changed_joint(const Cell& cell, const recheck::Change& change) {
  return cell.nominal.joints[static_cast<std::size_t>(change.joint)].name;
}

std::string signed_number(double si, const ParameterUnit& unit) {
  return (si >= 0.0 ? "+" : "") + unit.text(si);
}

/// What happened to a part, as a sentence without its full stop.
std::string what_happened(const Cell& cell, const FoundChange& found) {
  const recheck::Change& change = found.change;
  const std::string motion = mm(found.motion_m);
  if (change.part == recheck::Part::kTool)
    return fmt::format("the tool or the reflector moved: {} mm at the measured point", motion);
  if (change.part == recheck::Part::kBase)
    return fmt::format("the base or the tracker moved: {} mm at the measured point (RMS)", motion);
  const std::string& joint = changed_joint(cell, change);
  const Estimate &was = found.before.front(), &now = found.after.front();
  const ParameterUnit unit = unit_of(now);
  if (change.effect == "offset")
    return fmt::format("the encoder offset of {} changed by {} {}", joint,
                       signed_number(now.value - was.value, unit), unit.name);
  if (const EffectDescriptor* effect = find_descriptor(change.effect))
    return fmt::format(fmt::runtime(effect->later_change->sentence), joint, unit.text(was.value),
                       unit.text(now.value), unit.name);
  return fmt::format("the link behind {} is bent: {} mm at the measured point (RMS)", joint,
                     motion);
}

/// Explanations that the readings leave open, in words; those that matter first.
std::vector<std::string> open_words(const Cell& cell, const FoundChange& found) {
  std::vector<std::string> out;
  for (const Alternative& a : found.alternatives)
    if (a.behind_nats < recheck::kUndecided) out.push_back(words_of(a.change, cell));
  return out;
}

std::string poses_words(const Recheck& found) {
  const std::string poses = counted_words(found.poses, "pose", "poses");
  return found.poses == found.readings ? poses
                                       : fmt::format("{} readings of {}", found.readings, poses);
}

/// Whether the calibration kept the tolerance when it was made, as far as that is known.
bool kept_tolerance(const Cell& cell, const Recheck& found) {
  return found.then.n == 0 || keeps(found.then, cell.tolerance_m);
}

/// "true" means as good as it was, which need not be good enough.
std::string true_sentence(const Cell& cell, const Recheck& found, const Run& run) {
  const std::string head =
      kept_tolerance(cell, found)
          ? "Still true:"
          : fmt::format("Nothing has changed, but run {} never kept the tolerance of {} mm:",
                        run.number, mm(cell.tolerance_m));
  return fmt::format(
      "{} run {} predicts {} with a mean error of {} mm, of which {} mm were to be expected.", head,
      run.number, poses_words(found), mm(found.before.mean), mm(found.expected_m));
}

/// What orientations show that positions do not.
std::string turned_words(const recheck::TurnCheck& turns) {
  if (turns.is_constant)
    return fmt::format(
        "the reflector or the last joint turned by {}, which only the measured orientations show",
        angle_words(turns.constant_rad));
  return fmt::format(
      "something turns the tool, orientations are missed by {} where the calibration missed them "
      "by {}",
      angle_words(turns.now.mean), angle_words(turns.then.mean));
}

std::string changed_sentence(const Cell& cell, const Recheck& found, const Run& run) {
  std::vector<std::string> parts;
  for (const auto& one : found.found) parts.push_back(what_happened(cell, one));
  if (found.something_else)
    parts.push_back(parts.empty()
                        ? fmt::format("no single part explains the readings, which are missed by "
                                      "{:.1f} times what is expected",
                                      found.excess)
                        : "and something else, which no single part explains");
  if (found.turns.turned()) parts.push_back(turned_words(found.turns));
  std::string out = fmt::format("Changed since run {}: {}. Mean error {} mm", run.number,
                                fmt::join(parts, "; "), mm(found.before.mean));
  return out + (found.found.empty()
                    ? "."
                    : fmt::format(", {} mm after refitting it.", mm(found.after.mean)));
}

std::string undecidable_sentence(const Cell& cell, const Recheck& found, const Run& run) {
  if (found.only_elsewhere)
    return fmt::format(
        "{} {} cannot tell: run {} misses them by {} mm (mean), but {} lie where its calibration "
        "had no pose nearby, so the model may always have missed there by as much.",
        found.readings == 1 ? "This" : "These", poses_words(found), run.number,
        mm(found.before.mean),
        found.elsewhere == found.readings
            ? "they"
            : fmt::format("{} of the {} readings", found.elsewhere, found.readings));
  if (found.found.empty())
    return fmt::format(
        "{} {} cannot tell: nothing contradicts run {}, but they would not show {} before it "
        "moves the measured point by {} mm.",
        found.readings == 1 ? "This" : "These", poses_words(found), run.number,
        words_of(found.blind.front().change, cell), mm(found.blind.front().unseen_m));
  const auto open_one = std::find_if(found.found.begin(), found.found.end(), recheck::undecided);
  std::vector<std::string> open{words_of(open_one->change, cell)}, known;
  for (const auto& words : open_words(cell, *open_one)) open.push_back(words);
  for (const auto& one : found.found)
    if (!recheck::undecided(one)) known.push_back(what_happened(cell, one));
  constexpr std::size_t kNamed = 4;
  const std::size_t more = open.size() > kNamed ? open.size() - kNamed : 0;
  open.resize(std::min(open.size(), kNamed));
  return fmt::format(
      "{} changed since run {} (mean error {} mm), but {} {} cannot tell what: {}{}.{}",
      known.empty() ? "Something" : "Something more", run.number, mm(found.before.mean),
      found.readings == 1 ? "this" : "these", poses_words(found), fmt::join(open, ", or "),
      more == 0   ? ""
      : more == 1 ? ", or another one"
                  : fmt::format(", or one of {} others", more),
      known.empty() ? "" : fmt::format(" Refitted: {}.", fmt::join(known, "; ")));
}

Table recheck_errors_table(const Recheck& found, const Run& run) {
  Table table{.name = "errors",
              .caption = "Position errors, measured - predicted [mm]",
              .head = {head::kPositionError, head::kReadings, head::kMean, head::kRms, head::kP95,
                       head::kMax}};
  const auto row = [&](const std::string& name, const ErrorStats& s) {
    table.add({name, fmt::format("{}", s.n), mm(s.mean), mm(s.rms), mm(s.p95), mm(s.max)});
  };
  row(fmt::format("held-out, run {} when it was made", run.number), found.then);
  row(fmt::format("now, by run {} as it is", run.number), found.before);
  if (!found.found.empty()) row("now, refitted without the reading", found.after);
  return table;
}

Table turns_table(const recheck::TurnCheck& turns, const Run& run) {
  Table table{
      .name = "orientations",
      .caption = "Orientation errors, measured - predicted [deg]",
      .head = {"orientation error [deg]", head::kReadings, head::kMean, head::kP95, head::kMax}};
  if (!turns.judged()) return table;
  const auto row = [&](const std::string& name, const ErrorStats& s) {
    table.add({name, fmt::format("{}", s.n), deg(s.mean), deg(s.p95), deg(s.max)});
  };
  row(fmt::format("held-out, run {} when it was made", run.number), turns.then);
  row("now, after what was found", turns.now);
  return table;
}

Table changed_numbers_table(const Recheck& found) {
  Table table{.name = "changed",
              .caption = "Numbers that have changed",
              .head = {head::kChange, "ln Bayes", head::kParameter, "was", "is", head::kSigma, ""}};
  table.left_from = 6;
  for (const auto& one : found.found)
    for (std::size_t k = 0; k < one.after.size(); ++k) {
      const Estimate &was = one.before[k], &now = one.after[k];
      const ParameterUnit unit = unit_of(now);
      table.add({k == 0 ? std::string(name_of(one.change.part)) : "",
                 k == 0 ? fmt::format("{:.0f}", one.ln_bayes) : "", now.name, unit.text(was.value),
                 unit.text(now.value), unit.text(now.std), unit.name});
    }
  return table;
}

Table blind_table(const Cell& cell, const std::vector<Visibility>& blind) {
  Table table{.name = "not_shown",
              .caption = "These poses do not show, until it moves the measured point by so much:",
              .captioned = true,
              .head = {"change", "from"},
              .as_lines = true};
  for (const auto& v : blind) table.add({words_of(v.change, cell), mm(v.unseen_m) + " mm"});
  return table;
}

Json changed_part_json(const Cell& cell, const recheck::Change& change) {
  Json out{{"part", name_of(change.part)}};
  if (change.part == recheck::Part::kJoint)
    out["joint"] = changed_joint(cell, change);
  else
    put_null(out, "joint", "it is no joint");
  out["effect"] = change.effect;
  return out;
}

Json found_json(const Cell& cell, const FoundChange& found) {
  Json out = changed_part_json(cell, found.change);
  put(out, "ln_bayes", found.ln_bayes);
  put(out, "motion_rms_mm", to_mm(found.motion_m));
  out["words"] = what_happened(cell, found);
  out["parameters"] = Json::array();
  for (std::size_t k = 0; k < found.after.size(); ++k) {
    const Estimate &was = found.before[k], &now = found.after[k];
    const ParameterUnit unit = unit_of(now);
    Json row{{"name", now.name}, {"unit", unit.name}};
    put(row, "value", now.value * unit.per_si);
    put(row, "std", now.std * unit.per_si);
    put(row, "change", (now.value - was.value) * unit.per_si);
    out["parameters"].push_back(std::move(row));
  }
  return out;
}

Json visible_json(const Cell& cell, const std::vector<Visibility>& all) {
  Json out = Json::array();
  for (const auto& v : all) {
    Json row = changed_part_json(cell, v.change);
    put(row, "from_mm", to_mm(v.unseen_m));
    out.push_back(std::move(row));
  }
  return out;
}

Column circumstance(const std::string& name, const std::string& unit, Quantity quantity,
                    const Eigen::VectorXd& values) {
  return {.header = unit.empty() ? name : name + "_" + unit,
          .name = name,
          .unit = unit,
          .quantity = quantity,
          .values = {values.begin(), values.end()},
          .text = {}};
}

/// How each joint arrived, and the load, where the calibration's file says it of every pose.
std::vector<Column> circumstances_of(const Cell& cell, const ContextRows& rows) {
  std::vector<Column> out;
  const auto add = [&](const std::string& name, const std::string& unit, Quantity quantity,
                       const RowsN& values, int column_of) {
    if (column_of >= values.cols() || values.rows() == 0) return;
    if (!values.col(column_of).allFinite()) return;
    out.push_back(circumstance(name, unit, quantity, values.col(column_of)));
  };
  for (int j = 0; j < cell.joints(); ++j) {
    const bool slide = slides(cell.nominal.joints[static_cast<std::size_t>(j)]);
    add(fmt::format("dir_j{}", j + 1), "", Quantity::kNumber, rows.direction, j);
    add(fmt::format("travel_j{}", j + 1), unit(slide), slide ? Quantity::kLength : Quantity::kAngle,
        rows.travel, j);
  }
  add("payload", "kg", Quantity::kMass, rows.payload, 0);
  return out;
}

}  // namespace

std::string recheck_sentence(const Cell& cell, const Recheck& found, const Run& run) {
  switch (found.verdict) {
    case Recheck::Verdict::kTrue:
      return true_sentence(cell, found, run);
    case Recheck::Verdict::kChanged:
      return changed_sentence(cell, found, run);
    case Recheck::Verdict::kUndecidable:
      break;
  }
  return undecidable_sentence(cell, found, run);
}

const char* class_of(const Cell& cell, const Recheck& found) {
  if (found.verdict == Recheck::Verdict::kChanged) return name_of(Grade::kBad);
  const bool good = found.verdict == Recheck::Verdict::kTrue && kept_tolerance(cell, found);
  return name_of(good ? Grade::kGood : Grade::kPartly);
}

Json recheck_json(const Cell& cell, const Recheck& found, const Run& run) {
  Json out{{"verdict", name_of(found.verdict)},
           {"verdict_text", recheck_sentence(cell, found, run)},
           {"verdict_class", class_of(cell, found)},
           {"readings", found.readings},
           {"poses", found.poses},
           {"elsewhere", found.elsewhere}};
  out["changed"] = Json::array();
  for (const auto& one : found.found) out["changed"].push_back(found_json(cell, one));
  if (found.something_else)
    out["changed"].push_back({{"part", "other"},
                              {"joint", nullptr},
                              {"joint_reason", "no single part explains the readings"},
                              {"effect", ""},
                              {"ln_bayes", nullptr},
                              {"ln_bayes_reason", "it is what is left, not a model"},
                              {"excess", found.excess},
                              {"parameters", Json::array()}});
  out["alternatives"] = Json::array();
  for (const auto& one : found.found)
    for (const auto& a : one.alternatives) {
      Json row = changed_part_json(cell, a.change);
      put(row, "behind_nats", a.behind_nats);
      row["instead_of"] = changed_part_json(cell, one.change);
      out["alternatives"].push_back(std::move(row));
    }
  out["then"] = stats_json(found.then);
  out["before"] = stats_json(found.before);
  out["after"] = stats_json(found.after);
  put(out, "expected_mean_mm", to_mm(found.expected_m));
  if (found.turns.judged())
    out["orientation"] = {{"then_mean_deg", to_deg(found.turns.then.mean)},
                          {"mean_deg", to_deg(found.turns.now.mean)},
                          {"turned", found.turns.turned()},
                          {"is_constant", found.turns.is_constant}};
  out["odd_readings"] = Json::array();
  for (const int row : found.odd_readings) out["odd_readings"].push_back(row + 1);
  out["not_shown"] = visible_json(cell, found.blind);
  out["false_alarm_pct"] = 100.0 * recheck::kFalseAlarm;
  out["parent_run"] = run.number;
  return out;
}

Blocks recheck_blocks(const Cell& cell, const Recheck& found, const Run& run) {
  Blocks out{Sentence{recheck_sentence(cell, found, run), class_of(cell, found)},
             recheck_errors_table(found, run), turns_table(found.turns, run),
             changed_numbers_table(found)};
  for (const auto& one : found.found)
    if (const auto open = open_words(cell, one);
        !open.empty() && found.verdict == Recheck::Verdict::kChanged)
      out.emplace_back(Note{
          fmt::format("Not ruled out instead of {}: {}. The measured point moves alike either way.",
                      words_of(one.change, cell), fmt::join(open, ", "))});
  out.emplace_back(blind_table(cell, found.blind));
  out.emplace_back(Note{fmt::format(
      "A check like this finds a change where there is none in at most {:.0f} of 100 cases.",
      100.0 * recheck::kFalseAlarm)});
  return out;
}

Json recheck_plan_json(const Cell& cell, const RecheckPlan& plan, const Run& run,
                       const Measurements& own) {
  Json out{{"n", plan.rows.size()}, {"recheck_of", run.number}};
  out["shows"] = visible_json(cell, plan.visible);
  out["poses"] = Json::array();
  for (const int row : plan.rows) {
    Json pose{{"pose", own.pose[static_cast<std::size_t>(row)]}};
    const auto angles = own.q.row(row);
    const auto q =
        values_at({angles.data(), static_cast<std::size_t>(angles.size())}, cell.nominal);
    for (int j = 0; j < cell.joints(); ++j) {
      const bool slide = slides(cell.nominal.joints[static_cast<std::size_t>(j)]);
      pose[fmt::format("q{}_{}", j + 1, unit(slide))] =
          shown(q[static_cast<std::size_t>(j)], slide);
    }
    out["poses"].push_back(std::move(pose));
  }
  return out;
}

Blocks recheck_plan_blocks(const Cell& cell, const RecheckPlan& plan, const Run& run) {
  Table table{.name = "shows",
              .caption = "Changes that these poses show",
              .head = {"change that they show", "from [mm]"}};
  for (const auto& v : plan.visible) table.add({words_of(v.change, cell), mm(v.unseen_m)});
  return {Sentence{fmt::format("Planned {} best what has changed since run {}.",
                               counted_words(plan.rows.size(), "pose to measure again, which tells",
                                             "poses to measure again, which tell"),
                               run.number)},
          Sentence{"The second column is the motion of the measured point (RMS) from which on a "
                   "change is found nearly always."},
          std::move(table)};
}

std::string recheck_plan_csv(const Cell& cell, const RecheckPlan& plan, const Measurements& own) {
  Measurements poses = pick(own, plan.rows);
  poses.has_axis = {false, false, false};
  poses.quat_M.resize(0, 4);
  poses.sigma_m.resize(0, 3);
  poses.nominal_B.resize(0, 3);
  std::fill(poses.set.begin(), poses.set.end(), SetMark::kUnmarked);
  return write_measurements(poses, cell.nominal,
                            {{"plan", "recheck: measure these poses of the calibration again"}},
                            circumstances_of(cell, poses.context));
}

}  // namespace plumb::offline::show
