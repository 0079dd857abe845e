// SPDX-License-Identifier: Apache-2.0
#include "rt/last_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cstdlib>
#include <stdexcept>
#include <tuple>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/json.hpp"
#include "program/key_file.hpp"
#include "program/problem.hpp"
#include "rt/control_path.hpp"
#include "rt/standard_error.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr char kLastRunSchema[] = "plumb-rt-last-run/1";
constexpr std::uintmax_t kMostMachineIdBytes = 4096;

/// What others may have written.
struct NotBelieved : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A folder of this machine, by what a copy of it does not have, which may get its number once it
/// is removed; the number of its device changes from boot to boot. Empty if nothing is known of it.
std::string identity_of(const std::filesystem::path& folder) {
  struct statx found {};
  if (::statx(AT_FDCWD, folder.c_str(), 0, STATX_INO | STATX_BTIME, &found) != 0) return "";
  std::string machine;
  try {
    machine = read_regular_file("/etc/machine-id", kMostMachineIdBytes);
  } catch (const Failure&) {  // a container may have none
  }
  return sha256(fmt::format("{} {} {}.{:09}", machine, found.stx_ino, found.stx_btime.tv_sec,
                            found.stx_btime.tv_nsec))
      .substr(0, 16);
}

/// Where systemd lets this service keep its files; empty: it runs by itself.
std::filesystem::path state_directory() {
  const char* const own = std::getenv("STATE_DIRECTORY");  // several are separated by colons
  const std::string all = own == nullptr ? "" : own;
  return all.substr(0, all.find(':'));
}

std::filesystem::path last_run_file(const std::filesystem::path& folder) {
  const std::filesystem::path own = state_directory();
  return own.empty() ? folder / "plumb-rt.state" : own / (name_of_run(folder) + ".state");
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
    : file_(last_run_file(folder)),
      in_folder_(state_directory().empty()),
      folder_(in_folder_ ? identity_of(folder) : "") {
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
  } catch (const NotBelieved& why) {
    believed_ = false;
    need(fmt::format("{} is not believed: it {}", display_name(file_), why.what()));
  } catch (const std::exception& error) {
    need(fmt::format("{} is damaged: {}", display_name(file_), error.what()));
  }
}

void LastRun::need(const std::string& why) {
  start_.acknowledgement = SessionStart::Acknowledgement::kNeeded;
  why_ = why;
}

void LastRun::read(const std::string& model) {
  const OwnedText read = read_owned_text(file_);
  if (const std::string fault = rights_fault(read.owner, read.mode); !fault.empty())
    throw NotBelieved(fault);
  struct stat around {};
  if (::stat(file_.parent_path().c_str(), &around) == 0)
    if (const std::string fault = rights_fault(around.st_uid, around.st_mode); !fault.empty())
      throw NotBelieved("stands in a folder that " + fault);
  const Json json = Json::parse(read.text);
  if (json.at("schema") != kLastRunSchema) throw std::invalid_argument("another schema");
  if (json.value("folder", "") != folder_ || (in_folder_ && folder_.empty()))
    throw NotBelieved("was written in another folder, and came here as a copy");
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
                  {"folder", folder_},
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
  std::error_code ignored;
  if (!believed_) std::filesystem::remove(file_, ignored);  // its owner and mode shall not stay
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
