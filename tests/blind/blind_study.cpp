// SPDX-License-Identifier: Apache-2.0
// The blind study: arms with something hidden, diagnosed by who never sees the truth.
//   blind_study [CASES] [SEED] [POSES] [--list]
//   blind_study --narrow [CASES] [SEED] [POSES] [--list]
//   blind_study --imitators [--kind NUMBER] [CASES] [SEED] [POSES] [--list]
//   blind_study --orientations [--kind NUMBER] [CASES] [SEED] [POSES] [--list]
//   blind_study --inconvenient [--kind NUMBER] [CASES] [SEED] [POSES] [--list]
// With POSES: the first CASES cases that have so many. --kind: cases of one kind alone, numbered
// from 0 as in its table. --case NUMBER: that case of --list alone.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/blind/imitator_case.hpp"
#include "tests/blind/imitator_marks.hpp"
#include "tests/blind/inconvenient_case.hpp"
#include "tests/blind/inconvenient_marks.hpp"
#include "tests/blind/marks.hpp"
#include "tests/blind/narrow_case.hpp"
#include "tests/blind/narrow_marks.hpp"
#include "tests/blind/orientation_case.hpp"
#include "tests/blind/orientation_marks.hpp"
#include "tests/blind/study.hpp"

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const auto asked_for = [&words](const char* option) { return std::erase(words, option) > 0; };
  const bool list = asked_for("--list");
  const bool inconvenient = asked_for("--inconvenient");
  const bool narrow = asked_for("--narrow");
  const bool imitators = asked_for("--imitators");
  const bool orientations = asked_for("--orientations");
  const auto number_after = [&words](const char* option) {
    const auto at = std::find(words.begin(), words.end(), option);
    if (at == words.end() || at + 1 == words.end()) return -1;
    const int number = std::atoi((at + 1)->c_str());
    words.erase(at, at + 2);
    return number;
  };
  const int kind = number_after("--kind");  // -1: every kind
  const int only = number_after("--case");  // -1: all
  const int cases = !words.empty() ? std::atoi(words[0].c_str()) : 2000;
  const auto seed = static_cast<std::uint64_t>(words.size() > 1 ? std::atoll(words[1].c_str()) : 1);
  const int poses = words.size() > 2 ? std::atoi(words[2].c_str()) : 0;
  const auto draw = [=](int number) {
    const auto& kinds = imitators      ? plumb::tests::imitator_kinds()
                        : orientations ? plumb::tests::orientation_kinds()
                                       : plumb::tests::inconvenient_kinds();
    if (kind >= 0) number = number * static_cast<int>(kinds.size()) + kind;
    if (imitators) return plumb::tests::draw_imitator_case(seed, number);
    if (orientations) return plumb::tests::draw_orientation_case(seed, number);
    if (narrow) return plumb::tests::draw_narrow_case(seed, number);
    return inconvenient ? plumb::tests::draw_inconvenient_case(seed, number)
                        : plumb::tests::draw_case(seed, number);
  };
  std::vector<int> numbers;
  if (only >= 0) numbers.push_back(only);
  for (int i = 0; only < 0 && i < 100 * cases && static_cast<int>(numbers.size()) < cases; ++i)
    if (poses == 0 || draw(i).request.poses == poses) numbers.push_back(i);
  const auto chosen = [&](int k) { return draw(numbers[static_cast<std::size_t>(k)]); };
  const auto scores =
      plumb::tests::run_study(chosen, static_cast<int>(numbers.size()), [cases](int done) {
        if (done % 50 == 0) std::fprintf(stderr, "%d of %d\n", done, cases);
      });
  for (std::size_t i = 0; list && i < scores.size(); ++i)
    std::printf("%s\n", plumb::tests::line_of(numbers[i], scores[i]).c_str());
  const auto marks = imitators      ? plumb::tests::imitator_marks_of(scores, 2.0)
                     : orientations ? plumb::tests::orientation_marks_of(scores, 2.0)
                     : narrow       ? plumb::tests::narrow_marks_of(scores, 2.0)
                     : inconvenient ? plumb::tests::inconvenient_marks_of(scores, 2.0)
                                    : plumb::tests::marks_of(scores, 2.0);
  std::printf("%s", plumb::tests::table_of(marks).c_str());
  if (narrow) std::printf("\n%s", plumb::tests::narrow_table_of(scores).c_str());
  if (imitators) std::printf("\n%s", plumb::tests::imitator_table_of(scores).c_str());
  if (orientations) std::printf("\n%s", plumb::tests::orientation_table_of(scores).c_str());
  if (inconvenient) std::printf("\n%s", plumb::tests::inconvenient_tables_of(scores).c_str());
  return std::all_of(marks.begin(), marks.end(), [](const auto& m) { return m.passed; }) ? 0 : 1;
}
