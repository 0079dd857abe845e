// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace plumb::tests {

struct RtRan {
  int exit = -1;  // -1: a signal ended it
  std::string out, err;
  nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
};

/// plumb-rt with these words, running beside the test; its words go to files in `scratch`.
class RtProgram {
 public:
  RtProgram(
      std::vector<std::string> words, const std::filesystem::path& scratch,
      const std::function<void()>& before = [] {})
      : name_((scratch / ("run-" + std::to_string(next_++))).string()) {
    words.insert(words.begin(), PLUMB_RT_PROGRAM);
    child_ = ::fork();
    if (child_ != 0) return;
    redirect(name_ + ".out", STDOUT_FILENO);
    redirect(name_ + ".err", STDERR_FILENO);
    before();
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(argv.front(), argv.data());
    ::_exit(127);
  }
  ~RtProgram() {
    if (child_ > 0) kill(SIGKILL), wait();
  }
  RtProgram(const RtProgram&) = delete;
  RtProgram& operator=(const RtProgram&) = delete;

  void kill(int signal) const { ::kill(child_, signal); }
  pid_t pid() const { return child_; }

  RtRan wait() {
    int status = 0;
    ::waitpid(child_, &status, 0);
    child_ = -1;
    return {.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            .out = text(name_ + ".out"),
            .err = text(name_ + ".err")};
  }

 private:
  static void redirect(const std::string& file, int to) {
    const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (fd < 0 || ::dup2(fd, to) < 0) ::_exit(126);
  }
  static std::string text(const std::string& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  inline static int next_ = 0;
  std::string name_;
  pid_t child_ = -1;
};

inline RtRan plumb_rt(std::vector<std::string> words, const std::filesystem::path& scratch) {
  return RtProgram(std::move(words), scratch).wait();
}

/// Waits until `holds`, ten seconds at most.
bool becomes(auto holds) {
  for (int i = 0; i < 1000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace plumb::tests
