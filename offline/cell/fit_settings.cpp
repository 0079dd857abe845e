// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cell/cell_sections.hpp"
#include "cell/earlier_arm.hpp"
#include "cell/fleet_priors.hpp"

namespace plumb::offline {
namespace {

bool one_of(const std::string& word, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* w) { return word == w; });
}

bool is_pose_parameter(const std::string& name) {
  return one_of(name, {"x", "y", "z", "rx", "ry", "rz"});
}

bool is_joint_parameter(const std::string& name) {
  return one_of(name, {"theta", "d", "a", "alpha", "beta", "post.dx", "post.dy", "post.dz",
                       "post.ex", "post.ey", "post.ez"});
}

/// True if `name` is a parameter of the arm, or of frame and target; else reports it at `node`.
bool names_parameter(TomlTable& t, const std::string& key, const std::string& name,
                     const toml::node& node, CellDraft& draft) {
  const auto dot = std::min(name.find('.'), name.size());
  const std::string owner = name.substr(0, dot);
  const std::string rest = dot < name.size() ? name.substr(dot + 1) : "";
  const bool place = one_of(owner, {"frame", "target"});
  if (!place && draft.joint_index(owner) < 0) {
    unknown_joint(t, owner, node, draft);
    return false;
  }
  if (place ? is_pose_parameter(rest) : is_joint_parameter(rest)) return true;
  t.error("E-CELL-RANGE", fmt::format("'{}' names no parameter: '{}'", t.name(key), name), node,
          "unknown parameter",
          place ? "known: x, y, z, rx, ry, rz"
                : "known: theta, d, a, alpha, beta, and post.dx … post.ez of model \"complete\"");
  return false;
}

void read_fixed(TomlTable& t, CellDraft& draft) {
  for (const auto& [name, node] : t.texts("fixed"))
    if (names_parameter(t, "fixed", name, *node, draft)) draft.cell.fit.fixed.push_back(name);
}

/// prior = { "J2.d" = 0.1 }: 1 sigma around nominal, in the units of the cell.
void read_priors(TomlTable& t, CellDraft& draft) {
  auto table = t.table("prior");
  if (!table) return;
  for (const auto& name : table->keys()) {
    const toml::node& node = *table->node(name);
    if (!names_parameter(t, "prior", name, node, draft)) continue;
    if (name.starts_with("frame.") || name.starts_with("target.")) {
      t.error("E-CELL-RANGE", fmt::format("'{}' is of the measurement, not of the arm", name), node,
              "nothing is known of it beforehand", "state it: [measurement] frame, target");
      continue;
    }
    const auto sigma = table->positive(name);
    if (sigma)
      draft.cell.fit.priors.push_back(
          {.name = name,
           .sigma = (is_length_parameter(name) ? draft.length : draft.angle).to_si(*sigma)});
  }
  table->done();
}

/// prior_from = "../fleet/fleet.json": what other arms of the model taught. What the cell says of a
/// number itself goes before. Or "../arm1", "runs/0003": one earlier run.
void read_prior_from(TomlTable& t, CellDraft& draft) {
  const auto name = t.text("prior_from");
  if (!name || name->empty()) return;
  draft.cell.fit.prior_from = *name;
  auto& priors = draft.cell.fit.priors;
  const std::vector<Prior> own = priors;
  try {
    std::error_code ignored;
    if (std::filesystem::is_directory(draft.cell.directory / *name, ignored)) {
      draft.cell.fit.earlier =
          std::make_shared<EarlierArm>(earlier_arm(draft.cell.directory / *name));
      return;
    }
    auto learnt = fleet_priors(draft.cell.directory / *name, draft.cell.nominal);
    if (learnt.priors.empty())
      t.warning("W-CELL-PRIOR",
                "the fleet holds too few arms of this model to learn from: nothing is taken over",
                *t.node("prior_from"), "named here", "plumb fleet needs five arms of one model");
    draft.cell.fit.sister_odds = learnt.odds;
    for (auto& prior : learnt.priors) {
      const bool stated =
          std::any_of(own.begin(), own.end(), [&](const Prior& p) { return p.name == prior.name; });
      if (!stated) priors.push_back(std::move(prior));
    }
  } catch (const Failure& failure) {
    const Problem& problem = failure.problems().front();
    t.error(problem.code, problem.message, *t.node("prior_from"), "named here", problem.help);
  }
}

}  // namespace

bool is_length_parameter(const std::string& name) {
  return one_of(name.substr(name.find('.') + 1), {"d", "a", "post.dx", "post.dy", "post.dz"});
}

void read_fit(TomlTable& t, CellDraft& draft) {
  read_fixed(t, draft);
  draft.cell.fit.model = t.choice("model", {"dh", "complete"}) == "complete"
                             ? FitSettings::Model::kComplete
                             : FitSettings::Model::kDh;
  read_priors(t, draft);
  read_prior_from(t, draft);
  if (const auto length_mm = t.not_negative("prior_mm")) draft.cell.fit.prior_m = *length_mm * 1e-3;
  if (const auto angle_mrad = t.not_negative("prior_mrad"))
    draft.cell.fit.prior_rad = *angle_mrad * 1e-3;
  t.done();
}

}  // namespace plumb::offline
