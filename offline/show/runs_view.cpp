// SPDX-License-Identifier: Apache-2.0
#include "show/runs_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/verdict.hpp"
#include "program/counted_words.hpp"
#include "show/counted.hpp"
#include "show/heads.hpp"
#include "show/parameter_unit.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

/// A parameter of either run; NaN where that run did not fit it.
struct Change {
  std::string name;
  ParameterUnit unit;
  double a = NAN, b = NAN, std = NAN;
};

const Estimate* find(const Run& run, const std::string& name) {
  const auto& all = run.fit.calibration.estimates;
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const Estimate& e) { return e.name == name; });
  return it == all.end() ? nullptr : &*it;
}

std::vector<Change> changes(const Run& a, const Run& b) {
  std::vector<Change> out;
  for (const auto& e : a.fit.calibration.estimates) {
    if (!e.of_robot) continue;
    const Estimate* other = find(b, e.name);
    if (other && other->value == e.value) continue;
    out.push_back({e.name, unit_of(e), e.value, other ? other->value : NAN,
                   other ? std::hypot(e.std, other->std) : e.std});
  }
  for (const auto& e : b.fit.calibration.estimates)
    if (e.of_robot && find(a, e.name) == nullptr)
      out.push_back({e.name, unit_of(e), NAN, e.value, e.std});
  return out;
}

std::vector<std::string> only_in(const std::vector<std::string>& these,
                                 const std::vector<std::string>& those) {
  std::vector<std::string> out;
  for (const auto& name : these)
    if (std::find(those.begin(), those.end(), name) == those.end()) out.push_back(name);
  return out;
}

Json change_json(const Change& c) {
  constexpr const char* kNotFitted = "not fitted in that run";
  Json out{{"name", c.name}, {"unit", c.unit.name}};
  put(out, "a", c.a * c.unit.per_si, kNotFitted);
  put(out, "b", c.b * c.unit.per_si, kNotFitted);
  put(out, "change", (c.b - c.a) * c.unit.per_si, "fitted in one run only");
  put(out, "std", c.std * c.unit.per_si);
  return out;
}

std::string number(double si, const ParameterUnit& unit, const char* sign) {
  if (!std::isfinite(si)) return "-";
  return (si >= 0 ? sign : "") + unit.text(si);
}

bool same_held_out(const Run& a, const Run& b) {
  return a.inputs == b.inputs && a.fit.split.held == b.fit.split.held &&
         a.fit.split.fold == b.fit.split.fold;
}

std::string verdict_of(const Run& a, const Run& b) {
  if (a.fit.held.n == 0 || b.fit.held.n == 0)
    return "One of the runs has no held-out poses: their accuracy cannot be compared.";
  const double before = usual_held(a.fit).mean, after = usual_held(b.fit).mean;
  return fmt::format(
      "Held-out mean {} -> {} mm from run {} to run {} ({:+.1f} %){}.", mm(before), mm(after),
      a.number, b.number, before > 0 ? 100.0 * (after - before) / before : 0.0,
      a.inputs != b.inputs   ? "; the measurements differ"
      : !same_held_out(a, b) ? "; but other poses were held out, so part of it is chance"
                             : "");
}

Json recheck_of_json(const RecheckOf& recheck) {
  return {{"parent_run", recheck.parent},
          {"verdict", recheck.verdict},
          {"verdict_text", recheck.words},
          {"before", stats_json(recheck.before)},
          {"expected_mean_mm", to_mm(recheck.expected_m)},
          {"control_limit_mm", to_mm(recheck.limit_m)}};
}

/// "; 3 readings that stand out miss by up to 5.100 mm", or nothing.
std::string beside(const Fit& fit) {
  const auto n = static_cast<long long>(single_bad(fit).size());
  if (n == 0) return {};
  return fmt::format(
      "; {} by up to {} mm",
      counted_words(n, "reading that stands out misses", "readings that stand out miss"),
      mm(fit.held.max));
}

/// What the last column says of a run.
std::string content_of(const Run& run) {
  if (run.recheck)
    return fmt::format("recheck of run {}: {}", run.recheck->parent, run.recheck->verdict);
  return fmt::format("{}{}{}", counted(run.effects),
                     run.fit.base == Base::kController ? ", on the controller's positions" : "",
                     beside(run.fit));
}

}  // namespace

Json runs_json(const std::vector<ListedRun>& runs) {
  Json list = Json::array();
  for (const auto& [run, state] : runs) {
    list.push_back({{"run", run.number},
                    {"created", run.created},
                    {"effects", run.effects},
                    {"base", name_of(run.fit.base)},
                    {"current", state == ListedRun::State::kCurrent},
                    {"held_out", stats_json(run.fit.held)},
                    {"verdict_error", stats_json(usual_held(run.fit))},
                    {"fit", stats_json(run.fit.fit)},
                    {"cell_sha256", run.cell_sha256}});
    if (run.recheck) list.back()["recheck"] = recheck_of_json(*run.recheck);
  }
  return {{"runs", list}};
}

Blocks runs_blocks(const std::vector<ListedRun>& runs) {
  if (runs.empty()) return {Sentence{"No runs yet."}};
  Table table{.name = "runs",
              .caption = "Runs",
              .head = {head::kRun, head::kCreated, head::kReadings, head::kMean, head::kRms,
                       head::kP95, head::kMax, head::kEffects}};
  table.left_from = 7;
  for (const auto& [run, state] : runs) {
    const auto& s = usual_held(run.fit);
    table.add({fmt::format("{:04}{}", run.number, state == ListedRun::State::kCurrent ? " *" : ""),
               run.created, fmt::format("{}", s.n), mm(s.mean), mm(s.rms), mm(s.p95), mm(s.max),
               content_of(run)});
  }
  return {Sentence{fmt::format("{}, held-out error in mm (* of the present cell and data):",
                               counted_words(static_cast<long long>(runs.size()), "run", "runs"))},
          std::move(table)};
}

Json diff_json(const Run& a, const Run& b) {
  Json parameters = Json::array();
  for (const auto& change : changes(a, b)) parameters.push_back(change_json(change));
  Json out{{"a", a.number},
           {"b", b.number},
           {"same_measurements", a.inputs == b.inputs},
           {"same_held_out", same_held_out(a, b)},
           {"parameters", parameters},
           {"effects_added", only_in(b.effects, a.effects)},
           {"effects_dropped", only_in(a.effects, b.effects)},
           {"held_out", {{"a", stats_json(a.fit.held)}, {"b", stats_json(b.fit.held)}}},
           {"verdict_error",
            {{"a", stats_json(usual_held(a.fit))}, {"b", stats_json(usual_held(b.fit))}}}};
  const bool known = a.fit.held.n > 0 && b.fit.held.n > 0;
  put(out["held_out"], "change_mean_mm", known ? to_mm(b.fit.held.mean - a.fit.held.mean) : NAN,
      "a run has no held-out poses");
  return out;
}

std::string diff_text(const Run& a, const Run& b) {
  std::string out = verdict_of(a, b) + "\n\n";
  const std::string more = counted(only_in(b.effects, a.effects));
  const std::string less = counted(only_in(a.effects, b.effects));
  if (!more.empty()) out += "  more effects: " + more + "\n";
  if (!less.empty()) out += "  fewer effects: " + less + "\n";
  const auto all = changes(a, b);
  if (all.empty()) return out + "  No parameter differs.\n";
  Table table{.head = {"parameter", fmt::format("run {}", a.number),
                       fmt::format("run {}", b.number), "change", "1 sigma", ""}};
  table.left_from = 5;
  for (const auto& c : all)
    table.add({c.name, number(c.a, c.unit, ""), number(c.b, c.unit, ""),
               number(c.b - c.a, c.unit, "+"), number(c.std, c.unit, ""), c.unit.name});
  return out + text_of(table);
}

}  // namespace plumb::offline::show
