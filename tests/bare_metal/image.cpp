// SPDX-License-Identifier: Apache-2.0
// Loads a model, then runs the cycle: same bits as everywhere, a known number of instructions, no
// allocation.
#include "tests/bare_metal/arena.hpp"
#include "tests/bare_metal/cycle_hash.hpp"
#include "tests/bare_metal/instruction_meter.hpp"
#include "tests/bare_metal/machine.hpp"
#include "tests/rt/cycle_model.hpp"

namespace plumb::bare_metal {
namespace {

// How far the cost may follow the input, in percent.
constexpr std::uint64_t kPredictSpread = 1, kCorrectSpread = 3;

void say(const char* what, std::uint64_t number, int base = 10) {
  write(what);
  write(number, base);
}

void report(const char* what, const InstructionMeter& meter) {
  write(what);
  say(": instructions ", meter.least());
  say(" .. ", meter.most());
  say(", mean ", meter.mean());
  write("\n");
}

Exit run(const format::Model& model) {
  const Corrector corrector(model);
  say("load: ", arena_bytes_used());
  write(" bytes of the arena\n");
  seal_arena();
  InstructionMeter predicting, correcting;
  const std::uint64_t hash = hash_of_cycles(
      corrector, [&](auto call) { predicting(call); }, [&](auto call) { correcting(call); });
  report("predict", predicting);
  report("correct", correcting);
  say("cycles ", kCycles);
  say(", hash ", hash, 16);
  write(hash == kHash ? ", as everywhere\n" : ", WRONG\n");
  const bool steady =
      predicting.within_percent(kPredictSpread) && correcting.within_percent(kCorrectSpread);
  if (!steady) write("the cost depends on the input\n");
  return hash == kHash && steady ? kPassed : kFailed;
}

}  // namespace

int run_program() {
  const format::Model model = tests::cycle_model();
  return run(model);
}

}  // namespace plumb::bare_metal
