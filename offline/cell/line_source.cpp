// SPDX-License-Identifier: Apache-2.0
#include "cell/line_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "program/file.hpp"
#include "program/problem.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRead = 1 << 18;  // bytes at a time

[[noreturn]] void cannot_read(const fs::path& file, const std::string& why) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  throw Failure(Exit::kInput,
                {.code = "E-READ",
                 .message = fmt::format("cannot read {}: {}", display_name(file), why),
                 .help = "check the path: ls -l " + folder.string()});
}

}  // namespace

LineSource::LineSource(const fs::path& file) : file_(file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) cannot_read(file, "no such file");
  if (error) cannot_read(file, error.message());
  if (fs::is_directory(status)) cannot_read(file, "it is a directory");
  if (fs::is_regular_file(status)) size_ = fs::file_size(file, error);
  fd_ = ::open(file.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC);
  if (fd_ < 0) cannot_read(file, std::strerror(errno));
}

LineSource::~LineSource() { ::close(fd_); }

bool LineSource::next(std::string& block) {
  while (!ended_ && (rest_.size() < kBlock || rest_.rfind('\n') == std::string::npos))
    ended_ = !read_more();
  const std::size_t last = rest_.rfind('\n');
  const std::size_t whole = ended_ ? rest_.size() : last + 1;
  block.assign(rest_, 0, whole);
  rest_.erase(0, whole);
  first_line_ = next_line_;
  next_line_ += static_cast<int>(std::count(block.begin(), block.end(), '\n'));
  return !block.empty();
}

/// False at the end of the file.
bool LineSource::read_more() {
  const std::size_t size = rest_.size();
  rest_.resize(size + kRead);
  ssize_t n = 0;
  do n = ::read(fd_, rest_.data() + size, kRead);
  while (n < 0 && errno == EINTR);
  rest_.resize(size + static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  if (n < 0) cannot_read(file_, std::strerror(errno));
  digest_.add(std::string_view(rest_).substr(size));
  check_length(size);
  return n > 0;
}

/// Only the line that was not whole before can have grown too long.
void LineSource::check_length(std::size_t old_size) const {
  const std::size_t before = old_size == 0 ? std::string::npos : rest_.rfind('\n', old_size - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  const std::size_t end = std::min(rest_.find('\n', begin), rest_.size());
  if (end - begin <= kLongestLine) return;
  const auto line =
      next_line_ + std::count(rest_.begin(), rest_.begin() + static_cast<long>(begin), '\n');
  throw Failure(
      Exit::kInput,
      {.code = "E-CSV-LINE",
       .message = "a line is longer than 1 MB: this is no table of measurements",
       .place = Place{.file = display_name(file_), .line = static_cast<int>(line)},
       .help = fmt::format("look at its beginning: head -c 300 {}", display_name(file_))});
}

}  // namespace plumb::offline
