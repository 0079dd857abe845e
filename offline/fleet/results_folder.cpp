// SPDX-License-Identifier: Apache-2.0
#include "fleet/results_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"

namespace plumb::offline::fleet {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargeResult = 64 << 10;  // bytes
constexpr std::size_t kLongestName = 150;       // bytes; file systems end at 255, endings included

/// The name as a file of JSON keeps it: bytes that are no UTF-8 are replaced.
std::string as_kept(const std::string& name) {
  return Json::parse(to_text(Json(name))).get<std::string>();
}

}  // namespace

fs::path ResultsFolder::file_of(const std::string& name) const {
  const std::string hash = sha256(name);
  const std::string file = name.size() <= kLongestName ? name : hash;
  return folder_ / "cells" / hash.substr(0, 2) / (file + ".json");
}

std::optional<CellSummary> ResultsFolder::kept(const std::string& name,
                                               const std::vector<SummaryInput>& inputs,
                                               Asked asked) const {
  std::error_code ignored;
  if (!fs::is_regular_file(file_of(name), ignored)) return std::nullopt;
  try {
    Json json = Json::parse(read_regular_file(file_of(name), kMostCellBytes));
    const Json sum = json.at("sha256");
    json.erase("sha256");
    if (sum != sha256(to_text(json))) return std::nullopt;
    CellSummary out = summary_from(json);
    const bool holds = asked == Asked::kFit || out.diagnosis || !out.ok;
    if (holds && out.inputs == inputs && out.name == as_kept(name)) return out;
  } catch (const nlohmann::json::exception&) {
    // Cut off, edited, or of another version: it is made anew.
  } catch (const Failure&) {
  }
  return std::nullopt;
}

void ResultsFolder::make_folder_of(const std::string& name) const {
  std::error_code error;
  fs::create_directories(file_of(name).parent_path(), error);
  if (error)
    throw Failure(Exit::kEnvironment,
                  {.code = "E-WRITE",
                   .message = "cannot write " + display_name(folder_) + ": " + error.message(),
                   .help = "another folder for the results: -o DIR"});
}

void ResultsFolder::keep(const CellSummary& summary) const {
  make_folder_of(summary.name);
  Json json = to_json(summary);
  json["sha256"] = sha256(to_text(json));
  write_file_atomically(file_of(summary.name), to_text(json));
}

void ResultsFolder::check_writable(const std::string& name) const {
  make_folder_of(name);
  const fs::path probe = file_of(name).string() + fmt::format(".{}.probe", ::getpid());
  write_file_atomically(probe, std::string(kLargeResult, ' '));
  std::error_code ignored;
  fs::remove(probe, ignored);
}

}  // namespace plumb::offline::fleet
