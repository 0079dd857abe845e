// SPDX-License-Identifier: Apache-2.0
// rtsan_cycle [PLANTED]: cycles under RealtimeSanitizer, whose run-time library intercepts what may
// block and ends the program when it is called between enter and exit. The compiler need not know
// of it. PLANTED: malloc, mutex or sleep, once, inside; must end the program.
#include <pthread.h>
#include <time.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/rt/gate_arms.hpp"
#include "tests/rt/whole_cycle.hpp"

extern "C" {
void __rtsan_init();
void __rtsan_realtime_enter();
void __rtsan_realtime_exit();
}

namespace plumb::tests {
namespace {

constexpr long kCycles = 20'000;

void* volatile sink = nullptr;

void violate(std::string_view planted) {
  static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  const timespec short_time{0, 1};
  if (planted == "malloc") sink = std::malloc(8);
  if (planted == "mutex") pthread_mutex_lock(&mutex);
  if (planted == "sleep") nanosleep(&short_time, nullptr);
}

/// Valid cycles of kCycles.
long run(const format::Model& model, std::string_view planted) {
  WholeCycle cycle(model);
  __rtsan_realtime_enter();
  cycle.run(kCycles);
  violate(planted);
  __rtsan_realtime_exit();
  return cycle.valid();
}

}  // namespace
}  // namespace plumb::tests

int main(int count, char** words) {
  using namespace plumb::tests;
  __rtsan_init();
  const std::string_view planted = count > 1 ? words[1] : "";
  for (const auto& model : {one_arm(), blended_arm(), cycle_model(), every_law_arm()}) {
    const long valid = run(model, planted);
    std::printf("%ld cycles, %ld valid, nothing that may block\n", kCycles, valid);
    if (valid == 0) return 1;
  }
  return 0;
}
