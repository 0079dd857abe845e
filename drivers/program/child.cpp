// SPDX-License-Identifier: Apache-2.0
#include "program/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace plumb {
namespace {

constexpr int kCannotStart = 127;  // as a shell says it

/// Two ends of a pipe that no other child inherits.
struct PipeEnds {
  int read = -1, write = -1;
  PipeEnds() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) == 0) read = ends[0], write = ends[1];
  }
};

/// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* words, const char* folder, ChildCommand::Group group,
                         pid_t parent, int out, int err) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (group == ChildCommand::Group::kWithItsChildren) ::setpgid(0, 0);
  if (::getppid() != parent) ::_exit(kCannotStart);  // it has ended meanwhile
  const int nothing = ::open("/dev/null", O_RDONLY);
  const bool ready = nothing >= 0 && ::dup2(nothing, STDIN_FILENO) >= 0 &&
                     ::dup2(out, STDOUT_FILENO) >= 0 && ::dup2(err, STDERR_FILENO) >= 0 &&
                     ::chdir(folder) == 0;
  ::close_range(3, ~0U, 0);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (ready) ::execv(words[0], words);
  ::_exit(kCannotStart);
}

}  // namespace

Child::Child(const ChildCommand& command) : group_(command.group) {
  std::vector<std::string> words = command.words;
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string folder = command.folder.string();
  const PipeEnds out, err;
  const pid_t parent = ::getpid();
  if (out.read >= 0 && err.read >= 0) pid_ = ::fork();
  if (pid_ == 0) become(pointers.data(), folder.c_str(), group_, parent, out.write, err.write);
  const int error = errno;
  for (const int fd : {out.write, err.write})
    if (fd >= 0) ::close(fd);
  if (pid_ < 0) {
    for (const int fd : {out.read, err.read})
      if (fd >= 0) ::close(fd);
    throw std::system_error(error, std::generic_category(), words.front());
  }
  // Here, too: a signal may be sent before the child has come so far.
  if (group_ == ChildCommand::Group::kWithItsChildren) ::setpgid(pid_, pid_);
  out_ = out.read;
  err_ = err.read;
  for (const int fd : {out_, err_}) ::fcntl(fd, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
  if (exit_code_ < 0) {
    signal(SIGKILL);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  ::close(out_);
  ::close(err_);
}

void Child::signal(int number) const {
  if (exit_code_ >= 0) return;
  ::kill(group_ == ChildCommand::Group::kWithItsChildren ? -pid_ : pid_, number);
}

bool Child::has_ended() {
  if (exit_code_ >= 0) return true;
  int status = 0;
  if (::waitpid(pid_, &status, WNOHANG) != pid_) return false;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return true;
}

Pipe read_some(int fd, std::string& into, std::size_t most) {
  std::array<char, 1 << 16> chunk;
  bool too_much = false;
  for (;;) {
    const ssize_t n = ::read(fd, chunk.data(), chunk.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return too_much ? Pipe::kTooMuch : errno == EAGAIN ? Pipe::kOpen : Pipe::kEnded;
    if (n == 0) return too_much ? Pipe::kTooMuch : Pipe::kEnded;
    const std::size_t room = most - std::min(most, into.size());
    too_much = too_much || static_cast<std::size_t>(n) > room;
    into.append(chunk.data(), std::min(room, static_cast<std::size_t>(n)));
  }
}

ShortRun run_to_end(const ChildCommand& command, std::chrono::milliseconds longest,
                    const std::atomic<bool>& stop) {
  constexpr std::size_t kMost = std::size_t{8} << 20;  // bytes kept of what it prints
  const auto end = std::chrono::steady_clock::now() + longest;
  Child child(command);
  ShortRun out;
  for (;;) {
    const bool ended = child.has_ended();  // what it wrote before is in the pipes by now
    (void)read_some(child.out(), out.out, kMost);
    (void)read_some(child.err(), out.err, kMost);
    if (ended) break;
    if (stop || std::chrono::steady_clock::now() > end)
      throw std::system_error(std::make_error_code(std::errc::timed_out), command.words.front());
    std::array<pollfd, 2> pipes{{{child.out(), POLLIN, 0}, {child.err(), POLLIN, 0}}};
    // A pipe whose other end is closed is always ready: then the process is about to end.
    if (::poll(pipes.data(), pipes.size(), 20) > 0 && (pipes[0].revents & POLLIN) == 0 &&
        (pipes[1].revents & POLLIN) == 0)
      ::poll(nullptr, 0, 5);
  }
  out.exit_code = child.exit_code();
  if (out.exit_code == kCannotStart && out.out.empty())
    throw std::system_error(std::make_error_code(std::errc::no_such_file_or_directory),
                            command.words.front());
  return out;
}

}  // namespace plumb
