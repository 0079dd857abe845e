// SPDX-License-Identifier: Apache-2.0
#include "program/process_number.hpp"

#include <signal.h>
#include <unistd.h>

#include <cerrno>

namespace plumb {

int own_process_number() { return ::getpid(); }

bool process_exists(int number) { return ::kill(number, 0) == 0 || errno != ESRCH; }

}  // namespace plumb
