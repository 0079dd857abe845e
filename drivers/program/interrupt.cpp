// SPDX-License-Identifier: Apache-2.0
#include "program/interrupt.hpp"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace plumb {
namespace {

std::atomic<int> late_exit{0};
std::string words;  // written once, before the handler is set

void end(int) {
  end_within_a_second(Exit::kInterrupted);
  const char message[] = "\ninterrupted: nothing more was written\n";
  [[maybe_unused]] const auto said = ::write(STDERR_FILENO, message, sizeof(message) - 1);
  [[maybe_unused]] const auto out = ::write(STDOUT_FILENO, words.data(), words.size());
  ::_exit(static_cast<int>(Exit::kInterrupted));
}

sigset_t interrupts() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

void end_on_interrupt(const std::string& last_words) {
  words = last_words;
  struct sigaction action {};
  action.sa_handler = end;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void end_within_a_second(Exit exit) noexcept {
  late_exit = static_cast<int>(exit);
  struct sigaction action {};
  action.sa_handler = [](int) { ::_exit(late_exit); };
  sigaction(SIGALRM, &action, nullptr);
  sigset_t alarm;
  sigemptyset(&alarm);
  sigaddset(&alarm, SIGALRM);
  pthread_sigmask(SIG_UNBLOCK, &alarm, nullptr);
  ::alarm(1);
}

Writing::Writing() {
  const sigset_t set = interrupts();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

Writing::~Writing() {
  const sigset_t set = interrupts();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

}  // namespace plumb
