// SPDX-License-Identifier: Apache-2.0
// The calls of the load phase: they may allocate and read files, and catch what that throws.
#include <filesystem>
#include <new>
#include <span>

#include "check.hpp"

namespace {

using plumb::LoadError;
using plumb::format::Model;

/// The caller's buffer for the text of an error.
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

plumb_result failed(plumb_result result, const Message& message, std::string_view sentence) {
  message.say(sentence);
  return result;
}

plumb_result result_of(LoadError::Fault fault) noexcept {
  switch (fault) {
    case LoadError::Fault::kUnknownEffect:
      return PLUMB_UNKNOWN_EFFECT;
    case LoadError::Fault::kOtherRobot:
      return PLUMB_OTHER_ROBOT;
    case LoadError::Fault::kBusy:
      return PLUMB_BUSY;
    default:
      return PLUMB_UNREADABLE;
  }
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

template <class Source>
plumb_result load(const Source& source, const char* serial, plumb_robot** robot,
                  const Message& message) {
  auto loaded = plumb::Robot::load(
      source, serial == nullptr ? std::nullopt : std::optional<std::string>(serial));
  if (loaded.error) return failed(result_of(loaded.error->fault), message, loaded.error->text);
  auto out = std::make_unique<plumb_robot>();
  out->robot = std::move(loaded.robot);
  describe(*out, out->robot->model());
  *robot = out.release();
  return PLUMB_OK;
}

template <class Source>
plumb_result swap(plumb_robot& robot, const Source& source, const Message& message) {
  const auto error = robot.robot->swap(source);
  return error ? failed(result_of(error->fault), message, error->text) : PLUMB_OK;
}

/// Runs a call of the load phase and turns exceptions into results.
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

std::span<const std::byte> span_of(const void* bytes, std::size_t count) noexcept {
  return {static_cast<const std::byte*>(bytes), count};
}

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
  return guarded(to, [&] { return load(std::filesystem::path(path), serial, robot, to); });
}

plumb_result plumb_load_bytes(const void* bytes, std::size_t count, const char* serial,
                              plumb_robot** robot, char* message, std::size_t capacity) {
  const Message to{message, capacity};
  const plumb_result found = check_new(bytes, robot);
  if (found != PLUMB_OK) return failed(found, to, plumb_result_text(found));
  return guarded(to, [&] { return load(span_of(bytes, count), serial, robot, to); });
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
  return robot->robot->collect() ? PLUMB_OK : PLUMB_BUSY;
}

plumb_result plumb_swap_file(plumb_robot* robot, const char* path, char* message,
                             std::size_t capacity) {
  const Message to{message, capacity};
  const plumb_result found = check_swap(robot, path);
  if (found != PLUMB_OK) return failed(found, to, plumb_result_text(found));
  return guarded(to, [&] { return swap(*robot, std::filesystem::path(path), to); });
}

plumb_result plumb_swap_bytes(plumb_robot* robot, const void* bytes, std::size_t count,
                              char* message, std::size_t capacity) {
  const Message to{message, capacity};
  const plumb_result found = check_swap(robot, bytes);
  if (found != PLUMB_OK) return failed(found, to, plumb_result_text(found));
  return guarded(to, [&] { return swap(*robot, span_of(bytes, count), to); });
}

}  // extern "C"
