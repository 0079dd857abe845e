// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

/// A program to run: the first word is its path. No shell is involved.
struct ChildCommand {
  std::vector<std::string> words;
  std::filesystem::path folder;  // where it runs
  /// kWithItsChildren: signals, and the end of the `Child`, reach what it starts, too; Ctrl-C in
  /// the terminal does not.
  enum class Group { kOurs, kWithItsChildren } group = Group::kOurs;
};

/// A running child process. It has no input, and gets SIGTERM when the thread that started it ends,
/// and so when this program is killed. The destructor kills it and waits.
class Child {
 public:
  /// Throws std::system_error if no process can be made.
  explicit Child(const ChildCommand& command);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int out() const { return out_; }  // file descriptors to read from, without waiting
  int err() const { return err_; }

  void signal(int number) const;

  /// True once it has ended; then `exit_code` says how: its own code, or 128 and the signal.
  bool has_ended();
  int exit_code() const { return exit_code_; }

 private:
  pid_t pid_ = -1;
  ChildCommand::Group group_;
  int out_ = -1, err_ = -1;
  int exit_code_ = -1;
};

/// Appends what can be read now. Says if more may come; `most`: what does not fit is dropped and
/// said so.
enum class Pipe { kOpen, kEnded, kTooMuch };
Pipe read_some(int fd, std::string& into, std::size_t most);

/// What a short program printed on its standard output.
struct ShortRun {
  int exit_code = -1;
  std::string out, err;
};

/// Runs a program to its end; kills it after `longest`, or when `stop` becomes true. Throws
/// std::system_error: if it cannot be started, or with timed_out if it does not end in time.
ShortRun run_to_end(const ChildCommand& command, std::chrono::milliseconds longest,
                    const std::atomic<bool>& stop);

}  // namespace plumb
