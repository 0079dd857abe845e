// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "cell/effect_arguments.hpp"
#include "cell/formula_reader.hpp"
#include "diagnose/formula_words.hpp"
#include "effects/registry.hpp"
#include "runs/option_json.hpp"
#include "show/diagnose_view.hpp"
#include "show/error_table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

/// The mean under the key, its RMS beside it.
void put_error(Json& out, const std::string& key, const ErrorStats& stats) {
  put(out, key + "_mm", stats.n > 0 ? to_mm(stats.mean) : NAN, "no pose was held out");
  put(out, key + "_rms_mm", stats.n > 0 ? to_mm(stats.rms) : NAN, "no pose was held out");
}

/// Name, joints and options, as in cell.toml.
Json entry_json(const Cell& cell, const EffectEntry& effect) {
  return {
      {"effect", effect.name}, {"joints", joints_json(cell, effect)}, {"options", effect.options}};
}

Json parameters_json(const Candidate& candidate) {
  Json out = Json::array();
  for (const auto& n : candidate.numbers) {
    Json one{{"name", n.name}, {"unit", n.unit}};
    put(one, "value", n.value);
    put(one, "std", n.std);
    put(one, "ci95", 1.96 * n.std);
    put(one, "typical", n.typical > 0.0 ? n.typical : NAN, "the arm decides");
    one["plausible"] = n.plausible;
    out.push_back(std::move(one));
  }
  return out;
}

/// What each joint scatters from stop to stop, where the readings speak for it.
Json repeatability_json(const Cell& cell, const Repeatability& repeatability) {
  Json out = Json::array();
  for (std::size_t j = 0; j < repeatability.std.size(); ++j) {
    const auto& row = cell.nominal.joints[j];
    Json one{{"joint", row.name}, {"unit", slides(row) ? "m" : "rad"}};
    put(one, "std", repeatability.std[j]);
    out.push_back(std::move(one));
  }
  return out;
}

/// Effect names, each once: "gear_harmonics:J2" is gear_harmonics.
Json effects_of(const std::vector<std::string>& keys) {
  Json out = Json::array();
  for (const auto& key : keys) {
    const std::string name = key.substr(0, key.find(':'));
    if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
  }
  return out;
}

/// Of a part that moved several times; options.after_row is that of the first move.
void put_moves(Json& out, const std::vector<Move>& moves) {
  if (moves.empty()) return;
  out["moves"] = Json::array();
  for (const Move& move : moves) {
    Json one{{"after_row", move.after_row}};
    put(one, "size_mm", to_mm(move.size_m));
    out["moves"].push_back(std::move(one));
  }
}

/// Name of the figure of plumb plot that shows the effect at work.
std::string figure_of(const Cell& cell, const EffectEntry& effect) {
  if (effect.joints.empty()) return std::string(descriptor_of(effect.name).figure);
  return "joint-" + cell.nominal.joints[static_cast<std::size_t>(effect.joints.front())].name;
}

Json candidate_json(const Cell& cell, const Diagnosis& d, const Candidate& c) {
  Json out{{"effect", c.entry.name},
           {"joints", joints_json(cell, c.entry)},
           {"title", c.title},
           {"figure", figure_of(cell, c.entry)}};
  put(out, "ln_bayes", c.ln_bayes);
  put_error(out, "held_out_alone", c.alone);
  put_error(out, "held_out_after", c.after);
  put(out, "gain_pct", 100.0 * c.gain);
  put(out, "gain_se_pct", 100.0 * c.gain_se);
  out["cycles_per_turn"] = c.cycles;
  out["domain"] = c.domain;
  out["supported"] = c.supported;
  out["plausible"] = c.plausible;
  out["support"] = support_words(d, c);
  out["options"] = c.entry.options;
  out["parameters"] = parameters_json(c);
  put(out, "share_pct", 100.0 * c.explained);
  put(out, "absorbed_by_geometry_pct", 100.0 * c.absorbed);
  put(out, "largest_mm", to_mm(c.largest_m));
  out["confounded_with"] = effects_of(c.confounded_with);
  out["confounded"] = c.confounded_with;
  put_moves(out, c.moves);
  if (!c.separate.empty()) out["separate_by"] = c.separate;
  return out;
}

Json alternatives_json(const Cell& cell, const std::vector<Alternative>& all) {
  Json out = Json::array();
  for (const auto& other : all) {
    Json one = entry_json(cell, other.entry);
    one["cycles_per_turn"] = other.cycles;
    one["domain"] = other.domain;
    put(one, "behind_nats", other.behind_nats);
    if (!other.not_shown.empty()) {
      one["not_shown"] = other.not_shown;
      one["measure"] = other.measure;
    }
    out.push_back(std::move(one));
  }
  return out;
}

Json unknown_json(const Cell& cell, const UnknownStructure& unknown) {
  Json out{{"subject", unknown.pattern.subject},
           {"words", unknown.pattern.words},
           {"depends_on", unknown.pattern.depends_on}};
  put(out, "harmonic", unknown.pattern.harmonic > 0.0 ? unknown.pattern.harmonic : NAN,
      "it is not periodic in them");
  put(out, "share_pct", 100.0 * unknown.share);
  put(out, "rms_mm", to_mm(unknown.rms_m));
  put(out, "rms_urad", unknown.rms_rad > 0.0 ? unknown.rms_rad * 1e6 : NAN, "it is no joint's");
  if (!unknown.alternatives.empty())
    out["alternatives"] = alternatives_json(cell, unknown.alternatives);
  return out;
}

Json formula_json(const Cell& cell, const FormulaOffer& offer) {
  const FormulaText text = formula_text(offer.entry);
  Json out{{"formula", law_of(offer)},
           {"domain", text.domain},
           {"options", offer.entry.options},
           {"parameters", Json::array()},
           {"command", "plumb add " + adding_arguments(cell, offer.entry, {})}};
  for (const auto& n : offer.numbers) {
    Json one{{"name", n.name}, {"unit", n.unit}};
    put(one, "value", n.value);
    put(one, "std", n.std);
    out["parameters"].push_back(std::move(one));
  }
  put_error(out, "held_out_before", offer.before);
  put_error(out, "held_out_after", offer.after);
  put(out, "fall_mm", to_mm(offer.fall_m));
  put(out, "fall_se_mm", to_mm(offer.fall_se_m));
  put(out, "nats", offer.nats);
  out["curve"] = {{"input", offer.input},
                  {"input_unit", offer.input_unit},
                  {"unit", offer.turns ? "rad" : "m"},
                  {"points", Json::array()}};
  for (const auto& at : offer.curve) out["curve"]["points"].push_back({at.input, at.value});
  return out;
}

Json undecided_json(const Cell& cell, const Undecided& undecided) {
  Json out = entry_json(cell, undecided.entry);
  out["cycles_per_turn"] = undecided.cycles;
  out["domain"] = undecided.domain;
  out["alternatives"] = alternatives_json(cell, undecided.alternatives);
  if (undecided.slow_motion) out["slow_motion"] = unknown_json(cell, *undecided.slow_motion);
  return out;
}

}  // namespace

Json joints_json(const Cell& cell, const EffectEntry& effect) {
  Json out = Json::array();
  for (const int joint : effect.joints) out.push_back(cell.nominal.joints[joint].name);
  return out;
}

Json turns_json(const FoundTurns& turns) {
  Json out;
  put(out, "before_deg", to_deg(turns.before.mean));
  put(out, "after_deg", to_deg(turns.after.mean));
  put(out, "noise_floor_deg", to_deg(turns.floor.mean_rad));
  return out;
}

Json diagnose_json(const Cell& cell, const Diagnosis& d) {
  Json out{{"verdict", name_of(d.finding)}, {"verdict_text", d.text}};
  add_floor(d.floor, out);
  if (d.repeatability.supported()) out["repeatability"] = repeatability_json(cell, d.repeatability);
  out["poses_fit"] = d.poses_fit;
  out["poses_held_out"] = d.poses_held;
  out["poses_choosing"] = d.poses_choosing;
  out["folds"] = d.folds;
  out["nested"] = d.nested;
  put_error(out, "held_out_before", d.before);
  put_error(out, "held_out_after", d.after);
  out["held_out_before"] = stats_json(d.before);
  out["held_out_after"] = stats_json(d.after);
  if (d.turns) out["held_out_orientation"] = turns_json(*d.turns);
  out["added"] = Json::array();
  for (const auto& a : d.added) {
    Json one = entry_json(cell, a.entry);
    one["cycles_per_turn"] = a.cycles;
    put(one, "ln_bayes", a.ln_bayes);
    put_error(one, "held_out", a.held);
    one["alternatives"] = alternatives_json(cell, a.alternatives);
    put_moves(one, a.moves);
    out["added"].push_back(std::move(one));
  }
  out["candidates"] = Json::array();
  for (const auto& c : d.candidates) out["candidates"].push_back(candidate_json(cell, d, c));
  out["alternatives"] = alternatives_json(cell, d.alternatives);
  if (d.undecided) out["not_added"] = undecided_json(cell, *d.undecided);
  if (d.slow_motion) out["slow_motion"] = unknown_json(cell, *d.slow_motion);
  if (d.gravity) {
    out["gravity"] = {{"stated", d.gravity->stated},
                      {"found", d.gravity->found},
                      {"certain", d.gravity->certain}};
    put(out["gravity"], "nats_ahead", d.gravity->nats_ahead);
  }
  out["not_testable"] = Json::array();
  for (const auto& t : d.not_testable)
    out["not_testable"].push_back({{"effect", t.effect}, {"why", t.why}, {"measure", t.measure}});
  const auto& unknown = d.unknown_after ? d.unknown_after : d.unknown;
  if (unknown)
    out["unknown"] = unknown_json(cell, *unknown);
  else
    put_null(out, "unknown", "no such structure was found");
  out["formulas"] = Json::array();
  for (const auto& offer : d.formulas) out["formulas"].push_back(formula_json(cell, offer));
  if (d.finding_after) {
    out["verdict_after"] = name_of(*d.finding_after);
    out["verdict_after_text"] = d.text_after;
  }
  out["unlikely"] = Json::array();
  for (const auto& one : d.unlikely) {
    Json large = entry_json(cell, one.entry);
    put(large, "times_usual", one.times);
    out["unlikely"].push_back(std::move(large));
  }
  if (d.held_out_excess)
    out["left_over"] = {{"times_floor", d.held_out_excess->times},
                        {"unavoidable_times", d.held_out_excess->unavoidable},
                        {"lack_of_fit", d.held_out_excess->lack_of_fit()}};
  else
    put_null(out, "left_over", "no noise floor is known");
  out["outliers"] = d.outliers;
  out["blocks_tried"] = d.regressors;
  return out;
}

}  // namespace plumb::offline::show
