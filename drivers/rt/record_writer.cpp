// SPDX-License-Identifier: Apache-2.0
#include "rt/record_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "program/file.hpp"
#include "program/problem.hpp"
#include "rt/creatable.hpp"

namespace plumb::drivers::rt {
namespace {

/// How often the disk and the files are looked at, and the longest pause after a failure: pauses
/// that follow each other closely are doubled up to it. Chosen: a disk that fails again and again
/// is left alone, and the record of a disk that has recovered lacks a minute at most.
constexpr std::int64_t kLook_ns = 1'000'000'000, kMostPatience_ns = 60 * kLook_ns;
constexpr std::int64_t kDay_s = 86'400;
constexpr std::uint64_t kSpare = 1'000'000;  // free bytes beyond the floor before it goes on

/// What is still written to a file while its successor waits for a beginning.
std::uint64_t last_words(std::uint64_t file_bytes) {
  return std::min<std::uint64_t>(100'000, file_bytes / 8);
}

}  // namespace

void RecordWriter::check(const std::filesystem::path& file) {
  const std::filesystem::path next = next_part(file);
  const int error = creation_error(next);
  if (error == 0 || error == ENOSPC || error == EDQUOT) return;
  throw Failure(Exit::kEnvironment,
                {.code = "E-RT-RECORD",
                 .message = fmt::format("cannot write the record {}: {}", display_name(next),
                                        std::strerror(error)),
                 .help = "choose another file in rt.toml, [log] record, or leave it out"});
}

RecordWriter::RecordWriter(const RecordSettings& settings, RecordDisk disk)
    : settings_(settings), disk_(std::move(disk)), name_(next_part(settings.file)) {}

RecordWriter::~RecordWriter() = default;

bool RecordWriter::wants_beginning() const noexcept {
  if (!out_) return may_open_;
  const std::uint64_t most = settings_.file_bytes();
  if (out_->bytes() + last_words(most) >= most) return true;
  const std::int64_t age_s = disk_.wall_s() - opened_s_;
  return settings_.max_age_days > 0 && age_s >= settings_.max_age_days * kDay_s / 10;
}

void RecordWriter::begin(const std::string& lines, std::int64_t now_ns) {
  const bool next = wants_beginning();
  if (next) {
    out_.reset();
    open(now_ns);
  }
  if (!out_) return;
  out_->add(lines);
  out_->flush();
  pause_on_error(now_ns);
  std::error_code ignored;
  if (out_) failure_.clear();
  if (!out_ && next) std::filesystem::remove(name_, ignored);  // no replay could begin with it
}

void RecordWriter::add(const std::string& lines) {
  if (out_) out_->add(lines);
}

void RecordWriter::open(std::int64_t now_ns) {
  may_open_ = false;
  remove_old(settings_.file_bytes());
  if (!has_space()) return pause(failure_, now_ns);
  name_ = next_part(settings_.file);
  out_ = std::make_unique<LineFile>(name_);
  ++files_;
  opened_s_ = disk_.wall_s();
  opened_ns_ = now_ns;
  pause_on_error(now_ns);
}

/// If the last pause ended only a moment ago, the next attempt waits longer.
void RecordWriter::pause(const std::string& why, std::int64_t now_ns) {
  const bool again = opened_ns_ != 0 && now_ns - opened_ns_ < kMostPatience_ns;
  patience_ns_ = again ? std::clamp(2 * patience_ns_, kLook_ns, kMostPatience_ns) : kLook_ns;
  retry_ns_ = now_ns + patience_ns_;
  out_.reset();
  may_open_ = false;
  failure_ = why;
}

void RecordWriter::pause_on_error(std::int64_t now_ns) {
  if (!out_ || out_->error() == 0) return;
  pause(why_not_written(name_, out_->error(), "the record", disk_), now_ns);
}

bool RecordWriter::is_open(const RecordPart& part) const {
  return out_ && part.file.filename() == name_.filename();
}

std::string RecordWriter::full_text(const std::filesystem::path& folder, std::uint64_t free) const {
  const auto mb = [](std::uint64_t bytes) { return 1e-6 * static_cast<double>(bytes); };
  const bool full = free < kSpare;
  const std::string floor = fmt::format("the record leaves free_space_floor_mb = {} alone, and ",
                                        settings_.free_space_floor_mb);
  return fmt::format(
      "{}: the disk {} {:.1f} MB are free; {}is no longer written until {:.0f} MB are free, "
      "everything "
      "else goes on; make room on it, or lower {}max_total_mb in [record] of rt.toml",
      folder.string(), full ? "is full," : "is nearly full,", mb(free),
      settings_.free_space_floor_mb > 0 ? floor : "the record ",
      mb(settings_.floor_bytes() + kSpare), settings_.free_space_floor_mb > 0 ? "that or " : "");
}

/// Removes old files of the record until the floor is kept. If all of them would not be enough,
/// none is removed, and failure_ says so.
bool RecordWriter::has_space() {
  const auto folder = std::filesystem::absolute(settings_.file).parent_path();
  const std::uint64_t wanted = settings_.floor_bytes() + (out_ ? 0 : kSpare);
  const std::uint64_t free = disk_.free_bytes(folder);
  if (free >= wanted) return true;
  auto parts = record_parts(settings_.file);
  std::erase_if(parts, [this](const RecordPart& part) { return is_open(part); });
  std::uint64_t removable = 0;
  for (const RecordPart& part : parts) removable += part.bytes;
  for (const RecordPart& part : parts) {
    if (free + removable < wanted) break;
    std::error_code ignored;
    std::filesystem::remove(part.file, ignored);
    if (disk_.free_bytes(folder) >= wanted) return true;
  }
  failure_ = full_text(folder, free);
  return false;
}

/// Removes the oldest files until `coming` more bytes keep within the total, and what is too old.
void RecordWriter::remove_old(std::uint64_t coming) {
  const auto parts = record_parts(settings_.file);
  std::uint64_t total = 0;
  files_ = parts.size();
  for (const RecordPart& part : parts) total += part.bytes;
  const std::int64_t now_s = disk_.wall_s();
  for (const RecordPart& part : parts) {
    const bool too_much = settings_.total_bytes() > 0 && total + coming > settings_.total_bytes();
    const bool too_old =
        settings_.max_age_days > 0 && now_s - part.written_s > settings_.max_age_days * kDay_s;
    if (is_open(part) || !(too_much || too_old)) continue;
    std::error_code ignored;
    if (!std::filesystem::remove(part.file, ignored)) continue;
    total -= part.bytes;
    --files_;
  }
  bytes_ = total;
}

void RecordWriter::look(std::int64_t now_ns) {
  looked_ns_ = now_ns;
  remove_old(0);
  if (out_) out_->begin_sync();
  if (out_ && out_->removed()) pause(name_.string() + ": was removed", now_ns);
  if (out_ && !has_space()) pause(failure_, now_ns);
  if (!out_ && now_ns >= retry_ns_) may_open_ = true;
}

void RecordWriter::tend(std::int64_t now_ns) {
  if (out_) out_->flush();
  pause_on_error(now_ns);
  if (now_ns - looked_ns_ >= kLook_ns) look(now_ns);
}

void RecordWriter::close() {
  if (out_) out_->sync();
  out_.reset();
}

}  // namespace plumb::drivers::rt
