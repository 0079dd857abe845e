// SPDX-License-Identifier: Apache-2.0
#include "rt/stop_signal.hpp"

#include <signal.h>
#include <unistd.h>

#include <tuple>

#include "program/problem.hpp"
#include "rt/standard_error.hpp"

namespace plumb::drivers::rt {
namespace {

std::atomic<std::atomic<bool>*> flag{nullptr};
std::atomic<bool> told{false};
struct sigaction handler_before {};  // of the program: it says its last words

[[noreturn]] void end_at_once(int signal) {
  std::ignore = say_at_once(
      "\nplumb-rt: ended at once; it is the receiver that takes the correction away now");
  if (handler_before.sa_handler != SIG_DFL && handler_before.sa_handler != SIG_IGN)
    handler_before.sa_handler(signal);
  ::_exit(static_cast<int>(Exit::kInterrupted));
}

void heard(int signal) {
  if (told.exchange(true)) end_at_once(signal);
  if (auto* const stop = flag.load()) stop->store(true);
}

}  // namespace

void stop_on_signal(std::atomic<bool>& stop) {
  flag = &stop;
  struct sigaction action {};
  action.sa_handler = heard;
  action.sa_flags = SA_RESTART;
  signal(SIGPIPE, SIG_IGN);  // a reader of our words who leaves ends nothing
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, &handler_before);
}

}  // namespace plumb::drivers::rt
