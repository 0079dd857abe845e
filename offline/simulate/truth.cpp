// SPDX-License-Identifier: Apache-2.0
#include "simulate/truth.hpp"

#include "simulate/hidden_effect_text.hpp"

#include <numbers>

namespace plumb::offline::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegree = std::numbers::pi / 180.0;

Json in_mm(const std::array<double, 3>& p) { return {p[0] * 1e3, p[1] * 1e3, p[2] * 1e3}; }

void add(Json& out, const std::string& name, double value, double nominal, bool is_length) {
  const double unit = is_length ? 1e-3 : kDegree;
  out.push_back({{"name", name},
                 {"value", value / unit},
                 {"unit", is_length ? "mm" : "deg"},
                 {"nominal", nominal / unit}});
}

Json parameters(const format::Chain& nominal, const format::Chain& real) {
  Json out = Json::array();
  for (std::size_t i = 0; i < real.joints.size(); ++i) {
    const auto& n = nominal.joints[i];
    const auto& t = real.joints[i];
    add(out, n.name + ".theta", t.theta, n.theta, false);
    add(out, n.name + ".d", t.d, n.d, true);
    add(out, n.name + ".a", t.a, n.a, true);
    add(out, n.name + ".alpha", t.alpha, n.alpha, false);
    add(out, n.name + ".beta", t.beta, n.beta, false);
  }
  return out;
}

const char* name_of(LawEntry::Domain domain) {
  switch (domain) {
    case LawEntry::Domain::kEnvironment:
      return "environment";
    case LawEntry::Domain::kMeasurement:
      return "measurement";
    case LawEntry::Domain::kProcedure:
      return "procedure";
    default:
      return "robot";
  }
}

Json size_json(const EffectSize& size, double noise_m) {
  Json out{{"visible_um", size.visible_m * 1e6}, {"rms_um", size.rms_m * 1e6}};
  if (noise_m > 0.0) out["visible_sigma"] = size.visible_m / noise_m;
  return out;
}

// Adds the names of the poses before and after a row, for readers who have only the file.
void name_poses(Json& numbers, const Simulation& simulation) {
  if (numbers.contains("moves")) {
    for (auto& move : numbers["moves"]) name_poses(move, simulation);
  }
  if (!numbers.contains("row_after")) return;
  const auto row = numbers["row_after"].get<std::size_t>();
  const auto& names = simulation.measured.pose;
  if (row == 0 || row >= names.size()) return;
  numbers["pose_before"] = names[row - 1];
  numbers["pose_after"] = names[row];
}

Json effect(const HiddenLaw& hidden, const Simulation& simulation) {
  const LawEntry& entry = *find_law(hidden.name);
  Json numbers = hidden.law->truth();
  Json out{{"effect", hidden.name},           {"class", entry.library},
           {"domain", name_of(entry.domain)}, {"joints", Json::array()},
           {"inputs", hidden.law->inputs()},  {"same_as", entry.same_as}};
  if (!numbers.is_array()) {
    name_poses(numbers, simulation);
  } else {
    for (auto& part : numbers) {
      out["joints"].push_back(part["joint"]);
      name_poses(part, simulation);
    }
  }
  out["numbers"] = numbers;
  return out;
}

Json effects(const std::vector<HiddenLaw>& laws, const Simulation& simulation, double noise_m) {
  Json out = Json::array();
  for (std::size_t k = 0; k < laws.size(); ++k) {
    Json entry = effect(laws[k], simulation);
    entry["size"] = size_json(simulation.sizes[k], noise_m);
    out.push_back(std::move(entry));
  }
  return out;
}

Json imperfections(const Cell& cell, const Imperfections& imperfect) {
  Json out = Json::object();
  if (!imperfect.joint_scatter.empty()) {
    for (const double sigma : imperfect.joint_scatter) {
      out["joint_scatter_urad"].push_back(sigma * 1e6);
    }
  }
  if (imperfect.encoder_step > 0.0) out["encoder_step_urad"] = imperfect.encoder_step * 1e6;
  if (imperfect.gravity) out["gravity_m_per_s2"] = *imperfect.gravity;
  for (const int joint : imperfect.coupled) {
    out["coupled_drives"].push_back(cell.nominal.joints[static_cast<std::size_t>(joint)].name);
  }
  return out;
}

/// What simulates the same arm again, but for its seed; null if it needs more than this says.
Json again(const Cell& cell, const SimulationPlan& plan, const Simulation& simulation) {
  const HiddenTruth& truth = plan.truth;
  const bool stated = truth.X_MB || truth.target_T || truth.like;
  if (stated || plan.imperfections.any() || truth.mass_share != 0.0 || truth.richness != 1.0)
    return nullptr;
  Json out{{"effects", Json::array()},
           {"geometry_um", truth.geometry_m * 1e6},
           {"geometry_urad", truth.geometry_rad * 1e6},
           {"axes", plan.axes}};
  for (const auto& effect : simulation.effects)
    out["effects"].push_back(hidden_effect_text(effect, cell));
  return out;
}

Json outliers(const Simulation& simulation) {
  Json out = Json::array();
  for (const auto& outlier : simulation.outliers) {
    out.push_back({{"row", outlier.row},
                   {"pose", simulation.measured.pose[static_cast<std::size_t>(outlier.row)]},
                   {"shift_mm", in_mm(outlier.shift_M)}});
  }
  return out;
}

Json poses(const Simulation& simulation) {
  Json out = Json::array();
  for (int row = 0; row < simulation.measured.size(); ++row) {
    const auto p = simulation.true_p_M.row(row);
    out.push_back({{"pose", simulation.measured.pose[row]}, {"p_mm", in_mm({p(0), p(1), p(2)})}});
  }
  return out;
}

}  // namespace

std::string truth_json(const Cell& cell, const SimulationPlan& plan, const Simulation& simulation,
                       const std::vector<HiddenLaw>& laws) {
  Json out{{"schema", "truth/1"}, {"cell", cell.name}, {"seed", plan.seed}};
  out["arm_seed"] = plan.truth.seed.value_or(plan.seed);
  out["noise_sigma_um"] = plan.noise_m * 1e6;
  if (plan.noise_rad) out["noise_sigma_urad"] = *plan.noise_rad * 1e6;
  out["parameters"] = parameters(cell.nominal, simulation.true_chain);
  out["frame"] = {{"xyz_mm", in_mm(simulation.X_MB.p)}, {"quat_wxyz", simulation.X_MB.q}};
  out["target_mm"] = in_mm(simulation.X_TG.p);
  out["target_quat_wxyz"] = simulation.X_TG.q;
  if (plan.imperfections.any()) out["imperfections"] = imperfections(cell, plan.imperfections);
  out["effects"] = effects(laws, simulation, plan.noise_m);
  if (Json arm = again(cell, plan, simulation); !arm.is_null()) out["arm"] = std::move(arm);
  out["outliers"] = outliers(simulation);
  out["poses"] = poses(simulation);
  return out.dump(1) + "\n";
}

}  // namespace plumb::offline::sim
