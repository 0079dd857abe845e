// SPDX-License-Identifier: Apache-2.0
#include "sandbox.hpp"

#include <fcntl.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utmp.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

void redirect(const std::string& file, int to) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (fd < 0 || ::dup2(fd, to) < 0) ::_exit(126);
}

struct Streams {
  std::string out, err;
};

std::vector<char*> arguments(const std::vector<std::string>& words) {
  std::vector<char*> out{const_cast<char*>(PLUMB_PROGRAM)};
  for (const auto& word : words) out.push_back(const_cast<char*>(word.c_str()));
  out.push_back(nullptr);
  return out;
}

pid_t start(const fs::path& folder, const Streams& streams, const std::vector<std::string>& words) {
  std::vector<char*> argv = arguments(words);
  const pid_t child = ::fork();
  if (child != 0) return child;
  redirect(streams.out, STDOUT_FILENO);
  redirect(streams.err, STDERR_FILENO);
  if (::chdir(folder.c_str()) != 0) ::_exit(126);
  // Sentences stay in one line, so that tests find their words; a test may set another width.
  ::setenv("COLUMNS", "10000", 0);
  ::execv(PLUMB_PROGRAM, argv.data());
  ::_exit(127);
}

int end_of(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

Ran finish(pid_t child, const Streams& streams) {
  Ran out;
  out.exit = end_of(child);
  if (fs::is_regular_file(streams.out)) out.out = text_of(streams.out);
  out.err = text_of(streams.err);
  return out;
}

/// No program prints this byte (ASCII "end of transmission").
constexpr char kEndOfWords = '\x04';

std::vector<std::string> cut(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

}  // namespace

Sandbox::Sandbox() {
  std::string name = (fs::temp_directory_path() / "plumb-cli-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
  fs::create_directory(path_ / "work");
  path_ /= "work";
}

Sandbox::~Sandbox() {
  std::error_code ignored;
  fs::remove_all(path_.parent_path(), ignored);
}

nlohmann::ordered_json Ran::json() const { return nlohmann::ordered_json::parse(out); }

Ran Sandbox::plumb(const std::vector<std::string>& words) const {
  return plumb_into((path_.parent_path() / "out").string(), words);
}

Ran Sandbox::plumb_into(const std::string& file, const std::vector<std::string>& words) const {
  const Streams streams{file, (path_.parent_path() / "err").string()};
  return finish(start(path_, streams, words), streams);
}

Ran Sandbox::plumb_interrupted(int ms, const std::vector<std::string>& words) const {
  const Streams streams{(path_.parent_path() / "out").string(),
                        (path_.parent_path() / "err").string()};
  const pid_t child = start(path_, streams, words);
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
  ::kill(child, SIGINT);
  return finish(child, streams);
}

Ran Sandbox::plumb_on_terminal(unsigned short columns,
                               const std::vector<std::string>& words) const {
  winsize size{};
  size.ws_col = columns;
  size.ws_row = 25;
  std::vector<char*> argv = arguments(words);
  int leader = -1;
  int follower = -1;
  if (::openpty(&leader, &follower, nullptr, nullptr, &size) != 0)
    throw std::runtime_error("no pseudo-terminal");
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    ::close(leader);
    if (::login_tty(follower) != 0 || ::chdir(path_.c_str()) != 0) ::_exit(126);
    redirect("/dev/null", STDERR_FILENO);
    ::unsetenv("COLUMNS");
    ::setenv("NO_COLOR", "1", 1);
    ::execv(PLUMB_PROGRAM, argv.data());
    ::_exit(127);
  }
  Ran out;
  // A terminal whose last writer has closed it may drop what was not read yet. So this process
  // keeps it open and ends the words itself: what comes before the mark is all the child printed.
  std::thread ends([&] {
    out.exit = end_of(child);
    if (::write(follower, &kEndOfWords, 1) != 1) ::close(std::exchange(follower, -1));
  });
  char block[4096];
  for (ssize_t n = 0; (n = ::read(leader, block, sizeof block)) > 0;) {
    out.out.append(block, static_cast<std::size_t>(n));
    if (out.out.back() == kEndOfWords) break;
  }
  ends.join();
  ::close(follower);
  ::close(leader);
  std::erase(out.out, '\r');
  std::erase(out.out, kEndOfWords);
  return out;
}

std::string Sandbox::read(const std::string& file) const { return text_of(path_ / file); }

void Sandbox::write(const std::string& file, const std::string& text) const {
  std::ofstream(path_ / file, std::ios::binary) << text;
}

Csv Sandbox::csv(const std::string& file) const { return parse_csv(read(file)); }

std::vector<std::string> Sandbox::listing() const {
  std::vector<std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(path_))
    out.push_back(fs::relative(entry.path(), path_).string());
  std::sort(out.begin(), out.end());
  return out;
}

Csv parse_csv(const std::string& text) {
  Csv out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto cells = cut(line);
    if (out.header.empty()) {
      out.header = cells;
      continue;
    }
    for (std::size_t k = 0; k < out.header.size(); ++k)
      out.columns[out.header[k]].push_back(k < cells.size() ? cells[k] : "");
  }
  return out;
}

std::vector<double> Csv::numbers(const std::string& column) const {
  std::vector<double> out;
  for (const auto& cell : columns.at(column)) out.push_back(std::stod(cell));
  return out;
}

std::size_t Csv::rows() const { return header.empty() ? 0 : columns.at(header.front()).size(); }

std::string Csv::without(const std::vector<std::string>& names) const {
  std::string out;
  for (std::size_t row = 0; row <= rows(); ++row) {
    std::string line;
    for (const auto& name : header) {
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      line += (line.empty() ? "" : ",") + (row == 0 ? name : columns.at(name)[row - 1]);
    }
    out += line + "\n";
  }
  return out;
}
