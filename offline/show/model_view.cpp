// SPDX-License-Identifier: Apache-2.0
#include "show/model_view.hpp"

#include <fmt/format.h>

#include "cell/toml_text.hpp"
#include "effects/registry.hpp"
#include "show/counted.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

constexpr std::size_t kJointsInALine = 3;
constexpr std::size_t kDigitsShown = 16;  // of a check sum; all stand in --json

const char* convention(const format::Chain& chain) {
  return chain.convention == format::Convention::kStandard ? "standard" : "modified";
}

const char* corrects(const format::GuardLimits& guard) {
  return guard.corrects == format::Corrects::kPose ? "pose" : "position";
}

Json twist_json(const format::Twist& t) {
  return {{"d_mm", {to_mm(t.d[0]), to_mm(t.d[1]), to_mm(t.d[2])}},
          {"e_deg", {to_deg(t.e[0]), to_deg(t.e[1]), to_deg(t.e[2])}}};
}

Json row_json(const format::JointRow& row) {
  const std::string q = unit(slides(row));
  Json out{{"name", row.name},
           {"type", slides(row) ? "prismatic" : "revolute"},
           {"alpha_deg", to_deg(row.alpha)},
           {"a_mm", to_mm(row.a)},
           {"d_mm", to_mm(row.d)},
           {"theta_deg", to_deg(row.theta)},
           {"beta_deg", to_deg(row.beta)},
           {"scale", row.scale}};
  out["offset_" + q] = shown(row.offset, slides(row));
  out["q_min_" + q] = shown(row.q_min, slides(row));
  out["q_max_" + q] = shown(row.q_max, slides(row));
  out["pre"] = twist_json(row.pre);
  out["post"] = twist_json(row.post);
  return out;
}

Json chain_json(const format::Chain& chain) {
  Json joints = Json::array();
  for (const auto& row : chain.joints) joints.push_back(row_json(row));
  return {{"dh_convention", convention(chain)},
          {"base", pose_json(chain.base)},
          {"base_twist", twist_json(chain.base_twist)},
          {"joints", joints},
          {"coupling", coupling_json(chain.coupling)},
          {"tool_twist", twist_json(chain.tool_twist)},
          {"tool", pose_json(chain.tool)}};
}

Json trees_json(const format::Model& model) {
  const char* const axes[] = {"x", "y", "z"};
  Json out = Json::array();
  for (std::size_t k = 0; k < model.trees.size(); ++k)
    out.push_back({{"axis", axes[k]},
                   {"leaves", model.trees[k].leaves()},
                   {"depth", model.trees[k].depth},
                   {"degree", model.trees[k].degree},
                   {"blended", !model.trees[k].blend_half_width.empty()}});
  return out;
}

Json domain_json(const format::Model& model) {
  Json out = Json::array();
  for (std::size_t i = 0; i < model.domain.q_min.size(); ++i) {
    const auto& row = model.nominal.joints[i];
    const std::string q = unit(slides(row));
    Json range{{"joint", row.name}};
    range["q_min_" + q] = shown(model.domain.q_min[i], slides(row));
    range["q_max_" + q] = shown(model.domain.q_max[i], slides(row));
    out.push_back(range);
  }
  return out;
}

/// As people write them: [kg], [mm], [N], [N m], [degC].
struct ShownRange {
  std::string name, unit;
  double low, high;
};

ShownRange shown_range(const format::ContextRange& r) {
  if (r.input == format::ContextInput::kTemperature) return {r.name, "degC", r.low, r.high};
  if (r.name.empty()) return {"payload", "kg", r.low, r.high};
  if (r.name[0] == 'c') return {"payload_" + r.name, "mm", to_mm(r.low), to_mm(r.high)};
  return {r.name, r.name[0] == 'f' ? "N" : "Nm", r.low, r.high};
}

Json context_json(const format::Model& model) {
  Json out = Json::array();
  for (const auto& range : model.domain.context) {
    const ShownRange r = shown_range(range);
    out.push_back({{"input", r.name}, {"min_" + r.unit, r.low}, {"max_" + r.unit, r.high}});
  }
  return out;
}

Json guard_json(const format::GuardLimits& g) {
  return {{"corrects", corrects(g)},
          {"max_correction_mm", to_mm(g.max_correction_m)},
          {"max_rotation_deg", to_deg(g.max_rotation_rad)},
          {"slew_mm_per_s", to_mm(g.slew_m_per_s)},
          {"slew_deg_per_s", to_deg(g.slew_rad_per_s)},
          {"ramp_s", g.ramp_s},
          {"cycle_us", g.cycle_s * 1e6},
          {"length_scale_mm", to_mm(g.length_scale_m)},
          {"min_singular_value", g.min_singular_value},
          {"max_seed_distance_deg", to_deg(g.max_seed_distance)}};
}

Json provenance_json(const format::Provenance& p) {
  Json inputs = Json::array();
  for (const auto& input : p.inputs)
    inputs.push_back({{"file", input.name}, {"sha256", input.sha256}});
  Json out{{"tool_version", p.tool_version},
           {"created", p.created},
           {"run", p.run},
           {"inputs", inputs},
           {"poses_fit", p.poses_fit}};
  out["held_out"] = stats_json({.n = static_cast<int>(p.held_out.poses),
                                .mean = p.held_out.mean_m,
                                .rms = p.held_out.rms_m,
                                .p95 = p.held_out.p95_m,
                                .max = p.held_out.max_m});
  put(out, "noise_floor_mm", to_mm(p.noise_floor_m));
  out["parameters"] = p.parameter_names;
  return out;
}

std::string chain_text(const format::Model& model) {
  Table table{.head = {"joint", "alpha [deg]", "a [mm]", "d [mm]", "theta [deg]", "beta [deg]",
                       "q min", "q max"}};
  const auto add = [&](const format::JointRow& row, const std::string& name) {
    table.add({name, fmt::format("{:.4f}", to_deg(row.alpha)), fmt::format("{:.4f}", to_mm(row.a)),
               fmt::format("{:.4f}", to_mm(row.d)), fmt::format("{:.4f}", to_deg(row.theta)),
               fmt::format("{:.4f}", to_deg(row.beta)),
               fmt::format("{:.1f}", shown(row.q_min, slides(row))),
               fmt::format("{:.1f} {}", shown(row.q_max, slides(row)), unit(slides(row)))});
  };
  for (std::size_t i = 0; i < model.nominal.joints.size(); ++i) {
    add(model.nominal.joints[i], model.nominal.joints[i].name + " nominal");
    if (i < model.calibrated.joints.size()) add(model.calibrated.joints[i], "   calibrated");
  }
  if (model.nominal.coupling.empty()) return text_of(table);
  return text_of(table) +
         "coupling of the controller's joint values: " + toml_coupling(model.nominal) + "\n";
}

std::string held_out_text(const format::Provenance& p) {
  if (p.held_out.poses == 0) return "none: every pose was used for the fit";
  return fmt::format("mean {}, RMS {}, 95 % {}, max {} mm ({} poses)", mm(p.held_out.mean_m),
                     mm(p.held_out.rms_m), mm(p.held_out.p95_m), mm(p.held_out.max_m),
                     p.held_out.poses);
}

/// Three joints a line.
void add_domain(const format::Model& model, Table& table) {
  std::string line;
  const std::size_t joints = model.domain.q_min.size();
  if (joints == 0) table.add({"trained domain", "none"});
  for (std::size_t i = 0; i < joints; ++i) {
    const auto& row = model.nominal.joints[i];
    line += fmt::format("{}{} {:.0f} .. {:.0f} {}", line.empty() ? "" : ", ", row.name,
                        shown(model.domain.q_min[i], slides(row)),
                        shown(model.domain.q_max[i], slides(row)), unit(slides(row)));
    if (i % kJointsInALine != kJointsInALine - 1 && i + 1 < joints) continue;
    table.add({i < kJointsInALine ? "trained domain" : "", line});
    line.clear();
  }
}

std::string effects_text(const format::Model& model) {
  std::vector<std::string> names{geometry_effect()};
  for (const auto& effect : model.effects)
    names.push_back(effect.formula.code.empty() ? effect.name : effect.formula.expression);
  return counted(names);
}

std::string trees_text(const format::Model& model) {
  std::string out;
  for (const format::Tree& tree : model.trees) {
    if (tree.leaves() == 0) continue;
    out += fmt::format("{}{} {} {} leaves", out.empty() ? "" : ", ", tree.leaves(),
                       tree.blend_half_width.empty() ? "crisp" : "blended",
                       tree.degree == 2 ? "quadratic" : "affine");
  }
  return out.empty() ? "none" : out;
}

}  // namespace

std::string context_text(const format::Model& model) {
  std::string out;
  for (const auto& range : model.domain.context) {
    const ShownRange r = shown_range(range);
    out += fmt::format("{}{} {:.4g} .. {:.4g} {}", out.empty() ? "" : ", ", r.name, r.low, r.high,
                       r.unit);
  }
  return out;
}

Json model_json(const format::Model& model) {
  Json effects = Json::array();
  for (const auto& e : model.effects) {
    effects.push_back(
        {{"effect", e.name}, {"version", e.version}, {"parameters_si", e.parameters}});
    if (!e.formula.code.empty()) effects.back()["formula"] = e.formula.expression;
  }
  return {{"cell", model.cell_name},
          {"robot", model.robot_name},
          {"serial", model.serial},
          {"gravity_m_per_s2", model.gravity},
          {"nominal", chain_json(model.nominal)},
          {"calibrated", chain_json(model.calibrated)},
          {"effects", effects},
          {"trees", trees_json(model)},
          {"domain", domain_json(model)},
          {"domain_fade", model.domain.fade},
          {"domain_context", context_json(model)},
          {"guard", guard_json(model.guard)},
          {"provenance", provenance_json(model.provenance)}};
}

std::string corrected_text(const format::GuardLimits& g) {
  const bool pose = g.corrects == format::Corrects::kPose;
  return fmt::format("{}, at most {} mm{}, changing by at most {:.1f} mm a second",
                     pose ? "position and orientation" : "position only", mm(g.max_correction_m),
                     pose ? fmt::format(" and {:.3f} deg", to_deg(g.max_rotation_rad)) : "",
                     to_mm(g.slew_m_per_s));
}

std::string model_text(const format::Model& model) {
  const auto& p = model.provenance;
  const auto& g = model.guard;
  Table table{.head = {"cell", model.cell_name}};
  table.add({"robot", fmt::format("{}, serial {}", model.robot_name, model.serial)});
  table.add({"arm", fmt::format("{} joints, {} DH", model.nominal.joints.size(),
                                convention(model.nominal))});
  table.add({"effects", effects_text(model)});
  table.add({"trees", trees_text(model)});
  table.add({"held-out", held_out_text(p)});
  table.add({"noise floor", p.noise_floor_m > 0.0 ? mm(p.noise_floor_m) + " mm" : "unknown"});
  table.add({"corrects", corrected_text(g)});
  add_domain(model, table);
  if (!model.domain.context.empty()) table.add({"trained with", context_text(model)});
  table.add({"made", fmt::format("{} by plumb {}, run {}, {} poses", p.created, p.tool_version,
                                 p.run, p.poses_fit)});
  for (const auto& input : p.inputs)
    table.add({"input",
               fmt::format("{} (sha256 {}...)", input.name, input.sha256.substr(0, kDigitsShown))});
  table.left_from = 1;
  return text_of(table) + "\n" + chain_text(model);
}

}  // namespace plumb::offline::show
