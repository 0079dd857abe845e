// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plumb/runtime/transform.hpp"

/// Robot programs as text: where their targets stand, and what the programs say of tools and
/// frames.
namespace plumb::offline::programs {

/// One file of a program.
struct Source {
  std::string file;
  std::string bytes;
};

/// A number as it stands in a file, its sign included: bytes [begin, end) of `source`.
struct Number {
  std::size_t source = 0;
  std::size_t begin = 0, end = 0;
  double value = 0.0;
};

/// What the numbers of a target mean. Positions are in mm, with kVector in m.
///   kQuaternion  x y z  qw qx qy qz
///   kZyx         x y z  A B C [deg], R = Rz(A) Ry(B) Rx(C)
///   kXyz         x y z  W P R [deg], R = Rz(R) Ry(P) Rx(W)
///   kVector      x y z  rotation vector [rad]
///   kJoints_deg, kJoints_rad  one number a joint, as the controller counts
enum class Notation { kQuaternion, kZyx, kXyz, kVector, kJoints_deg, kJoints_rad };

constexpr bool of_joints(Notation n) {
  return n == Notation::kJoints_deg || n == Notation::kJoints_rad;
}

struct Written {
  Notation notation = Notation::kQuaternion;
  std::vector<Number> numbers;  // position, then orientation; or joints
};

/// What a target says of the joints that reach it. Nothing of it need be stated.
struct Configuration {
  struct Range {
    int joint;                 // zero-based
    double low_deg, high_deg;  // of the controller's value
  };
  std::vector<Range> ranges;
  std::optional<bool> front;        // the wrist lies in front of axis 1
  std::optional<bool> elbow_front;  // with `front`: the wrist lies in front of the lower arm
};

/// A pose of a tool in the flange, or of a work frame in the base.
struct Frame {
  std::optional<Transformd> X;
  std::string why;  // why it is not known, if it is named but not usable
};
using Frames = std::map<std::string, Frame>;

/// A target, or a move to something that is none that can be corrected.
struct Target {
  std::string name = {};
  std::size_t source = 0;
  int line = 0;  // from 1
  Written written = {};
  Configuration configuration = {};
  std::string tool = {}, frame = {};  // names; those of its moves unless stated with it
  std::string why = {};               // not empty: it is not to be touched, for this reason
  std::string help = {};              // what to do then
  bool missing = false;               // a move goes to it, and the program does not state it
  std::vector<Number> copies = {};    // the same numbers once more, as in the comment of a fold
};

enum class Motion { kJoint, kLinear, kVia, kCircleEnd };

struct Move {
  Motion motion = Motion::kJoint;
  int target = -1;  // index; -1: none that is known
  std::string tool = {}, frame = {};
  int line = 0;
  std::vector<double> joints_deg = {};  // where the joints are near the end of it, if that is said
};

/// What a reader found in the files of one program.
struct Program {
  std::vector<Source> sources;
  std::vector<Target> targets;
  std::vector<Move> moves;  // in the order of the text
  Frames tools, frames;

  /// Lists something that is not touched, and returns its index.
  int list(std::string name, std::size_t source, int line, std::string why, std::string help);
};

}  // namespace plumb::offline::programs
