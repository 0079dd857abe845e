// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace plumb::offline::twin {

/// The faults of a controller and of its bus, and the actions of an operator.
enum class FaultKind {
  kLate,          // every frame is delayed; the size is the delay [s]
  kLose,          // some frames are lost; the size is their share
  kRepeat,        // some frames arrive twice; the size is their share
  kCorrupt,       // some frames have a flipped bit; the size is their share
  kReorder,       // some frames arrive after later ones; the size is their share
  kDisconnect,    // no frame passes in either direction
  kReboot,        // the controller restarts: silent, without memory, counters at zero
  kFreeze,        // the controller repeats old joint positions
  kAbsolute,      // the controller corrects its poses by itself (absolute-accuracy option)
  kTool,          // another tool is active, so the poses are those of another point
  kNoContext,     // the controller sends no payload, temperatures or time
  kSecondSender,  // another device sends corrections under plumb-rt's identifier
  kStop,          // protective stop
  kManual,        // the operating mode is not automatic
  kDrivesOff,
  kDisable,      // the enable signal of the cell is off
  kAcknowledge,  // not a fault: the operator presses the acknowledge button
};

/// One fault and its time: always, or from `from_s` after the beginning of the path for `for_s`
/// [s].
struct Fault {
  FaultKind kind = FaultKind::kLose;
  double size = 0.0;  // a share, or a time [s]
  bool always = true;
  double from_s = 0.0;
  double for_s = 0.0;  // infinite if not given
};

/// Reads a fault such as "late=20ms", "lose=30%@5+10", "stop@3+1" or "absolute". Throws Failure
/// (kUsage), with "did you mean".
Fault parse_fault(const std::string& text);

/// The name of every fault with one line of description.
const std::vector<std::pair<std::string, std::string>>& known_faults();

/// Tells which faults are active at a time.
class FaultPlan {
 public:
  FaultPlan() = default;
  explicit FaultPlan(std::vector<Fault> faults) : faults_(std::move(faults)) {}

  /// path_s: since the path began; negative before.
  bool active(FaultKind kind, double path_s) const { return find(kind, path_s) != nullptr; }
  double size(FaultKind kind, double path_s) const;

 private:
  const Fault* find(FaultKind kind, double path_s) const;
  std::vector<Fault> faults_;
};

}  // namespace plumb::offline::twin
