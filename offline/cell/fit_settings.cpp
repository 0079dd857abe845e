// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cell/cell_sections.hpp"

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

void read_fixed(TomlTable& t, CellDraft& draft) {
  for (const auto& [name, node] : t.texts("fixed")) {
    const auto dot = std::min(name.find('.'), name.size());
    const std::string owner = name.substr(0, dot);
    const std::string rest = dot < name.size() ? name.substr(dot + 1) : "";
    const bool place = one_of(owner, {"frame", "target"});
    if (!place && draft.joint_index(owner) < 0)
      unknown_joint(t, owner, *node, draft);
    else if (!(place ? is_pose_parameter(rest) : is_joint_parameter(rest)))
      t.error("E-CELL-RANGE", fmt::format("'{}' names no parameter: '{}'", t.name("fixed"), name),
              *node, "unknown parameter",
              place
                  ? "known: x, y, z, rx, ry, rz"
                  : "known: theta, d, a, alpha, beta, and post.dx … post.ez of model \"complete\"");
    else
      draft.cell.fit.fixed.push_back(name);
  }
}

}  // namespace

void read_fit(TomlTable& t, CellDraft& draft) {
  read_fixed(t, draft);
  draft.cell.fit.model = t.choice("model", {"dh", "complete"}) == "complete"
                             ? FitSettings::Model::kComplete
                             : FitSettings::Model::kDh;
  if (const toml::node* prior = t.node("prior"))
    t.error("E-CELL-RESERVED",
            fmt::format("'{}' is not supported in this version", t.name("prior")), *prior,
            "reserved", "delete it; hold parameters with fixed = [\"J2.d\"]");
  t.done();
}

void read_deploy(TomlTable& t, CellDraft& draft) {
  DeploySettings& deploy = draft.cell.deploy;
  if (const auto cycle = t.number("cycle_us")) {
    deploy.cycle_s = unit_of("us")->to_si(*cycle);
    if (*cycle < 100.0 || *cycle > 1e6) t.out_of_range("cycle_us", "between 100 and 1000000");
  }
  if (const auto most = t.number("max_correction_mm")) {
    deploy.max_correction_m = unit_of("mm")->to_si(*most);
    if (*most <= 0.0 || *most > 50.0)
      t.out_of_range("max_correction_mm", "greater than 0, at most 50");
  }
  t.done();
}

}  // namespace plumb::offline
