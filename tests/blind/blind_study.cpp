// SPDX-License-Identifier: Apache-2.0
// The blind study: arms with something hidden, diagnosed by who never sees the truth.
//   blind_study [CASES] [SEED] [--list]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/blind/marks.hpp"

int main(int argc, char** argv) {
  const int cases = argc > 1 ? std::atoi(argv[1]) : 2000;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const bool list = argc > 3 && std::strcmp(argv[3], "--list") == 0;
  std::vector<plumb::tests::Score> scores;
  for (int i = 0; i < cases; ++i) {
    scores.push_back(plumb::tests::run_case(plumb::tests::draw_case(seed, i)));
    const auto& s = scores.back();
    if (list) std::printf("%s\n", plumb::tests::line_of(i, s).c_str());
    if ((i + 1) % 50 == 0) std::fprintf(stderr, "%d of %d\n", i + 1, cases);
  }
  const auto marks = plumb::tests::marks_of(scores);
  std::printf("%s", plumb::tests::table_of(marks).c_str());
  return std::all_of(marks.begin(), marks.end(), [](const auto& m) { return m.passed; }) ? 0 : 1;
}
