// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include "program/file.hpp"
#include "program/interrupt.hpp"
#include "program/problem.hpp"
#include "rt/machine_settings.hpp"

namespace plumb::drivers::rt {
namespace {

bool holds(const std::filesystem::path& file, const std::string& text) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && read_file(file) == text;
}

void refuse_other_content(const std::filesystem::path& root,
                          std::span<const MachineSetting> settings) {
  std::vector<Problem> problems;
  for (const MachineSetting& setting : settings) {
    const auto file = root / setting.file;
    if (!would_replace(file) || holds(file, setting.text)) continue;
    problems.push_back(
        {.code = "E-EXISTS",
         .message = fmt::format("{} is already there, with other content", file.string()),
         .help = "to replace it: plumb-rt doctor --fix --force"});
  }
  if (!problems.empty()) throw Failure(Exit::kUsage, std::move(problems));
}

void need_root(const std::filesystem::path& root) {
  if (root != "/" || ::geteuid() == 0) return;
  throw Failure(Exit::kEnvironment, {.code = "E-FIX-RIGHTS",
                                     .message = "only root may write settings of this machine",
                                     .help = "sudo plumb-rt doctor --fix"});
}

}  // namespace

const char* to_string(Fix::State state) {
  switch (state) {
    case Fix::State::kWritten:
      return "written";
    case Fix::State::kWouldWrite:
      return "would write";
    case Fix::State::kThereAlready:
      return "there already";
  }
  return "written";
}

std::vector<Fix::File> write_settings(const std::filesystem::path& root,
                                      std::span<const MachineSetting> settings, FixMode mode) {
  if (mode != FixMode::kDryRun) need_root(root);
  if (mode != FixMode::kForce) refuse_other_content(root, settings);
  std::vector<Fix::File> out;
  const Writing writing;
  for (const MachineSetting& setting : settings) {
    const auto file = root / setting.file;
    out.push_back({.path = file, .then = setting.then});
    if (holds(file, setting.text)) {
      out.back().state = Fix::State::kThereAlready;
    } else if (mode == FixMode::kDryRun) {
      out.back().state = Fix::State::kWouldWrite;
    } else {
      std::filesystem::create_directories(file.parent_path());
      write_file_atomically(file, setting.text);
      // Whoever calls: these are read by programs of other users.
      std::filesystem::permissions(file, std::filesystem::perms(0644));
    }
  }
  return out;
}

std::string to_text(const Fix& fix) {
  std::string out = "\nSettings:\n";
  for (const auto& [path, state, then] : fix.files)
    out += fmt::format("{:<14} {}\n{:<14} > {}\n", to_string(state), path.string(), "", then);
  out += "\nBy hand:\n";
  for (const std::string& sentence : fix.beyond) out += sentence + "\n";
  return out;
}

Json to_json(const Fix& fix) {
  Json files = Json::array();
  for (const auto& [path, state, then] : fix.files)
    files.push_back({{"file", path.string()}, {"state", to_string(state)}, {"then", then}});
  return {{"files", files}, {"by_hand", fix.beyond}};
}

}  // namespace plumb::drivers::rt
