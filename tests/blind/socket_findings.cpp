// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/socket_findings.hpp"

#include <fmt/format.h>

#include "diagnose/certainty.hpp"
#include "diagnose/diagnosis.hpp"

namespace plumb::offline {
namespace {

/// J2 by this, J3 by twice as much: some hundredths of a millimetre are left by geometry alone.
constexpr double kYields_rad_per_Nm = 8e-6;

bool is_load(const std::string& effect) {
  return effect == "gravity_free" || effect == "joint_compliance" || effect == "link_flexure";
}

struct Diagnosed {
  Finding finding = Finding::kComplete;
  bool certain = false, load_first = false;
};

Diagnosed diagnosed(const SocketWay& way, std::uint64_t seed, double yields) {
  SocketPlan plan = plan_of(way, seed);
  plan.yields_rad_per_Nm = yields;
  SocketArm arm(plan);
  const auto [cell, measured] = read_way(arm, way);
  const Diagnosis d = diagnose(cell, measured, {});
  return {d.finding, certainty(cell, d) == Certainty::kCertain,
          !d.candidates.empty() && is_load(d.candidates.front().entry.name)};
}

}  // namespace

SocketFindings socket_findings(const SocketWay& way, int arms, std::uint64_t seed) {
  SocketFindings out;
  out.way = way;
  out.arms = arms;
  for (int k = 0; k < arms; ++k) {
    const std::uint64_t own = seed + static_cast<std::uint64_t>(k);
    const Diagnosed hidden = diagnosed(way, own, kYields_rad_per_Nm);
    const bool found = hidden.finding != Finding::kComplete;
    out.unseen += found ? 0 : 1;
    out.first += found && hidden.load_first ? 1 : 0;
    out.certain += found && hidden.load_first && hidden.certain ? 1 : 0;
    out.wrong += found && !hidden.load_first && hidden.certain ? 1 : 0;
    out.made_up += diagnosed(way, own, 0.0).certain ? 1 : 0;
  }
  return out;
}

std::string findings_table(const std::vector<SocketFindings>& all) {
  std::string out =
      "| measured by | 1 sigma [µm] | readings | arms | load first | of these certain | another "
      "cause, certain | nothing found | made up where nothing hides |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const SocketFindings& f : all)
    out += fmt::format("| {} | {:.0f} | {} | {} | {} | {} | {} | {} | {} |\n", name_of(f.way),
                       f.way.sigma_m * 1e6, f.way.readings, f.arms, f.first, f.certain, f.wrong,
                       f.unseen, f.made_up);
  return out;
}

}  // namespace plumb::offline
