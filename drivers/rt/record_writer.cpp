// SPDX-License-Identifier: Apache-2.0
#include "rt/record_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "plumb/drivers/time_source.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "rt/creatable.hpp"
#include "rt/record_line.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr std::size_t kBlock = 64 << 10;
constexpr std::uint64_t kMega = 1'000'000;

std::filesystem::path free_name(const std::filesystem::path& file) {
  std::filesystem::path out = file;
  for (int i = 1; std::filesystem::exists(out); ++i) out = fmt::format("{}.{}", file.string(), i);
  return out;
}

[[noreturn]] void refuse_record(const std::filesystem::path& file, int error) {
  throw Failure(Exit::kEnvironment,
                {.code = "E-RT-RECORD",
                 .message = fmt::format("cannot write the record {}: {}", display_name(file),
                                        std::strerror(error)),
                 .help = "choose another file in rt.toml, [log] record, or leave it out"});
}

}  // namespace

void RecordWriter::check(const std::filesystem::path& file) {
  const std::filesystem::path free = free_name(file);
  if (const int error = creation_error(free); error != 0) refuse_record(free, error);
}

RecordWriter::RecordWriter(const std::filesystem::path& file, const BusLayout& layout,
                           std::string bus, int most_mb)
    : file_(free_name(file)), codec_(layout), bus_(std::move(bus)), most_mb_(most_mb) {
  fd_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (fd_ < 0) refuse_record(file_, errno);
}

RecordWriter::~RecordWriter() {
  flush();
  ::close(fd_);
}

bool RecordWriter::fits(std::size_t bytes) const noexcept {
  return most_mb_ == 0 || end_ + text_.size() + bytes <= kMega * static_cast<unsigned>(most_mb_);
}

void RecordWriter::add_line(const std::string& interface, const CanFrame& frame) {
  if (!failure_.empty()) return;
  const std::string line = to_line({interface, frame}) + "\n";
  if (!fits(line.size())) {
    flush();
    if (failure_.empty())
      failure_ = fmt::format("{}: reached record_max_mb = {}", file_.string(), most_mb_);
    return;
  }
  text_ += line;
  last_ns_ = frame.time_ns;
  if (text_.size() >= kBlock) flush();
}

void RecordWriter::add(const RecordEntry& entry) {
  using What = RecordEntry::What;
  if (!failure_.empty()) return;
  if (entry.what == What::kTick) return add_line(kTickName, tick_frame({entry.tick, entry.model}));
  for (CanFrame frame : codec_.encode(entry.message)) {
    frame.time_ns = entry.message.time_ns;
    add_line(entry.what == What::kNotSent ? kUnsentName : bus_, frame);
  }
}

void RecordWriter::begin(const SessionStart& start) {
  add_line(kStartName, start_frame(start, MonotonicTime::now_ns()));
}

void RecordWriter::note_lost(std::uint64_t lost) {
  if (lost == lost_ || !failure_.empty()) return;
  CanFrame frame{.length = 8, .time_ns = last_ns_};
  for (unsigned i = 0; i < 8; ++i)
    frame.data[i] = static_cast<std::uint8_t>((lost - lost_) >> (8 * i));
  add_line(kGapName, frame);
  lost_ = lost;
}

void RecordWriter::flush() {
  while (!text_.empty() && failure_.empty()) {
    const auto written = ::write(fd_, text_.data(), text_.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      failure_ = fmt::format("{}: {}", file_.string(), std::strerror(errno));
      std::ignore = ::ftruncate(fd_, static_cast<off_t>(length_));
      text_.clear();
      return;
    }
    const auto taken = static_cast<std::size_t>(written);
    const std::size_t last_end = text_.rfind('\n', taken - 1);
    if (last_end != std::string::npos && last_end < taken) length_ = end_ + last_end + 1;
    end_ += taken;
    text_.erase(0, taken);
  }
}

}  // namespace plumb::drivers::rt
