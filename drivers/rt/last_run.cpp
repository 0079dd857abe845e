// SPDX-License-Identifier: Apache-2.0
#include "rt/last_run.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>
#include <tuple>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/json.hpp"
#include "program/problem.hpp"
#include "rt/control_path.hpp"
#include "rt/standard_error.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr char kLastRunSchema[] = "plumb-rt-last-run/1";
constexpr std::uintmax_t kMostLastRunBytes = 4096;

std::filesystem::path last_run_file(const std::filesystem::path& folder) {
  const char* const own = std::getenv("STATE_DIRECTORY");  // several are separated by colons
  std::string first = own == nullptr ? "" : own;
  first = first.substr(0, first.find(':'));
  if (first.empty()) return folder / "plumb-rt.state";
  return std::filesystem::path(first) / (name_of_run(folder) + ".state");
}

/// Writing to a pipe would wait for its reader.
void need_regular(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored) || std::filesystem::is_regular_file(file, ignored))
    return;
  throw Failure(Exit::kEnvironment,
                {.code = "E-WRITE",
                 .message = fmt::format("{} is no regular file", display_name(file)),
                 .help = "ls -l " + file.string()});
}

FaultCause fault_of(const std::string& word) {
  for (int i = 0; i < kFaultCauses; ++i)
    if (word == to_string(static_cast<FaultCause>(i))) return static_cast<FaultCause>(i);
  throw std::invalid_argument("an unknown fault: " + word);
}

}  // namespace

LastRun::LastRun(const std::filesystem::path& folder, const std::string& model)
    : file_(last_run_file(folder)) {
  std::error_code ignored;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file_, ignored))) {
    need("it is the first run");
    return;
  }
  try {
    read(model);
  } catch (const Failure& failure) {
    need(
        fmt::format("what the last run left is not known: {}", failure.problems().front().message));
  } catch (const std::exception& error) {
    need(fmt::format("{} is damaged: {}", display_name(file_), error.what()));
  }
}

void LastRun::need(const std::string& why) {
  start_.acknowledgement = SessionStart::Acknowledgement::kNeeded;
  why_ = why;
}

void LastRun::read(const std::string& model) {
  const Json json = Json::parse(read_regular_file(file_, kMostLastRunBytes));
  if (json.at("schema") != kLastRunSchema) throw std::invalid_argument("another schema");
  content_ = {.ended = json.at("ended").get<bool>(),
              .fault = fault_of(json.at("fault").get<std::string>()),
              .acknowledged = json.at("acknowledged").get<std::string>()};
  start_.fault = content_.fault;
  if (content_.fault != FaultCause::kNone)
    need(fmt::format("the fault of the last run was not acknowledged: {}",
                     to_string(content_.fault)));
  else if (!content_.ended)
    need("the last run did not end well");
  else if (content_.acknowledged.empty())
    need("the last run was not acknowledged");
  else if (content_.acknowledged != model)
    need("it is the first run with this model");
}

bool LastRun::write(const Content& content) {
  if (failed_) return false;
  const Json json{{"schema", kLastRunSchema},
                  {"ended", content.ended},
                  {"fault", to_string(content.fault)},
                  {"acknowledged", content.acknowledged}};
  try {
    need_regular(file_);
    write_file_atomically(file_, json.dump(2) + "\n");
  } catch (const Failure& failure) {
    const Problem problem{.severity = Severity::kWarning,
                          .code = "W-RT-STATE",
                          .message = failure.problems().front().message,
                          .help = "without it every start needs an acknowledgement"};
    std::ignore = say_at_once(render(problem) + "\n");
    failed_ = true;
    return false;
  }
  content_ = content;
  return true;
}

void LastRun::begin() {
  const bool needed = start_.acknowledgement == SessionStart::Acknowledgement::kNeeded;
  Content next = content_;
  next.ended = false;
  next.fault = start_.fault;
  if (needed) next.acknowledged.clear();
  if (!write(next)) need("what the last run left is not known, since it cannot be written");
}

void LastRun::note(const SessionReport& report, const std::string& model) {
  if (report.counters.cycles == 0) return;
  Content next = content_;
  next.fault = report.state == SessionState::kFault ? report.cause : FaultCause::kNone;
  next.acknowledged = has(report.lost, Lost::kAcknowledge) ? "" : model;
  if (next != content_) write(next);
}

void LastRun::end() {
  Content next = content_;
  next.ended = true;
  write(next);
}

}  // namespace plumb::drivers::rt
