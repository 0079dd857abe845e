// SPDX-License-Identifier: Apache-2.0
// The blind study: arms with something hidden, diagnosed by who never sees the truth.
//   blind_study [CASES] [SEED] [--list]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/blind/marks.hpp"
#include "tests/blind/study.hpp"

int main(int argc, char** argv) {
  const int cases = argc > 1 ? std::atoi(argv[1]) : 2000;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const bool list = argc > 3 && std::strcmp(argv[3], "--list") == 0;
  const auto scores = plumb::tests::run_study(seed, cases, [cases](int done) {
    if (done % 50 == 0) std::fprintf(stderr, "%d of %d\n", done, cases);
  });
  for (std::size_t i = 0; list && i < scores.size(); ++i)
    std::printf("%s\n", plumb::tests::line_of(static_cast<int>(i), scores[i]).c_str());
  const auto marks = plumb::tests::marks_of(scores, 2.0);
  std::printf("%s", plumb::tests::table_of(marks).c_str());
  return std::all_of(marks.begin(), marks.end(), [](const auto& m) { return m.passed; }) ? 0 : 1;
}
