// SPDX-License-Identifier: Apache-2.0
#include "rt/snapshots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "rt/lost_words.hpp"
#include "rt/record_disk.hpp"
#include "rt/utc.hpp"

namespace plumb::drivers::rt {
namespace {

/// Longest time for which further faults extend a snapshot.
constexpr std::int64_t kLongest_ns = 60'000'000'000;
constexpr std::string_view kFaultKind = "fault", kHoldKind = "hold";
constexpr std::size_t kStampSize = std::string_view("20261125T093012.123Z-").size();

constexpr Lost kNobodysDoing = Lost::kTarget | Lost::kJoints | Lost::kController | Lost::kRobot |
                               Lost::kComparison | Lost::kMotion | Lost::kArmAway |
                               Lost::kArmStill | Lost::kStall | Lost::kRestart | Lost::kAnswers;

std::int64_t ns_of(double seconds) { return static_cast<std::int64_t>(1e9 * seconds); }

/// The time as the name of a file has it: "20261125T093012.123Z".
std::string stamp(std::int64_t wall_ms) {
  std::string out = utc_text(wall_ms);
  std::erase_if(out, [](char c) { return c == '-' || c == ':'; });
  return out;
}

std::string kind_in(const std::string& reason) { return reason.substr(0, reason.find('-')); }

}  // namespace

std::string snapshot_reason(SessionState before, const RecordEntry& now) {
  if (now.state == SessionState::kFault && before != SessionState::kFault)
    return fmt::format("{}-{}", kFaultKind, to_string(now.cause));
  if (now.state != SessionState::kHold || before != SessionState::kActive) return "";
  const auto words = lost_words(now.lost & kNobodysDoing);
  return words.empty() ? "" : fmt::format("{}-{}", kHoldKind, words.front());
}

Snapshots::Snapshots(const RecordSettings& settings, std::filesystem::path folder)
    : settings_(settings), folder_(std::move(folder)) {}

Snapshots::~Snapshots() = default;

void Snapshots::begin(const std::string& lines, std::int64_t now_ns) {
  if (!on()) return;
  const std::int64_t wanted_ns = now_ns - ns_of(settings_.before_s);
  while (kept_.size() > 1 && kept_[1].begun_ns <= wanted_ns) kept_.pop_front();
  kept_.push_back({now_ns, ""});
  add(lines);
}

void Snapshots::add(const std::string& lines) {
  if (kept_.empty()) return;
  kept_.back().text += lines;
  for (Open& one : open_) one.file->add(lines);
}

std::filesystem::path Snapshots::make(const std::string& reason, std::int64_t now_ns,
                                      std::int64_t wall_ms) {
  if (!on() || kept_.empty()) return {};
  const std::int64_t end_ns = now_ns + ns_of(settings_.after_s);
  for (Open& one : open_) {
    if (one.reason != reason) continue;
    one.end_ns = std::min(end_ns, one.begun_ns + kLongest_ns);
    return {};
  }
  std::error_code failed;
  std::filesystem::create_directory(folder_, failed);
  auto file =
      std::make_unique<LineFile>(folder_ / fmt::format("{}-{}.log", stamp(wall_ms), reason));
  for (const Stretch& stretch : kept_) file->add(stretch.text);
  file->flush();
  failure_.clear();
  note_error(*file);
  if (file->error() != 0) return {};
  last_ = file->file();
  ++made_;
  open_.push_back({std::move(file), reason, now_ns, end_ns});
  remove_oldest(kind_in(reason));
  return last_;
}

void Snapshots::note_error(const LineFile& file) {
  if (file.error() != 0)
    failure_ = why_not_written(file.file(), file.error(), "the snapshot", real_disk());
}

void Snapshots::tend(std::int64_t now_ns) {
  for (Open& one : open_) {
    one.file->flush();
    if (now_ns < one.end_ns && one.file->error() == 0) continue;
    one.file->sync();
    note_error(*one.file);
    one.file.reset();
  }
  std::erase_if(open_, [](const Open& one) { return one.file == nullptr; });
}

void Snapshots::close() {
  for (Open& one : open_) one.end_ns = 0;
  tend(1);
}

/// Names are ordered as their times.
void Snapshots::remove_oldest(const std::string& kind) const {
  std::vector<std::string> names;
  std::error_code ended;
  for (std::filesystem::directory_iterator at(folder_, ended), end; !ended && at != end;
       at.increment(ended)) {
    const std::string name = at->path().filename().string();
    if (is_snapshot(name) && name.compare(kStampSize, kind.size(), kind) == 0)
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  std::erase(names, last_.filename().string());
  const auto others = static_cast<std::size_t>(settings_.snapshots - 1);
  for (std::size_t i = 0; i + others < names.size(); ++i) {
    std::error_code ignored;
    std::filesystem::remove(folder_ / names[i], ignored);
  }
}

std::filesystem::path snapshot_folder(const std::filesystem::path& journal) {
  if (journal.empty()) return {};
  const std::string name = journal.stem().string();
  const bool own = name == "events";  // in the folder of the run, which needs no name of its own
  return journal.parent_path() / (own ? "snapshots" : name + "-snapshots");
}

bool is_snapshot(const std::string& name) {
  constexpr std::string_view kForm = "00000000T000000.000Z-";
  if (name.size() < kForm.size() || !name.ends_with(".log")) return false;
  for (std::size_t i = 0; i < kForm.size(); ++i) {
    const bool digit = name[i] >= '0' && name[i] <= '9';
    if (kForm[i] == '0' ? !digit : name[i] != kForm[i]) return false;
  }
  const std::string_view rest = std::string_view(name).substr(kForm.size());
  return rest.starts_with(std::string(kFaultKind) + "-") ||
         rest.starts_with(std::string(kHoldKind) + "-");
}

}  // namespace plumb::drivers::rt
