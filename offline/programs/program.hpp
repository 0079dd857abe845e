// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
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
  /// One of two words for the side of axis 5, of which nobody knows which is which: two targets
  /// with one word are on one side, with two on both.
  char side = 0;
};

/// A pose of a tool in the flange, or of a work frame in the base.
struct Frame {
  std::optional<Transformd> X;
  std::string why = {};  // why it is not known, if it is named but not usable
  bool local = false;    // of its file alone
  bool moving = false;   // it is no one pose while the programs run: no option can say where it is
};

/// By their names; what kAllFrames says counts for every one.
using Frames = std::map<std::string, Frame>;
inline const std::string kAllFrames = "*";

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
  bool external_axes = false;         // it states where external axes stand
  std::vector<Number> copies = {};    // the same numbers once more, as in the comment of a fold

  /// It is not to be touched, for this reason, unless another one is known already.
  void leave(std::string reason, std::string remedy);
};

enum class Motion { kJoint, kLinear, kVia, kCircleEnd };

struct Move {
  Motion motion = Motion::kJoint;
  int target = -1;  // index; -1: none, and where the arm is now is not known
  std::string tool = {}, frame = {};
  int line = 0;
  bool configured = false;  // the controller goes to the configuration that the target states
  std::vector<double> joints_deg = {};  // where the joints are near the end of it, if that is said
};

/// What programs say that counts in every program of their language that is given with them. Names
/// are in lower case.
struct Facts {
  struct Place {
    std::string file;
    int line = 0;
  };
  std::map<std::string, std::vector<Place>> mentions;  // one in a file, and two at most: of words
                                                       // but declarations and goals of moves
  std::map<std::string, std::set<std::string>> calls;  // of each routine
  std::set<std::string> sets_tool, sets_frame, moves;  // routines
  std::set<std::string> assigned;                      // records that are changed
  bool joint_configurations = true, linear_configurations = true;  // they are looked at
  std::string displaced = {};                                      // why all targets move, or none

  /// Joins what another program says. Then close() finds the routines that set a tool or a frame,
  /// or move, through others.
  void add(const Facts& other);
  void close();
};

/// What a reader found in the files of one program.
struct Program {
  std::vector<Source> sources;
  std::vector<Target> targets;
  std::vector<Move> moves;  // in the order of the text
  Frames tools, frames;
  Facts facts;
  bool states_nothing = false;  // no target, no move, no tool, no frame: is it a program at all?

  /// Adds a target that a move states itself, and returns its index.
  int add_inline(Target target, std::size_t source, int line);

  /// Lists something that is not touched, and returns its index.
  int list(std::string name, std::size_t source, int line, std::string why, std::string help);
};

}  // namespace plumb::offline::programs
