// SPDX-License-Identifier: Apache-2.0
// random_laws COUNT SEED [PLANT]: COUNT cycles against the laws of law_watch.hpp, a new model every
// kCyclesOfALife. Ends with 1 at the first that breaks one, and says how to see it again.
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "tests/rt/laws/law_watch.hpp"

namespace {

using namespace plumb::tests;

constexpr std::uint64_t kCyclesOfALife = 5000;

/// Life k of seed s is life 0 of seed s + k.
void live(std::uint64_t seed, std::uint64_t cycles, Plant plant, LawTally& tally) {
  LawWatch watch(seed, plant, tally);
  for (std::uint64_t k = 0; k < cycles; ++k) {
    try {
      watch.cycle();
    } catch (const BrokenLaw& broken) {
      std::printf("broken in cycle %" PRIu64 ": %s\nagain: random_laws %" PRIu64 " %" PRIu64 "\n",
                  tally.cycles, broken.what(), k + 1, seed);
      throw;
    }
  }
}

void print(const LawTally& t) {
  std::printf("%" PRIu64 " cycles of predict, solve and guard over %" PRIu64
              " models: no law broken\n",
              t.cycles, t.lives);
  std::printf("  %" PRIu64 " solved, the others refused; %" PRIu64 " solved twice, the same bits\n",
              t.corrected, t.repeated);
  std::printf("  %" PRIu64 " with an invented correction for the guard, %" PRIu64
              " cut by a limit, %" PRIu64 " held without a target, %" PRIu64 " stale\n",
              t.invented, t.limited, t.held, t.stale);
  std::printf("  %" PRIu64 " swaps of the limits; %" PRIu64
              " times refused or stale until nothing was left\n",
              t.swapped, t.decays);
}

int run(std::uint64_t count, std::uint64_t seed, Plant plant) {
  LawTally tally;
  std::printf("count %" PRIu64 " seed %" PRIu64 "\n", count, seed);
  try {
    for (std::uint64_t life = 0; tally.cycles < count; ++life)
      live(seed + life, std::min(kCyclesOfALife, count - tally.cycles), plant, tally);
  } catch (const BrokenLaw&) {
    return 1;
  }
  print(tally);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  if (count < 3 || count > 4) {
    std::fprintf(stderr, "usage: random_laws COUNT SEED [PLANT]\n");
    return 2;
  }
  return run(std::strtoull(words[1], nullptr, 10), std::strtoull(words[2], nullptr, 10),
             plant_named(count > 3 ? words[3] : ""));
}
