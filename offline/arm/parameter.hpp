// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// One number of the geometric model that a fit may change.
struct Parameter {
  enum class Kind {
    kTheta,
    kD,
    kA,
    kAlpha,
    kBeta,
    kLinkTwist,
    kFrame,
    kPoint,
    kPlane,
    kArtefactLength,
    kTarget,
    kTargetRotation,
    kEffect
  };
  Kind kind = Kind::kTheta;
  int joint = 0;      // row of the chain; of an effect: index of the effect in the model
  int component = 0;  // twist and frame: dx dy dz ex ey ez; point and target: x y z; plane: z rx
                      // ry; effect: parameter
  std::string name;   // "J2.d", "J3.post.ex", "frame.x", "point[A].x", "target.z", "reversal.J2.h"
  int setup = 0;      // of frame and target: their set-up, which is in the name if there are
                      // several: "frame[day 2].x"

  bool is_length() const;
  bool of_robot() const;  // of the model rather than of frame and target
  bool of_effect() const { return kind == Kind::kEffect; }
  /// Of where the base is from the instrument, or of an artefact.
  bool of_base() const {
    return kind == Kind::kFrame || kind == Kind::kPoint || kind == Kind::kPlane ||
           kind == Kind::kArtefactLength;
  }
};

/// Sum of all link lengths [m], at least 0.1. Multiplied by it, angles become comparable to
/// lengths.
double reach(const format::Chain& chain);

/// Candidates of a cell in the order in which they are preferred when poses cannot tell two apart:
/// frame, target, then the arm from base to tip. Where neighbouring axes are nearly parallel,
/// Hayati's beta takes the place of d. Orientation::kUsed adds the rotation of the target.
enum class Orientation { kIgnored, kUsed };
std::vector<Parameter> candidate_parameters(const Cell& cell, Orientation orientation);

/// The numbers of where an artefact is, and of its length if that is unknown.
std::vector<Parameter> artefact_parameters(const MeasurementSettings& settings, int setup);

/// Prefix of the names of a set-up's frame parameters: "frame.", with several set-ups
/// "frame[day 2].".
std::string frame_prefix(const MeasurementSettings& settings, int setup);

/// The same of a point or of another artefact: "point[A].", "plane[table].".
std::string artefact_prefix(const MeasurementSettings& settings, int setup);

/// Every parameter of the effects that `arm` carries, effect by effect.
std::vector<Parameter> effect_parameters(const format::Model& arm);

/// The robot parameter of that name ("J2.d", "J3.post.ex"), if the chain has it.
std::optional<Parameter> robot_parameter(const format::Chain& chain, const std::string& name);

/// The number of frame or target of the only set-up: "frame.x" to "frame.rz", "target.x" to
/// "target.z".
std::optional<Parameter> placing_parameter(const std::string& name);

}  // namespace plumb::offline
