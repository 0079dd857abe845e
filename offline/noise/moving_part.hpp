// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline {

/// What may shift once while measuring: the reflector or the tool, the tracker or the base, or the
/// zero of a joint.
enum class MotionSource { kTool, kBase, kJoint };

/// A part that may shift; `joint` is -1 for tool and base.
struct MovingPart {
  MotionSource source = MotionSource::kTool;
  int joint = -1;
};

/// Every part of an arm of so many joints, in the order in which a search tries them.
inline std::vector<MovingPart> moving_parts(int joints) {
  std::vector<MovingPart> out{{MotionSource::kTool, -1}, {MotionSource::kBase, -1}};
  for (int j = 0; j < joints; ++j) out.push_back({MotionSource::kJoint, j});
  return out;
}

/// How many numbers describe its motion: tool 3 (shift), base 6 (shift and turn), joint 1.
inline int numbers_of(MotionSource source) {
  return source == MotionSource::kBase ? 6 : source == MotionSource::kTool ? 3 : 1;
}

/// "tool", "base", "joint": the option `of` of [effects.step].
inline const char* name_of(MotionSource source) {
  return source == MotionSource::kTool ? "tool" : source == MotionSource::kBase ? "base" : "joint";
}

/// "the reflector or the tool", "the tracker or the base", "the zero of J3".
inline std::string in_words(const Cell& cell, const MovingPart& part) {
  if (part.source == MotionSource::kTool) return "the reflector or the tool";
  if (part.source == MotionSource::kBase) return "the tracker or the base";
  return "the zero of " + cell.nominal.joints[static_cast<std::size_t>(part.joint)].name;
}

}  // namespace plumb::offline
