// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace plumb::offline::twin {

/// What can be wrong with a controller and its line, and what an operator does about it.
enum class FaultKind {
  kLate,          // every frame comes later; seconds
  kLose,          // share of the frames that never arrive
  kRepeat,        // share that arrives twice
  kCorrupt,       // share with a flipped bit
  kReorder,       // share that arrives after the ones behind it
  kDisconnect,    // no frame either way
  kReboot,        // the controller falls silent, forgets, and counts from zero again
  kFreeze,        // it repeats old joint positions
  kAbsolute,      // it corrects its poses by itself: an absolute-accuracy option
  kTool,          // another tool is active: its poses are those of another point
  kNoContext,     // payload, temperatures and time are not sent
  kSecondSender,  // someone else sends corrections under plumb-rt's identifier
  kStop,          // protective stop
  kManual,        // operating mode not automatic
  kDrivesOff,
  kDisable,      // the cell's own enable is taken away
  kAcknowledge,  // no fault: the operator's button is pressed
};

/// One fault and when: for ever, or `for_s` from `from_s` on after the path began [s].
struct Fault {
  FaultKind kind = FaultKind::kLose;
  double size = 0.0;  // share, or seconds
  bool always = true;
  double from_s = 0.0;
  double for_s = 0.0;  // infinite if not said
};

/// "late=20ms", "lose=30%@5+10", "stop@3+1", "absolute". Throws Failure (kUsage) with "did you
/// mean".
Fault parse_fault(const std::string& text);

/// Name and one line about each.
const std::vector<std::pair<std::string, std::string>>& known_faults();

/// What is wrong at a time.
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
