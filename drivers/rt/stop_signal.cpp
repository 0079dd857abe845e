// SPDX-License-Identifier: Apache-2.0
#include "rt/stop_signal.hpp"

#include <signal.h>
#include <unistd.h>

#include "program/problem.hpp"

namespace plumb::drivers::rt {
namespace {

std::atomic<std::atomic<bool>*> flag{nullptr};
std::atomic<bool> told{false};

void heard(int) {
  if (told.exchange(true)) ::_exit(static_cast<int>(Exit::kInterrupted));
  if (auto* const stop = flag.load()) stop->store(true);
}

}  // namespace

void stop_on_signal(std::atomic<bool>& stop) {
  flag = &stop;
  struct sigaction action {};
  action.sa_handler = heard;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace plumb::drivers::rt
