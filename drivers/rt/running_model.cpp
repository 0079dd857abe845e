// SPDX-License-Identifier: Apache-2.0
#include "rt/running_model.hpp"

#include <fmt/format.h>

#include <sstream>

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

void check_sum(const std::filesystem::path& folder, const std::string& line) {
  constexpr std::size_t kDigits = 64;
  const std::size_t begin = line.find_first_not_of(" *", std::min(kDigits, line.size()));
  if (line.size() <= kDigits || begin == std::string::npos) return;
  const std::filesystem::path file = folder / line.substr(begin);
  if (sha256(read_file(file)) == line.substr(0, kDigits)) return;
  throw Failure(
      Exit::kInput,
      {.code = "E-RT-SUMS",
       .message = fmt::format("{} is not the file that SHA256SUMS lists", display_name(file)),
       .help = fmt::format("cd {} && sha256sum -c SHA256SUMS", shell_word(display_name(folder)))});
}

}  // namespace

RunningModel load_model(const std::filesystem::path& file, const std::string& serial) {
  const std::string bytes = read_regular_file(file, kMostModelBytes);
  const std::string sum = sha256(bytes);
  RunningModel out{.loaded = make(file, bytes, sum), .sha256 = sum};
  const std::string& own = out.loaded->model().serial;
  if (serial.empty() || serial == own) return out;
  throw Failure(Exit::kInput, {.code = "E-RT-SERIAL",
                               .message = fmt::format("{} was made for robot '{}', not for '{}'",
                                                      display_name(file), own, serial),
                               .help = "plumb inspect " + shell_word(display_name(file))});
}

void verify_sums(const std::filesystem::path& folder) {
  const std::filesystem::path sums = folder / "SHA256SUMS";
  if (!std::filesystem::exists(sums)) return;
  std::istringstream lines(read_file(sums));
  for (std::string line; std::getline(lines, line);) check_sum(folder, line);
}

}  // namespace plumb::drivers::rt
