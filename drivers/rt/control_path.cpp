// SPDX-License-Identifier: Apache-2.0
#include "rt/control_path.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr int kAlive_ms = 2000;

[[noreturn]] void refuse(const char* code, std::string what, std::string help) {
  throw Failure(Exit::kEnvironment,
                {.code = code, .message = std::move(what), .help = std::move(help)});
}

}  // namespace

std::string name_of_run(const std::filesystem::path& dir) {
  constexpr std::size_t kDigitsOfName = 12;
  return "plumb-rt-" +
         sha256(std::filesystem::weakly_canonical(dir).string()).substr(0, kDigitsOfName);
}

std::vector<std::filesystem::path> control_paths(const std::filesystem::path& dir) {
  const std::string name = name_of_run(dir) + ".sock";
  std::vector<std::filesystem::path> out{std::filesystem::path("/run/plumb") / name};
  if (const char* const own = std::getenv("XDG_RUNTIME_DIR"); own != nullptr && *own != '\0')
    out.push_back(std::filesystem::path(own) / name);
  out.push_back(dir / "plumb-rt.sock");
  return out;
}

ControlSocket open_control(const std::filesystem::path& dir) {
  const auto paths = control_paths(dir);
  for (const auto& path : paths)
    if (ask(path, "status\n", kAlive_ms))
      refuse("E-RT-RUNNING", fmt::format("another plumb-rt runs {}", display_name(dir)),
             "plumb-rt status " + shell_word(display_name(dir)));
  int error = ENOENT;
  for (const auto& path : paths) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(path.parent_path(), ignored)) continue;
    if (std::filesystem::is_socket(path, ignored)) std::filesystem::remove(path, ignored);
    if (auto listening = listen_unix(path)) return {path, std::move(*listening)};
    error = errno;
  }
  refuse("E-RT-CONTROL", fmt::format("no place for the control socket: {}", std::strerror(error)),
         "set XDG_RUNTIME_DIR to a folder of yours");
}

std::string ask_control(const std::filesystem::path& dir, const std::string& request,
                        int within_ms) {
  for (const auto& path : control_paths(dir))
    if (const auto answer = ask(path, request, within_ms)) return *answer;
  refuse("E-RT-NOT-RUNNING", fmt::format("no plumb-rt runs {}", display_name(dir)),
         "plumb-rt run " + shell_word(display_name(dir)));
}

}  // namespace plumb::drivers::rt
