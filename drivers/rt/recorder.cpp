// SPDX-License-Identifier: Apache-2.0
#include "rt/recorder.hpp"

#include "plumb/drivers/time_source.hpp"
#include "rt/utc.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr std::int64_t kPause_ns = 10'000'000;  // between two looks for new entries
/// Between two copies of the whole session, from which a replay can begin.
constexpr std::int64_t kCopyEvery_ns = 5'000'000'000;

}  // namespace

Recorder::Recorder(const Files& files, const BusLayout& layout, const std::string& bus,
                   RunShared& shared, const SessionStart& start, RecordDisk disk)
    : shared_(shared),
      text_(layout, bus),
      snapshots_(files.record, files.snapshots),
      session_(start) {
  if (!files.record.file.empty()) {
    RecordWriter::check(files.record.file);
    record_ = std::make_unique<RecordWriter>(files.record, std::move(disk));
  }
  if (!files.answers.empty()) answers_ = std::make_unique<AnswerFile>(files.answers);
  tell();
}

void Recorder::check(const Files& files) {
  if (!files.record.file.empty()) RecordWriter::check(files.record.file);
  if (!files.answers.empty()) AnswerFile::check(files.answers);
}

Recorder::~Recorder() { stop(); }

void Recorder::start() {
  thread_ = std::thread([this] {
    while (!ended_) {
      pass(MonotonicTime::now_ns());
      std::ignore = MonotonicTime::sleep_until_ns(MonotonicTime::now_ns() + kPause_ns);
    }
  });
}

void Recorder::stop() {
  ended_ = true;
  const bool started = thread_.joinable();
  if (started) thread_.join();
  if (!started && !begun_) return;
  pass(MonotonicTime::now_ns());
  if (record_) record_->close();
  snapshots_.close();
  tell();
}

void Recorder::pass(std::int64_t now_ns) {
  if (!begun_) begin(text_.start(session_), now_ns);
  begun_ = true;
  for (RecordEntry entry; shared_.record.take(entry);) take(entry, now_ns);
  if (record_) record_->tend(now_ns);
  snapshots_.tend(now_ns);
  ask(now_ns);
  tell();
}

void Recorder::take(const RecordEntry& entry, std::int64_t now_ns) {
  using What = RecordEntry::What;
  note_gap(entry);
  if (entry.what == What::kState) return take_copy(entry, now_ns);
  const bool answer = entry.what == What::kSent || entry.what == What::kNotSent;
  if (answers_ && answer) answers_->add(entry.message);
  if (!record_ && !snapshots_.on()) return;
  add(text_.entry(entry, {}));
  if (entry.what == What::kTick) watch(entry, now_ns);
}

void Recorder::take_copy(const RecordEntry& entry, std::int64_t now_ns) {
  asked_ = false;
  gap_ = false;
  begin(text_.entry(entry, shared_.copy.bytes()), now_ns);
}

void Recorder::begin(const std::string& lines, std::int64_t now_ns) {
  begun_ns_ = now_ns;
  if (record_) record_->begin(lines, now_ns);
  snapshots_.begin(lines, now_ns);
}

void Recorder::add(const std::string& lines) {
  if (record_) record_->add(lines);
  snapshots_.add(lines);
}

/// Looks for what is worth a snapshot.
void Recorder::watch(const RecordEntry& step, std::int64_t now_ns) {
  const std::string reason = state_ ? snapshot_reason(*state_, step) : "";
  state_ = step.state;
  if (reason.empty()) return;
  const std::string failure = snapshots_.failure();
  const std::int64_t ago_ms = (now_ns - step.tick.now_ns) / 1'000'000;
  const auto file = snapshots_.make(reason, now_ns, utc_ns() / 1'000'000 - ago_ms);
  const std::scoped_lock lock(mutex_);
  if (!file.empty())
    notices_.push_back({"snapshot", {{"file", file.string()}, {"reason", reason}}});
  else if (!snapshots_.failure().empty() && snapshots_.failure() != failure)
    notices_.push_back({"snapshot-failed", {{"reason", snapshots_.failure()}}});
}

/// Entries that the ring dropped are missing just before this one.
void Recorder::note_gap(const RecordEntry& next) {
  if (next.dropped == lost_) return;
  add(text_.gap(next.dropped - lost_));
  lost_ = next.dropped;
  gap_ = true;
}

/// Asks for a copy of the session when one is due.
void Recorder::ask(std::int64_t now_ns) {
  if (asked_ || (!record_ && !snapshots_.on())) return;
  const bool due = now_ns - begun_ns_ >= kCopyEvery_ns;
  if (!due && !gap_ && !(record_ && record_->wants_beginning())) return;
  asked_ = true;
  shared_.copy.ask();
}

void Recorder::tell() {
  RecordFacts now;
  if (record_) {
    now.file = record_->file().string();
    now.failure = record_->failure();
    now.files = record_->files();
    now.bytes = record_->bytes();
  }
  now.lost = shared_.record.lost();
  if (snapshots_.on()) now.snapshot_folder = snapshots_.folder().string();
  now.snapshot = snapshots_.last().string();
  now.snapshot_failure = snapshots_.failure();
  now.snapshots = snapshots_.made();
  const int answers_error = answers_ ? answers_->write() : 0;
  const std::scoped_lock lock(mutex_);
  if (answers_error != 0 && !answers_stopped_)
    notices_.push_back(
        {"answers-stopped",
         {{"reason", why_not_written(answers_->file(), answers_error,
                                     "the file of corrected targets", real_disk())}}});
  answers_stopped_ = answers_error != 0;
  if (facts_.failure.empty() && !now.failure.empty())
    notices_.push_back({"record-paused", {{"reason", now.failure}}});
  if (!facts_.failure.empty() && now.failure.empty())
    notices_.push_back({"record-resumed", {{"file", now.file}}});
  facts_ = now;
}

RecordFacts Recorder::facts() const {
  const std::scoped_lock lock(mutex_);
  return facts_;
}

std::vector<RecordNotice> Recorder::take_notices() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(notices_, {});
}

}  // namespace plumb::drivers::rt
