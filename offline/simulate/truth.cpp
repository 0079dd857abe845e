// SPDX-License-Identifier: Apache-2.0
#include "simulate/truth.hpp"

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

Json effects(const std::vector<HiddenLaw>& laws) {
  Json out = Json::array();
  for (const auto& [name, law] : laws) {
    const Json numbers = law->truth();
    Json entry{{"effect", name}, {"joints", Json::array()}};
    if (numbers.is_array()) {
      for (const auto& part : numbers) entry["joints"].push_back(part["joint"]);
    }
    entry["numbers"] = numbers;
    out.push_back(entry);
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
  out["effects"] = effects(laws);
  out["poses"] = poses(simulation);
  return out.dump(1) + "\n";
}

}  // namespace plumb::offline::sim
