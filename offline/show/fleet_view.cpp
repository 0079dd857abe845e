// SPDX-License-Identifier: Apache-2.0
#include "show/fleet_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "effects/registry.hpp"
#include "program/counted_words.hpp"
#include "program/printable.hpp"
#include "show/counted.hpp"
#include "show/heads.hpp"
#include "show/parameter_unit.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

using fleet::CellSummary;
using fleet::Fleet;
using fleet::Model;
using fleet::OddArm;
using fleet::Typical;

constexpr std::size_t kAllShown = 40;      // cells; of more only those that need attention
constexpr std::size_t kTypicalShown = 12;  // numbers of a model

/// "mm", "deg", "um", "urad" of a number in SI.
ParameterUnit unit_of_number(const std::string& effect, const std::string& si) {
  const bool geometry = is_geometry(effect);
  return unit_of({.name = {}, .is_length = si == "m", .unit = geometry ? "" : si});
}

std::string effect_of(const Fleet& all, const OddArm& odd) {
  for (const Model& model : all.models)
    for (const Typical& t : model.sisters.typical)
      if (t.name == odd.number) return t.effect;
  return geometry_effect();
}

std::string odd_words(const Fleet& all, const OddArm& odd) {
  const ParameterUnit unit = unit_of_number(effect_of(all, odd), odd.unit);
  return fmt::format("{} is {} {} away from nominal, its sisters {} {}", odd.number,
                     unit.text(odd.value), unit.name, unit.text(odd.mean), unit.name);
}

Json cell_json(const Fleet& all, const CellSummary& cell) {
  Json out{{"name", cell.name}, {"ok", cell.ok}};
  out["held_out"] = stats_json(cell.held);
  out["arm"] = cell.arm;
  out["verdict"] = cell.answers.sentence;
  if (cell.ok)
    out["finding"] = to_json(cell.answers);
  else
    put_null(out, "finding", "the cell could not be fitted");
  out["verdict_head"] = cell.verdict_head;
  out["verdict_class"] = cell.verdict_class;
  out["good"] = cell.good;
  out["effects"] = cell.effects;
  out["robot"] = cell.robot;
  out["model"] = cell.model;
  const OddArm* const odd = odd_arm(all, cell.name);
  out["unlike_sisters"] = odd != nullptr;
  if (odd != nullptr) out["unlike_text"] = odd_words(all, *odd);
  if (const auto copy = all.copies.find(cell.name); copy != all.copies.end())
    out["same_measurements_as"] = copy->second;
  else
    put_null(out, "same_measurements_as", "no other cell has them");
  if (cell.ok)
    put_null(out, "error", "it could be fitted");
  else
    out["error"] = {{"code", cell.error_code}, {"message", cell.error}};
  if (cell.diagnosis)
    out["diagnosis"] = {{"verdict", cell.diagnosis->finding},
                        {"verdict_text", cell.diagnosis->words},
                        {"effect", cell.diagnosis->effect},
                        {"joints", cell.diagnosis->joints}};
  else
    put_null(out, "diagnosis", "--diagnose was not given");
  return out;
}

Json use_json(const fleet::EffectUse& use) {
  Json out{{"effect", use.effect}, {"modelled", use.modelled}};
  if (use.diagnosed > 0)
    out["missing"] = use.missing;
  else
    put_null(out, "missing", "--diagnose was not given");
  out["diagnosed"] = use.diagnosed;
  return out;
}

Json typical_json(const Typical& t) {
  const ParameterUnit unit = unit_of_number(t.effect, t.unit);
  return {{"name", t.name},
          {"effect", t.effect},
          {"parameter", t.name},
          {"unit", unit.name},
          {"mean", t.mean * unit.per_si},
          {"sd", t.sd * unit.per_si},
          {"mean_si", t.mean},
          {"sd_si", t.sd},
          {"shrinkage", t.shrinkage},
          {"arms", t.arms}};
}

Json shares_json(const std::vector<fleet::EffectShare>& shares) {
  Json out = Json::array();
  for (const auto& one : shares)
    out.push_back(
        {{"effect", one.effect}, {"arms", one.arms}, {"of", one.of}, {"odds_nats", one.odds_nats}});
  return out;
}

std::string cells_text(const Fleet& all) {
  Table table{.head = {"cell", head::kMean, head::kP95, head::kEffects, "verdict"}};
  table.left_from = 3;
  for (const CellSummary* const cell : listed_cells(all, kAllShown))
    table.add({printable_line(cell->name), cell->ok ? mm(cell->held.mean) : "-",
               cell->ok ? mm(cell->held.p95) : "-", counted(cell->effects),
               printable_line(state_of(all, *cell))});
  std::string out = "Held-out error in mm:\n\n" + text_of(table);
  if (const auto left_out = all.cells.size() - table.rows.size(); left_out > 0)
    out += fmt::format("  and {}\n", counted_words(left_out, "good one", "good ones"));
  return out;
}

std::string effects_text(const Fleet& all) {
  if (all.models.empty()) return {};
  const Table table = effects_table(all);
  return fmt::format("\n{}:\n\n", table.caption) + text_of(table);
}

std::string typical_text(const Model& model) {
  if (model.sisters.typical.empty()) return "\n" + too_few_words(model) + "\n";
  Table table = typical_table(model);
  const std::size_t all = table.rows.size();
  table.rows.resize(std::min(kTypicalShown, all));
  std::string out =
      fmt::format("\n{}: differences from nominal\n\n", model_name(model)) + text_of(table);
  if (all > kTypicalShown) out += fmt::format("  and {} more in fleet.json\n", all - kTypicalShown);
  return out;
}

}  // namespace

Table effects_table(const Fleet& all) {
  Table table{.caption = "Effects, and in how many arms",
              .head = {head::kEffect, "modelled in", "missing in"}};
  for (const auto& use : fleet::effect_uses(all))
    table.add({use.effect, fmt::format("{}", use.modelled),
               use.diagnosed > 0 ? fmt::format("{} of {}", use.missing, use.diagnosed) : "-"});
  return table;
}

Table typical_table(const Model& model) {
  std::vector<const Typical*> sorted;
  for (const auto& t : model.sisters.typical) sorted.push_back(&t);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Typical* a, const Typical* b) { return a->shrinkage < b->shrinkage; });
  Table table{.caption = "What is typical: differences from nominal, and sizes of effects",
              .head = {"number", "mean", "from arm to arm", "unit", "arms", "shrinkage"}};
  for (const Typical* one : sorted) {
    const ParameterUnit unit = unit_of_number(one->effect, one->unit);
    table.add({one->name, unit.text(one->mean), unit.text(one->sd), unit.name,
               fmt::format("{}", one->arms), fmt::format("{:.0f} %", 100.0 * one->shrinkage)});
  }
  return table;
}

const OddArm* odd_arm(const Fleet& all, const std::string& cell) {
  for (const Model& model : all.models)
    for (const OddArm& odd : model.sisters.odd)
      if (odd.cell == cell) return &odd;
  return nullptr;
}

std::string state_of(const Fleet& all, const CellSummary& cell) {
  if (!cell.ok) return cell.error_code + ": " + cell.error;
  const OddArm* const odd = odd_arm(all, cell.name);
  return odd == nullptr ? cell.verdict_head : cell.verdict_head + "; " + odd_words(all, *odd);
}

std::vector<const CellSummary*> listed_cells(const Fleet& all, std::size_t most) {
  std::vector<const CellSummary*> out;
  for (const auto& cell : all.cells)
    if (all.cells.size() <= most || cell.verdict_class != "good" || odd_arm(all, cell.name))
      out.push_back(&cell);
  return out;
}

std::string fleet_verdict(const Fleet& all) {
  const auto count = [&](auto&& which) {
    return std::count_if(all.cells.begin(), all.cells.end(), which);
  };
  const auto good = count([](const CellSummary& c) { return c.good; });
  const auto failed = count([](const CellSummary& c) { return !c.ok; });
  std::string out =
      all.cells.size() == 1
          ? fmt::format("The only arm {} its tolerance", good == 1 ? "keeps" : "does not keep")
          : fmt::format("{} of {} arms keep{} {} tolerance", good, all.cells.size(),
                        good == 1 ? "s" : "", good == 1 ? "its" : "their");
  std::vector<std::string> odd;
  for (const Model& model : all.models)
    for (const OddArm& one : model.sisters.odd) odd.push_back(one.cell);
  if (!odd.empty())
    out += fmt::format("; {} {} unlike {} sisters: {}", odd.size(), odd.size() == 1 ? "is" : "are",
                       odd.size() == 1 ? "its" : "their", printable_line(counted(odd)));
  if (failed > 0) out += fmt::format("; {} could not be fitted", failed);
  return out + ".";
}

std::string model_name(const Model& model) {
  return fmt::format("{}, {}", model.robot.empty() ? "model " + model.key : model.robot,
                     counted_words(model.arms, "arm", "arms"));
}

std::string too_few_words(const Model& model) {
  return fmt::format("{}: too few to learn from, which takes {} of one model.", model_name(model),
                     fleet::kFewestArms);
}

Json fleet_json(const Fleet& all) {
  Json out{{"verdict_text", fleet_verdict(all)}};
  out["effects"] = Json::array();
  for (const auto& use : fleet::effect_uses(all)) out["effects"].push_back(use_json(use));
  out["cells"] = Json::array();
  for (const auto& cell : all.cells) out["cells"].push_back(cell_json(all, cell));
  out["models"] = Json::array();
  out["typical"] = Json::array();
  for (const auto& model : all.models) {
    Json typical = Json::array();
    for (const auto& t : model.sisters.typical) {
      typical.push_back(typical_json(t));
      Json row = typical.back();
      row["model"] = model.key;
      out["typical"].push_back(std::move(row));
    }
    out["models"].push_back({{"key", model.key},
                             {"robot", model.robot},
                             {"arms", model.arms},
                             {"unlike_sisters", model.sisters.odd.size()},
                             {"typical", std::move(typical)},
                             {"shares", shares_json(model.shares)}});
  }
  return out;
}

std::string fleet_text(const Fleet& all) {
  std::string out = fleet_verdict(all) + "\n\n" + cells_text(all) + effects_text(all);
  for (const auto& model : all.models) out += typical_text(model);
  return out;
}

}  // namespace plumb::offline::show
