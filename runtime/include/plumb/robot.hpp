// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "plumb/runtime/cycle.hpp"

/// The class with which a controller corrects the targets of one robot: it loads a model, corrects
/// every target, and swaps in a better model while the cycle runs. Library Plumb::robot; `plumb.h`
/// is the same for C.
namespace plumb {

/// Why a model could not be loaded or swapped in.
struct LoadError {
  enum class Fault : std::uint8_t {
    kCannotOpen,     // missing, a directory, no permission
    kTooLarge,       // larger than any model
    kTruncated,      // empty, or the file does not end with its own length
    kNotAModel,      // another kind of file
    kDamaged,        // its checksum is wrong
    kNewerSchema,    // written by a newer version of Plumb
    kUnsound,        // undamaged, but its content is malformed, contradictory or out of range
    kUnknownEffect,  // needs an effect that this version does not have
    kOtherRobot,     // made for another robot
    kBusy            // swap: the cycle has not taken the previous model yet; try again later
  };
  Fault fault = Fault::kCannotOpen;
  std::string text;  // one sentence that names the fault, its place and the value
};

/// The fault in a few words, for example "not a model".
const char* to_string(LoadError::Fault fault) noexcept;

/// One robot: its model and the state of its cycle.
///
///     loader thread   load ............ swap ........ collect ....
///     cycle thread         correct  correct  correct  correct ....
///
/// | phase | calls                                        | heap | thread                 |
/// |-------|----------------------------------------------|------|------------------------|
/// | load  | load, configure, destructor                  | yes  | any, nothing else runs |
/// | swap  | swap, collect, model                         | yes  | one loader thread      |
/// | cycle | correct, predict, enable, counters, context  | no   | one cycle thread       |
///
/// The loader thread and the cycle thread may run at the same time. Calls of the cycle take no lock
/// and make no system call. Their cost is fixed for a given model, and they report errors by
/// Status.
class Robot {
 public:
  struct Loaded;

  /// Reads and verifies a model and checks that it was made for the robot with this serial number;
  /// any robot if none is given. Throws only std::bad_alloc and exceptions of the file system.
  static Loaded load(const std::filesystem::path& file,
                     const std::optional<std::string>& serial = {});
  /// The same from memory, which may be freed afterwards.
  static Loaded load(std::span<const std::byte> bytes,
                     const std::optional<std::string>& serial = {});

  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  /// Changes the settings before the first cycle; they remain when models are swapped. False: the
  /// cycle has begun, and nothing has changed.
  bool configure(const CycleSettings& settings) noexcept;

  /// Reads another model of the same robot and hands it to the cycle, which takes it at the
  /// beginning of its next step; the output moves to the new model at the slew limit, without a
  /// jump. After an error the running model stays in use.
  // clang-tidy takes a function of this name for one that exchanges two values and must not throw.
  // These load a model, and may.
  // NOLINTBEGIN(bugprone-exception-escape)
  std::optional<LoadError> swap(const std::filesystem::path& file);
  std::optional<LoadError> swap(std::span<const std::byte> bytes);
  // NOLINTEND(bugprone-exception-escape)

  /// Frees the previous model. False: the cycle has not taken the last one yet. It need not be
  /// called before `swap`, which does the same first.
  bool collect() noexcept;

  /// The model published last.
  const format::Model& model() const noexcept { return running_->model(); }

  /// Steps the cycle once: takes the inputs and returns the corrected target, as Cycle::step does.
  /// Errors are told by the status of the output, which is finite whatever the inputs are.
  CycleOutput correct(const CycleInput& input) noexcept { return cycle_.step(input); }

  /// Predicts the true pose of the tool in the base frame, in the context of the last cycle. q: the
  /// controller's values of the robot's joints [rad] or [m]; further numbers are not read, and too
  /// few give Status::kNotFinite.
  Prediction predict(std::span<const double> q) const noexcept {
    Angles angles;
    return cycle_.model().corrector().forward_model().predict(angles_at(q, angles),
                                                              cycle_.context());
  }

  /// The pose of the tool at q by the controller's nominal chain, in the base frame [m]. q: the
  /// joints of the robot; further numbers are not read. If there are too few, every number of the
  /// pose is NaN: as a target of `correct` it is refused.
  Transformd nominal_pose(std::span<const double> q) const noexcept {
    const Chain& chain = cycle_.model().corrector().nominal();
    Angles angles;
    const auto joints = angles_at(q, angles);
    return joints.size() == static_cast<std::size_t>(chain.joints()) ? chain.forward(joints)
                                                                     : no_pose();
  }

  /// From the next cycle on the correction ramps out to zero (kOff) or in again (kOn).
  void enable(Guard::Enable on) noexcept { cycle_.enable(on); }

  /// Counters that only grow, from loading on.
  const GuardCounters& counters() const noexcept { return cycle_.counters(); }
  /// What was known in the last cycle beside the joint positions.
  const Context& context() const noexcept { return cycle_.context(); }

 private:
  explicit Robot(std::unique_ptr<const LoadedModel> first)
      : running_(std::move(first)), slot_(*running_), cycle_(slot_) {}

  using Angles = std::array<double, format::kMaxJoints>;

  /// The joint angles at the controller's joint values q; fewer than the robot has joints if q has.
  std::span<const double> angles_at(std::span<const double> q, Angles& out) const noexcept {
    const std::size_t joints = cycle_.model().model().nominal.joints.size();
    const std::size_t given = std::min({q.size(), joints, out.size()});
    std::copy_n(q.begin(), given, out.begin());
    if (given == joints) cycle_.model().coupling().to_angles(out);
    return std::span(out).first(given);
  }

  static Transformd no_pose() noexcept {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {.R = Matrix3::Constant(kNone), .p = Vector3::Constant(kNone)};
  }

  template <class Source>
  static Loaded load_from(const Source& source, const std::optional<std::string>& serial);
  template <class Source>
  std::optional<LoadError> swap_from(const Source& source);

  // Loader thread.
  std::unique_ptr<const LoadedModel> running_;
  std::unique_ptr<const LoadedModel> before_;  // kept until the cycle has taken running_
  // Both threads.
  ModelSlot slot_;
  // Cycle thread.
  Cycle cycle_;
};

/// The result of loading: a robot, or the error.
struct Robot::Loaded {
  std::unique_ptr<Robot> robot;    // null after an error
  std::optional<LoadError> error;  // none if there is a robot
};

}  // namespace plumb
