// SPDX-License-Identifier: Apache-2.0
// The calls of the load phase: they may allocate and read files, and catch what that throws.
#include <filesystem>
#include <new>
#include <span>
#include <variant>

#include "check.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/runtime/binding.hpp"

namespace {

using plumb::LoadedModel;
using plumb::ModelSlot;
using plumb::format::Model;
using plumb::format::ReadError;
using Read = std::variant<Model, ReadError>;

/// What a call says about an error.
struct Message {
  char* text;
  std::size_t capacity;

  void say(std::string_view sentence) const noexcept {
    if (text == nullptr || capacity == 0) return;
    const std::size_t length = std::min(sentence.size(), capacity - 1);
    std::copy_n(sentence.data(), length, text);
    text[length] = '\0';
  }
};

struct Loaded {
  plumb_result result = PLUMB_OK;
  std::unique_ptr<const LoadedModel> model;
};

plumb_result failed(plumb_result result, const Message& message, std::string_view sentence) {
  message.say(sentence);
  return result;
}

Loaded loaded(Read read, const Message& message) {
  if (const auto* error = std::get_if<ReadError>(&read))
    return {failed(PLUMB_UNREADABLE, message, error->detail), nullptr};
  auto& model = std::get<Model>(read);
  const plumb::EffectFault fault = plumb::find_effect_fault(model);
  if (fault.kind != plumb::EffectFault::Kind::kNone) {
    const std::string& name = model.effects[fault.effect].name;
    return {failed(PLUMB_UNKNOWN_EFFECT, message,
                   "effect '" + name + "' cannot be evaluated by Plumb " + plumb_version()),
            nullptr};
  }
  return {PLUMB_OK, LoadedModel::make(std::move(model))};
}

void describe(plumb_robot& robot, const Model& model) {
  robot.joints = static_cast<int>(model.nominal.joints.size());
  robot.serial = model.serial;
  for (int k = 0; k < PLUMB_MAX_TEMPERATURES; ++k)
    if (const std::string* name = plumb::temperature_name(model, k)) {
      robot.sensors[static_cast<std::size_t>(k)] = *name;
      robot.sensor_count = k + 1;
    }
}

plumb_result begin(Loaded first, const char* serial, plumb_robot** robot, const Message& message) {
  if (first.result != PLUMB_OK) return first.result;
  const Model& model = first.model->model();
  if (serial != nullptr && model.serial != serial)
    return failed(PLUMB_OTHER_ROBOT, message,
                  "the model was made for serial '" + model.serial + "', not '" + serial + "'");
  auto out = std::make_unique<plumb_robot>(std::move(first.model));
  describe(*out, out->running->model());
  *robot = out.release();
  return PLUMB_OK;
}

plumb_result exchange(plumb_robot& robot, Loaded next, const Message& message) {
  if (next.result != PLUMB_OK) return next.result;
  const auto fault = plumb::find_binding_fault(robot.running->model(), next.model->model());
  switch (robot.slot.publish(*next.model)) {
    case ModelSlot::Published::kBusy:
      return failed(PLUMB_BUSY, message, plumb_result_text(PLUMB_BUSY));
    case ModelSlot::Published::kOtherRobot:
      return failed(PLUMB_OTHER_ROBOT, message, plumb::to_string(fault));
    case ModelSlot::Published::kDone:
      break;
  }
  robot.before = std::move(robot.running);
  robot.running = std::move(next.model);
  return PLUMB_OK;
}

/// Runs a call of the load phase; what it throws becomes a result.
template <class Call>
plumb_result guarded(const Message& message, Call call) noexcept {
  try {
    message.say("");
    return call();
  } catch (const std::bad_alloc&) {
    return failed(PLUMB_NO_MEMORY, message, plumb_result_text(PLUMB_NO_MEMORY));
  } catch (const std::exception& error) {
    return failed(PLUMB_UNREADABLE, message, error.what());
  } catch (...) {
    return failed(PLUMB_UNREADABLE, message, plumb_result_text(PLUMB_UNREADABLE));
  }
}

Read read_bytes(const void* bytes, std::size_t count) {
  return plumb::format::read_model(std::span(static_cast<const std::byte*>(bytes), count));
}

Read read_file(const char* path) { return plumb::format::read_model(std::filesystem::path(path)); }

plumb_result check_new(const void* source, plumb_robot** robot) noexcept {
  const plumb_result found = plumb::c::check_pointer(robot);
  if (found != PLUMB_OK) return found;
  *robot = nullptr;
  return source == nullptr ? PLUMB_NULL : PLUMB_OK;
}

plumb_result check_swap(const plumb_robot* robot, const void* source) noexcept {
  const plumb_result found = plumb::c::check_robot(robot);
  return found == PLUMB_OK && source == nullptr ? PLUMB_NULL : found;
}

}  // namespace

extern "C" {

plumb_result plumb_load_file(const char* path, const char* serial, plumb_robot** robot,
                             char* message, std::size_t capacity) {
  const Message to{message, capacity};
  const plumb_result found = check_new(path, robot);
  if (found != PLUMB_OK) return failed(found, to, plumb_result_text(found));
  return guarded(to, [&] { return begin(loaded(read_file(path), to), serial, robot, to); });
}

plumb_result plumb_load_bytes(const void* bytes, std::size_t count, const char* serial,
                              plumb_robot** robot, char* message, std::size_t capacity) {
  const Message to{message, capacity};
  const plumb_result found = check_new(bytes, robot);
  if (found != PLUMB_OK) return failed(found, to, plumb_result_text(found));
  return guarded(to,
                 [&] { return begin(loaded(read_bytes(bytes, count), to), serial, robot, to); });
}

plumb_result plumb_unload(plumb_robot* robot) {
  if (robot == nullptr) return PLUMB_OK;
  const plumb_result found = plumb::c::check_robot(robot);
  if (found != PLUMB_OK) return found;
  delete robot;
  return PLUMB_OK;
}

plumb_result plumb_collect(plumb_robot* robot) {
  const plumb_result found = plumb::c::check_robot(robot);
  if (found != PLUMB_OK) return found;
  if (!robot->slot.settled()) return PLUMB_BUSY;
  robot->before.reset();
  return PLUMB_OK;
}

plumb_result plumb_swap_file(plumb_robot* robot, const char* path, char* message,
                             std::size_t capacity) {
  const Message to{message, capacity};
  plumb_result found = check_swap(robot, path);
  if (found == PLUMB_OK) found = plumb_collect(robot);
  if (found != PLUMB_OK) return failed(found, to, plumb_result_text(found));
  return guarded(to, [&] { return exchange(*robot, loaded(read_file(path), to), to); });
}

plumb_result plumb_swap_bytes(plumb_robot* robot, const void* bytes, std::size_t count,
                              char* message, std::size_t capacity) {
  const Message to{message, capacity};
  plumb_result found = check_swap(robot, bytes);
  if (found == PLUMB_OK) found = plumb_collect(robot);
  if (found != PLUMB_OK) return failed(found, to, plumb_result_text(found));
  return guarded(to, [&] { return exchange(*robot, loaded(read_bytes(bytes, count), to), to); });
}

}  // extern "C"
