// SPDX-License-Identifier: Apache-2.0
#include "rt/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <tuple>

#include "plumb/drivers/time_source.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "rt/lost_words.hpp"
#include "rt/record_disk.hpp"
#include "rt/standard_error.hpp"
#include "rt/utc.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kJournalName = "events.jsonl";
constexpr std::int64_t kMinute_ns = 60'000'000'000;
/// Faults that follow each other within this time count as one series. Chosen: an operator who
/// acknowledges again and again without removing the cause needs minutes.
constexpr std::int64_t kSeries_ns = 10 * kMinute_ns;
/// Bytes read of one file: more than a journal can have, in case another program wrote it.
constexpr std::uintmax_t kMostRead = 4 * Journal::kMostBytes;

/// The wall time of a moment of CLOCK_MONOTONIC in UTC, ISO 8601 with milliseconds.
std::string wall_time(std::int64_t monotonic_ns) {
  return utc_text((utc_ns() - (MonotonicTime::now_ns() - monotonic_ns)) / 1'000'000);
}

const char* word_of(LinkState link) {
  return link == LinkState::kUp ? "up" : link == LinkState::kDegraded ? "degraded" : "down";
}

/// True if the last line has no end, because its writer was killed or the disk was full.
bool ends_within_line(const fs::path& file, off_t size) {
  if (size == 0) return false;
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  char last = '\n';
  if (fd >= 0 && ::pread(fd, &last, 1, size - 1) != 1) last = '\n';
  if (fd >= 0) ::close(fd);
  return last != '\n';
}

fs::path older(const fs::path& file) { return file.string() + ".1"; }
fs::path of_fault(const fs::path& file) { return file.string() + ".fault"; }

/// The end of a file, from the beginning of a line on; empty if it cannot be read.
std::string last_lines(const fs::path& file, std::uint64_t most) {
  std::error_code error;
  const std::uintmax_t size = fs::is_regular_file(file, error) ? fs::file_size(file, error) : 0;
  std::ifstream in(file, std::ios::binary);
  if (error || size == 0) return "";
  std::string cut;
  if (size > most) {
    in.seekg(static_cast<std::streamoff>(size - most));
    std::getline(in, cut);
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

std::optional<Json> event_in(const std::string& line) {
  Json out = Json::parse(line, nullptr, false);
  const bool sound = out.is_object() && out.contains("event") && out["event"].is_string();
  return sound ? std::optional(std::move(out)) : std::nullopt;
}

std::string time_of(const Json& event) {
  return event.contains("time") && event["time"].is_string() ? event["time"].get<std::string>()
                                                             : "";
}

/// The inputs that are lost, and why the controller refuses what is written to it, if it does.
Json lost_details(const SessionMoment& now) {
  Json out{{"inputs", lost_words(now.lost)}};
  if (now.refusal.any()) out["refused"] = refusal_text(now.refusal);
  return out;
}

/// The name of the journal in a folder that the journals of several deploy folders share.
std::string name_elsewhere(const fs::path& folder) {
  const std::string name = fs::weakly_canonical(folder).string();
  return fmt::format("{}-{}", sha256(name).substr(0, 12), kJournalName);
}

}  // namespace

Journal::Journal(fs::path file, Echo echo) : file_(std::move(file)), echo_(echo) {
  before_.model = 0;
}

void Journal::note(const char* event, const Json& details) {
  const std::int64_t now_ns = MonotonicTime::now_ns();
  if (room(now_ns, event)) write(now_ns, event, details);
}

void Journal::note_change(const SessionMoment& now) {
  const auto say = [&](const char* event, const Json& details) {
    if (room(now.time_ns, event)) write(now.time_ns, event, details);
  };
  if (now.model != before_.model) say("model", {{"fingerprint", now.model}});
  if (now.link != before_.link) say("link", {{"state", word_of(now.link)}});
  if (now.lost != before_.lost) say("lost", lost_details(now));
  if (now.state != before_.state) {
    Json details{{"from", to_string(before_.state)},
                 {"to", to_string(now.state)},
                 {"mode", to_string(now.mode)},
                 {"applied_um", 1e6 * now.applied_m}};
    if (now.state == SessionState::kHold) details["inputs"] = lost_words(now.lost);
    write(now.time_ns, "state", details);
  }
  if (now.cause != before_.cause && now.cause != FaultCause::kNone) {
    write(now.time_ns, "fault",
          {{"cause", to_string(now.cause)},
           {"applied_um", 1e6 * now.applied_m},
           {"pose_difference_um", 1e6 * now.difference_m},
           {"fingerprint", now.model}});
    keep_what_led_to_fault(now.time_ns);
  }
  if (refused(now.status) != refused(before_.status))
    say(refused(now.status) ? "refused" : "solved", {{"status", plumb::to_string(now.status)}});
  before_ = now;
}

/// True if this minute has room for one event more of the kind; else it is counted.
bool Journal::room(std::int64_t monotonic_ns, const char* event) {
  tend(monotonic_ns);
  Minute& minute = minutes_.try_emplace(event, Minute{.begin_ns = monotonic_ns}).first->second;
  if (++minute.written <= kMostPerMinute) return true;
  ++minute.left_out;
  return false;
}

void Journal::tend(std::int64_t monotonic_ns) {
  std::erase_if(minutes_, [&](const auto& of) {
    const auto& [event, minute] = of;
    if (monotonic_ns - minute.begin_ns < kMinute_ns) return false;
    if (minute.left_out > 0)
      write(monotonic_ns, "left-out", {{"of", event}, {"events", minute.left_out}});
    return true;
  });
}

void Journal::write(std::int64_t monotonic_ns, const char* event, const Json& details) {
  Json line{{"time", wall_time(monotonic_ns)},
            {"monotonic_s", 1e-9 * static_cast<double>(monotonic_ns)},
            {"event", event}};
  line.update(details);
  if (echo_ == Echo::kStderr) std::ignore = say_at_once("plumb-rt: " + event_text(line) + "\n");
  append(line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void Journal::append(const std::string& line) {
  if (file_.empty()) return;
  struct stat now {};
  if (::stat(file_.c_str(), &now) == 0 &&
      static_cast<std::uint64_t>(now.st_size) + line.size() > kMostBytes)
    std::ignore = ::rename(file_.c_str(), older(file_).c_str());
  const int fd =
      ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0644);
  const bool plain = fd >= 0 && ::fstat(fd, &now) == 0 && S_ISREG(now.st_mode);
  const std::string text = (plain && ends_within_line(file_, now.st_size) ? "\n" : "") + line;
  if (plain) errno = ENOSPC;  // a write that is cut short sets no errno: the disk is full
  const bool written =
      plain && ::write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int error = errno;
  failure_ = written           ? ""
             : plain || fd < 0 ? why_not_written(file_, error, "the journal", real_disk())
                               : "not a regular file";
  if (fd >= 0) ::close(fd);
}

/// Only for the first fault of a series: its cause lies before that one.
void Journal::keep_what_led_to_fault(std::int64_t monotonic_ns) {
  if (file_.empty() || (fault_ns_ && monotonic_ns - *fault_ns_ < kSeries_ns)) return;
  const std::string newest = last_lines(file_, kMostOfFault);
  try {
    write_file_atomically(of_fault(file_),
                          last_lines(older(file_), kMostOfFault - newest.size()) + newest);
    fault_ns_ = monotonic_ns;
  } catch (const Failure& failure) {
    failure_ = failure.problems().front().message;
  }
}

std::vector<fs::path> journal_places(const fs::path& folder) {
  std::vector<fs::path> out{folder / kJournalName};
  if (const char* const state = std::getenv("STATE_DIRECTORY"); state != nullptr && *state != '\0')
    out.push_back(fs::path(state) / name_elsewhere(folder));
  out.push_back(fs::path("/var/lib/plumb-rt") / fs::weakly_canonical(folder).filename() /
                name_elsewhere(folder));
  return out;
}

fs::path journal_file(const fs::path& folder, const fs::path& configured) {
  if (!configured.empty()) return configured;
  if (::access(folder.c_str(), W_OK) == 0) return folder / kJournalName;
  const char* const state = std::getenv("STATE_DIRECTORY");
  if (state == nullptr || *state == '\0') return {};
  return fs::path(state) / name_elsewhere(folder);
}

ReadEvents read_events(const fs::path& file, std::size_t most) {
  ReadEvents out;
  const auto read = [&](const fs::path& part) {
    std::vector<Json> events;
    std::istringstream in(last_lines(part, kMostRead));
    for (std::string line; std::getline(in, line);) {
      if (auto event = event_in(line))
        events.push_back(std::move(*event));
      else
        out.damaged += line.empty() ? 0 : 1;
    }
    return events;
  };
  const auto add = [&](std::vector<Json> events) {
    std::ranges::move(events, std::back_inserter(out.events));
  };
  std::vector<Json> led_to_fault = read(of_fault(file));
  add(read(older(file)));
  add(read(file));
  if (!out.events.empty())  // later ones are in the journal itself, of which NAME.fault is a copy
    std::erase_if(led_to_fault, [first = time_of(out.events.front())](const Json& event) {
      return time_of(event) >= first;
    });
  out.events.insert(out.events.begin(), std::move_iterator(led_to_fault.begin()),
                    std::move_iterator(led_to_fault.end()));
  if (out.events.size() > most)
    out.events.erase(out.events.begin(), out.events.end() - static_cast<std::ptrdiff_t>(most));
  return out;
}

std::string event_text(const Json& event) {
  const auto word = [&](const char* key) {
    return event.contains(key) && event[key].is_string() ? event[key].get<std::string>() : "";
  };
  std::string out = word("time") + "  " + word("event");
  for (const auto& [key, value] : event.items()) {
    if (key == "time" || key == "event" || key == "monotonic_s") continue;
    if (value.is_number_float())
      out += fmt::format("  {} {:.4g}", key, value.get<double>());
    else if (value.is_array() && value.empty())
      out += fmt::format("  {} none", key);
    else
      out +=
          fmt::format("  {} {}", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return out;
}

}  // namespace plumb::drivers::rt
