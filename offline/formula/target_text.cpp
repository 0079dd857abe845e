// SPDX-License-Identifier: Apache-2.0
#include "formula/target_text.hpp"

#include <fmt/format.h>

namespace plumb::offline {
namespace {

using format::FormulaTarget;

const char* const kTwist[] = {"dx", "dy", "dz", "rx", "ry", "rz"};
const char* const kAxes[] = {"x", "y", "z"};

struct Named {
  std::string name;
  TargetText target;
};

std::vector<Named> all_targets(const FormulaArm& arm) {
  std::vector<Named> out;
  const auto twists = [&](const std::string& frame, FormulaTarget target, int joint) {
    for (std::uint8_t k = 0; k < 6; ++k)
      out.push_back(
          {frame + "." + kTwist[k], {target, static_cast<std::uint8_t>(joint), k, k < 3}});
  };
  for (int j = 0; j < arm.joints(); ++j)
    out.push_back({fmt::format("dq{}", j + 1),
                   {FormulaTarget::kJoint, static_cast<std::uint8_t>(j), 0,
                    arm.slides[static_cast<std::size_t>(j)]}});
  for (int j = 0; j < arm.joints(); ++j) {
    twists(fmt::format("pre{}", j + 1), FormulaTarget::kPre, j);
    twists(fmt::format("post{}", j + 1), FormulaTarget::kPost, j);
  }
  twists("base", FormulaTarget::kBase, 0);
  twists("tool", FormulaTarget::kTool, 0);
  for (std::uint8_t k = 0; k < 3; ++k)
    out.push_back({std::string("tcp.") + kAxes[k], {FormulaTarget::kTip, 0, k, true}});
  return out;
}

}  // namespace

std::vector<std::string> formula_targets(const FormulaArm& arm) {
  std::vector<std::string> out;
  for (auto& one : all_targets(arm)) out.push_back(std::move(one.name));
  return out;
}

std::optional<TargetText> parse_target(const std::string& text, const FormulaArm& arm,
                                       FormulaProblems& problems) {
  for (const auto& [name, target] : all_targets(arm))
    if (name == text) return target;
  problems.push_back({.kind = FormulaProblem::Kind::kTarget,
                      .field = FormulaProblem::Field::kTarget,
                      .at = 0,
                      .length = std::max<std::size_t>(1, text.size()),
                      .message = fmt::format("a formula cannot move '{}'", text),
                      .label = "no target",
                      .help = fmt::format("target = \"dq2\"; joints 1 to {}; or pre2.rx, post2.dz, "
                                          "base.dx, tool.dz, tcp.x",
                                          arm.joints()),
                      .word = text,
                      .candidates = formula_targets(arm)});
  return std::nullopt;
}

}  // namespace plumb::offline
