// SPDX-License-Identifier: Apache-2.0
#include "bus_text/value_meaning.hpp"

#include "plumb/drivers/bus_content.hpp"

namespace plumb::drivers {
namespace {

struct Meaning {
  MessageKind kind;
  const char* signal;
  const char* text;
};

static_assert(kDrivesOn == 1 && kAutomatic == 2 && kProtectiveStop == 4 &&
              kCorrectionEnabled == 8 && kAcknowledge == 16);
constexpr Meaning kMeanings[] = {
    {MessageKind::kController, "flags",
     "Sum of: 1 drives on, 2 automatic, 4 protective stop, 8 correction enabled, 16 acknowledge"},
    {MessageKind::kController, "tool", "Active tool, 0 to 255"},
    {MessageKind::kController, "frame", "Active user frame, 0 to 255"},
    {MessageKind::kController, "payload", "Active payload, 0 to 255"},
    {MessageKind::kRobot, "serial", "Number that stands for the robot's serial number"},
    {MessageKind::kContext, "payload", "Mass at the flange"},
    {MessageKind::kContext, "com_x", "Centre of mass in the flange frame"},
    {MessageKind::kContext, "time", "Time of the process that the model goes by"},
    {MessageKind::kStatus, "output", "1 if a correction is being sent"},
    {MessageKind::kStatus, "refused", "Cycles refused, lower 16 bits"},
    {MessageKind::kStatus, "limited", "Cycles limited, lower 16 bits"},
    {MessageKind::kStatus, "stale", "Cycles without fresh input, lower 16 bits"},
    {MessageKind::kSignature, "model", "Number that stands for the model file"},
    {MessageKind::kSignature, "robot", "Number that stands for the robot it was made for"},
};

constexpr NamedNumber kStates[] = {{0, "init"},   {1, "sync"}, {2, "shadow"},
                                   {3, "active"}, {4, "hold"}, {5, "fault"}};
constexpr NamedNumber kModes[] = {{0, "shadow"}, {1, "limited"}, {2, "full"}};
static_assert(static_cast<int>(SessionState::kFault) == 5 &&
              static_cast<int>(CorrectionMode::kFull) == 2);

NamedNumber named(Status status) { return {static_cast<int>(status), to_string(status)}; }

}  // namespace

const char* meaning_of(MessageKind kind) noexcept {
  switch (kind) {
    case MessageKind::kJoints:
      return "Measured joint positions";
    case MessageKind::kCommanded:
      return "Commanded joint positions of the target";
    case MessageKind::kTarget:
      return "Desired tool pose in the base frame: position, rotation vector";
    case MessageKind::kActual:
      return "Tool pose that the controller shows for the joints of the same counter";
    case MessageKind::kController:
      return "Drives, mode, stop, enable, active tool, frame and payload";
    case MessageKind::kRobot:
      return "Who the robot is";
    case MessageKind::kContext:
      return "What the model needs to know besides";
    case MessageKind::kCorrected:
      return "Tool pose to go to instead of the target of the same counter";
    case MessageKind::kOffset:
      return "Added to the target of the same counter: base frame, R = exp(dr) R_target";
    case MessageKind::kStatus:
      return "State of plumb-rt";
    case MessageKind::kSignature:
      return "Which model runs";
  }
  return "";
}

const char* meaning_of(MessageKind kind, const std::string& signal) noexcept {
  for (const Meaning& meaning : kMeanings)
    if (meaning.kind == kind && signal == meaning.signal) return meaning.text;
  return "";
}

std::span<const NamedNumber> names_of(MessageKind kind, const std::string& signal) noexcept {
  static const NamedNumber kStatuses[] = {named(Status::kOk),
                                          named(Status::kOutsideDomain),
                                          named(Status::kContextFallback),
                                          named(Status::kLimited),
                                          named(Status::kRamping),
                                          named(Status::kPartial),
                                          {kAsksForAcknowledgement, "acknowledge"},
                                          named(Status::kNotFinite),
                                          named(Status::kNearSingular),
                                          named(Status::kOtherConfiguration),
                                          named(Status::kFarFromSeed),
                                          named(Status::kNotConverged),
                                          named(Status::kSeedNotCommanded),
                                          named(Status::kNoModel),
                                          named(Status::kStale)};
  if (kind != MessageKind::kStatus) return {};
  if (signal == "state") return kStates;
  if (signal == "mode") return kModes;
  if (signal == "status") return kStatuses;
  return {};
}

}  // namespace plumb::drivers
