// SPDX-License-Identifier: Apache-2.0
#include "plumb/robot.hpp"

#include <variant>

#include "plumb/format/reader.hpp"
#include "plumb/format/version.hpp"
#include "plumb/runtime/binding.hpp"

namespace plumb {
namespace {

using Fault = LoadError::Fault;
using Checked = std::variant<std::unique_ptr<const LoadedModel>, LoadError>;

Fault fault_of(format::ReadErrorCode code) noexcept {
  switch (code) {
    case format::ReadErrorCode::kCannotOpen:
      return Fault::kCannotOpen;
    case format::ReadErrorCode::kTooLarge:
      return Fault::kTooLarge;
    case format::ReadErrorCode::kTruncated:
      return Fault::kTruncated;
    case format::ReadErrorCode::kNotAModel:
      return Fault::kNotAModel;
    case format::ReadErrorCode::kChecksum:
      return Fault::kDamaged;
    case format::ReadErrorCode::kNewerSchema:
      return Fault::kNewerSchema;
    default:
      return Fault::kUnsound;
  }
}

/// Reads a model and asks whether this library knows its effects.
template <class Source>
Checked checked(const Source& source) {
  auto read = format::read_model(source);
  if (const auto* error = std::get_if<format::ReadError>(&read))
    return LoadError{fault_of(error->code), error->detail};
  auto& model = std::get<format::Model>(read);
  const EffectFault fault = find_effect_fault(model);
  if (fault.kind != EffectFault::Kind::kNone)
    return LoadError{Fault::kUnknownEffect, "effect '" + model.effects[fault.effect].name +
                                                "' cannot be evaluated by Plumb " +
                                                format::kVersion};
  return LoadedModel::make(std::move(model));
}

}  // namespace

const char* to_string(LoadError::Fault fault) noexcept {
  switch (fault) {
    case Fault::kCannotOpen:
      return "cannot be opened";
    case Fault::kTooLarge:
      return "too large";
    case Fault::kTruncated:
      return "truncated";
    case Fault::kNotAModel:
      return "not a model";
    case Fault::kDamaged:
      return "damaged";
    case Fault::kNewerSchema:
      return "written by a newer version";
    case Fault::kUnsound:
      return "its content makes no sense";
    case Fault::kUnknownEffect:
      return "needs an unknown effect";
    case Fault::kOtherRobot:
      return "made for another robot";
    case Fault::kBusy:
      return "the cycle has not taken the last model yet";
  }
  return "unknown";
}

template <class Source>
Robot::Loaded Robot::load_from(const Source& source, const std::optional<std::string>& serial) {
  Checked found = checked(source);
  if (auto* error = std::get_if<LoadError>(&found)) return {nullptr, std::move(*error)};
  auto& model = std::get<std::unique_ptr<const LoadedModel>>(found);
  if (serial && model->model().serial != *serial)
    return {nullptr,
            LoadError{Fault::kOtherRobot, "the model was made for serial '" +
                                              model->model().serial + "', not '" + *serial + "'"}};
  return {std::unique_ptr<Robot>(new Robot(std::move(model))), std::nullopt};
}

template <class Source>
std::optional<LoadError> Robot::swap_from(const Source& source) {
  if (!collect()) return LoadError{Fault::kBusy, to_string(Fault::kBusy)};
  Checked found = checked(source);
  if (auto* error = std::get_if<LoadError>(&found)) return std::move(*error);
  auto& next = std::get<std::unique_ptr<const LoadedModel>>(found);
  switch (slot_.publish(*next)) {
    case ModelSlot::Published::kBusy:
      return LoadError{Fault::kBusy, to_string(Fault::kBusy)};
    case ModelSlot::Published::kOtherRobot:
      return LoadError{Fault::kOtherRobot, to_string(find_binding_fault(model(), next->model()))};
    case ModelSlot::Published::kDone:
      break;
  }
  before_ = std::exchange(running_, std::move(next));
  return std::nullopt;
}

Robot::Loaded Robot::load(const std::filesystem::path& file,
                          const std::optional<std::string>& serial) {
  return load_from(file, serial);
}

Robot::Loaded Robot::load(std::span<const std::byte> bytes,
                          const std::optional<std::string>& serial) {
  return load_from(bytes, serial);
}

bool Robot::configure(const CycleSettings& settings) noexcept {
  if (cycle_.counters().steps > 0) return false;
  cycle_ = Cycle(slot_, settings);
  return true;
}

// NOLINTBEGIN(bugprone-exception-escape): see the header
std::optional<LoadError> Robot::swap(const std::filesystem::path& file) { return swap_from(file); }

std::optional<LoadError> Robot::swap(std::span<const std::byte> bytes) { return swap_from(bytes); }
// NOLINTEND(bugprone-exception-escape)

bool Robot::collect() noexcept {
  if (!slot_.settled()) return false;
  before_.reset();
  return true;
}

}  // namespace plumb
