// SPDX-License-Identifier: Apache-2.0
#include "show/compare_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "show/error_table.hpp"
#include "show/text_table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

constexpr std::size_t kWorst = 10;
constexpr std::size_t kProfilesShown = 4;
constexpr int kBarWidth = 24;

using Unit = ErrorProfile::Unit;
using Kind = ErrorProfile::Kind;

const char* set_name(Comparison::Set set) {
  return set == Comparison::Set::kHeldOut ? "held_out" : "fit";
}

double in_unit(double value, Unit unit) {
  if (unit == Unit::kRow) return std::round(value);
  return shown(value, unit == Unit::kLength);
}

Json worst_json(const Comparison& comparison) {
  Json out = Json::array();
  for (std::size_t i = 0; i < std::min(kWorst, comparison.poses.size()); ++i) {
    const auto& pose = comparison.poses[i];
    out.push_back({{"pose", pose.pose},
                   {"row", pose.row + 1},
                   {"error_mm", to_mm(pose.error_M.norm())},
                   {"dx_mm", to_mm(pose.error_M(0))},
                   {"dy_mm", to_mm(pose.error_M(1))},
                   {"dz_mm", to_mm(pose.error_M(2))},
                   {"set", pose.held ? "held" : "fit"}});
  }
  return out;
}

void add_bins(const ErrorProfile& profile, const char* key, Json& out) {
  const char* suffix = profile.unit == Unit::kRow      ? "_row"
                       : profile.unit == Unit::kLength ? "_mm"
                                                       : "_deg";
  for (const auto& bin : profile.bins) {
    Json row;
    if (profile.kind != Kind::kOrder) row[key] = profile.name;
    row[std::string("from") + suffix] = in_unit(bin.from, profile.unit);
    row[std::string("to") + suffix] = in_unit(bin.to, profile.unit);
    row["n"] = bin.n;
    put(row, "mean_mm", bin.n > 0 ? to_mm(bin.mean_m) : NAN, "no pose lies here");
    out.push_back(std::move(row));
  }
}

Json profiles_json(const Comparison& comparison) {
  Json out{{"joint", Json::array()}, {"region", Json::array()}, {"order", Json::array()}};
  for (const auto& profile : comparison.profiles) {
    if (profile.kind == Kind::kJoint) add_bins(profile, "joint", out["joint"]);
    if (profile.kind == Kind::kRegion) add_bins(profile, "quantity", out["region"]);
    if (profile.kind == Kind::kOrder) add_bins(profile, "", out["order"]);
  }
  return out;
}

std::string worst_text(const Comparison& comparison) {
  TextTable table({"pose", "error", "dx", "dy", "dz"});
  for (std::size_t i = 0; i < std::min(kWorst, comparison.poses.size()); ++i) {
    const auto& pose = comparison.poses[i];
    table.add({pose.pose, mm(pose.error_M.norm()), fmt::format("{:+.3f}", to_mm(pose.error_M(0))),
               fmt::format("{:+.3f}", to_mm(pose.error_M(1))),
               fmt::format("{:+.3f}", to_mm(pose.error_M(2)))});
  }
  return "\nWorst poses [mm], measured - predicted in the measurement frame\n" + table.text();
}

std::string title(const ErrorProfile& profile) {
  switch (profile.kind) {
    case Kind::kJoint:
      return fmt::format("joint {} [{}]", profile.name, unit(profile.unit == Unit::kLength));
    case Kind::kRegion:
      return fmt::format("{} in the base frame [{}]", profile.name,
                         unit(profile.unit == Unit::kLength));
    case Kind::kOrder:
      return "order of measurement [row]";
  }
  return profile.name;
}

std::string profile_text(const ErrorProfile& profile) {
  double most = 0.0;
  for (const auto& bin : profile.bins) most = std::max(most, bin.mean_m);
  TextTable table({title(profile), "poses", "mean", ""});
  table.left_from(3);
  for (const auto& bin : profile.bins) {
    const int bar = most > 0 ? static_cast<int>(std::lround(bin.mean_m / most * kBarWidth)) : 0;
    table.add({fmt::format("{:9.0f} .. {:.0f}", in_unit(bin.from, profile.unit),
                           in_unit(bin.to, profile.unit)),
               fmt::format("{}", bin.n), bin.n > 0 ? mm(bin.mean_m) : "-", std::string(bar, '#')});
  }
  return table.text();
}

/// The profiles along which the error changes most, in their usual order.
std::string where_text(const Comparison& comparison) {
  std::vector<const ErrorProfile*> shown_ones;
  for (const auto& profile : comparison.profiles)
    if (profile.bins.size() > 1) shown_ones.push_back(&profile);
  std::stable_sort(shown_ones.begin(), shown_ones.end(),
                   [](auto* a, auto* b) { return a->contrast() > b->contrast(); });
  if (shown_ones.size() > kProfilesShown) shown_ones.resize(kProfilesShown);
  if (shown_ones.empty()) return "";
  std::string out = "\nWhere it fails most: mean error [mm]\n";
  for (const auto* profile : shown_ones) out += profile_text(*profile);
  return out;
}

}  // namespace

Json compare_json(const Comparison& comparison, const Run& run, double tolerance_m) {
  const Fit& fit = run.fit;
  Json out = stats_json(comparison.stats);
  out["set"] = set_name(comparison.set);
  out["frame"] = "measurement";
  out["run"] = run.number;
  out["fit"] = stats_json(fit.fit);
  out["nominal"] = stats_json(fit.nominal_held);
  add_floor(fit.floor, out);
  out["tolerance_mm"] = to_mm(tolerance_m);
  out["within_tolerance_pct"] = 100.0 * comparison.within_tolerance;
  out["verdict"] = verdict(fit, tolerance_m);
  out["worst"] = worst_json(comparison);
  out["by"] = profiles_json(comparison);
  return out;
}

std::string compare_text(const Comparison& comparison, const Run& run, double tolerance_m) {
  std::string out = verdict(run.fit, tolerance_m) + "\n\n" + error_table(run.fit);
  out += fmt::format("\n{:.1f} % of the {} poses are within the tolerance of {} mm\n",
                     100.0 * comparison.within_tolerance,
                     comparison.set == Comparison::Set::kHeldOut ? "held-out" : "fit",
                     mm(tolerance_m));
  return out + worst_text(comparison) + where_text(comparison);
}

}  // namespace plumb::offline::show
