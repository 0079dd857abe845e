// SPDX-License-Identifier: Apache-2.0
// The study of formulas: arms with laws outside the library, and arms with none.
//   formula_study [CASES] [SEED] [--list]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/blind/formula_case.hpp"
#include "tests/blind/formula_marks.hpp"
#include "tests/blind/study.hpp"

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const bool list = std::erase(words, "--list") > 0;
  const int cases = !words.empty() ? std::atoi(words[0].c_str()) : 200;
  const auto seed =
      static_cast<std::uint64_t>(words.size() > 1 ? std::atoll(words[1].c_str()) : 2032);
  const auto draw = [=](int number) { return plumb::tests::draw_formula_case(seed, number); };
  const auto scores = plumb::tests::run_study(draw, cases, [cases](int done) {
    if (done % 50 == 0) std::fprintf(stderr, "%d of %d\n", done, cases);
  });
  for (std::size_t i = 0; list && i < scores.size(); ++i)
    std::printf("%s\n", plumb::tests::formula_line_of(static_cast<int>(i), scores[i]).c_str());
  const auto marks = plumb::tests::formula_marks_of(scores, 2.0);
  std::printf("%s\n%s", plumb::tests::table_of(marks).c_str(),
              plumb::tests::formula_table_of(scores).c_str());
  return std::all_of(marks.begin(), marks.end(), [](const auto& m) { return m.passed; }) ? 0 : 1;
}
