// SPDX-License-Identifier: Apache-2.0
#include "rt/line_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <tuple>

namespace plumb::drivers::rt {
namespace {

/// Bytes that are collected before they are written. Chosen: few system calls, little to lose.
constexpr std::size_t kBlock = 64 << 10;

}  // namespace

LineFile::LineFile(std::filesystem::path file)
    : file_(std::move(file)),
      fd_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644)),
      error_(fd_ < 0 ? errno : 0) {}

LineFile::~LineFile() {
  if (fd_ < 0) return;
  flush();
  if (length_ == 0 && !removed()) ::unlink(file_.c_str());
  ::close(fd_);
}

void LineFile::add(const std::string& lines) {
  if (error_ != 0) return;
  text_ += lines;
  if (text_.size() >= kBlock) flush();
}

/// After a failure the file is cut back to its last whole line, as far as the disk allows that.
void LineFile::flush() {
  while (!text_.empty() && error_ == 0) {
    const auto written = ::write(fd_, text_.data(), text_.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      error_ = written < 0 ? errno : ENOSPC;
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

void LineFile::begin_sync() noexcept {
  if (fd_ >= 0) std::ignore = ::sync_file_range(fd_, 0, 0, SYNC_FILE_RANGE_WRITE);
}

void LineFile::sync() {
  flush();
  if (fd_ >= 0 && ::fdatasync(fd_) != 0 && error_ == 0) error_ = errno;
}

bool LineFile::removed() const noexcept {
  struct stat now {};
  return fd_ >= 0 && ::fstat(fd_, &now) == 0 && now.st_nlink == 0;
}

}  // namespace plumb::drivers::rt
