// SPDX-License-Identifier: Apache-2.0
#include "rt/running_model.hpp"

#include <fmt/format.h>

#include "plumb/drivers/bus_content.hpp"
#include "plumb/format/reader.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"

namespace plumb::drivers::rt {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, std::string what) {
  throw Failure(Exit::kInput, {.code = "E-RT-MODEL",
                               .message = fmt::format("{}: {}", display_name(file), what),
                               .help = "plumb inspect " + shell_word(display_name(file))});
}

std::unique_ptr<const LoadedModel> make(const std::filesystem::path& file, std::string_view bytes,
                                        const std::string& sum) {
  auto read = format::read_model(std::as_bytes(std::span(bytes)));
  if (const auto* error = std::get_if<format::ReadError>(&read)) refuse(file, error->detail);
  auto loaded = LoadedModel::make(std::get<format::Model>(std::move(read)), fingerprint(sum));
  if (loaded == nullptr) refuse(file, "needs an effect that this version does not have");
  return loaded;
}

}  // namespace

RunningModel load_model(const std::filesystem::path& file, const std::string& serial) {
  const std::string bytes = read_regular_file(file, kMostModelBytes);
  const std::string sum = sha256(bytes);
  RunningModel out{.loaded = make(file, bytes, sum), .sha256 = sum, .version = {}};
  const std::string& own = out.loaded->model().serial;
  if (serial.empty() || serial == own) return out;
  throw Failure(Exit::kInput, {.code = "E-RT-SERIAL",
                               .message = fmt::format("{} was made for robot '{}', not for '{}'",
                                                      display_name(file), own, serial),
                               .help = "plumb inspect " + shell_word(display_name(file))});
}

}  // namespace plumb::drivers::rt
