// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/orientation_marks.hpp"

#include <fmt/format.h>

#include "tests/blind/imitator_marks.hpp"
#include "tests/blind/mark_list.hpp"
#include "tests/blind/orientation_case.hpp"

namespace plumb::tests {
namespace {

bool any_turned(const Score&) { return true; }
bool hides_nothing(const Score& s) { return s.drawn.hidden.empty(); }
bool hides_one(const Score& s) { return !hides_nothing(s); }
bool names_another(const Score& s) { return outcome_of(s) == Outcome::kWrong; }
bool names_it(const Score& s) { return outcome_of(s) == Outcome::kRight; }

}  // namespace

std::vector<Mark> orientation_marks_of(const std::vector<Score>& scores, double granted) {
  MarkList m(scores, granted);
  for (const auto& kind : orientation_kinds()) {
    const auto of_kind = [&kind](const Score& s) { return s.drawn.kind == kind; };
    m.at_least(
        "the hidden effect is named: " + kind, 0.90,
        [&](const Score& s) { return of_kind(s) && hides_one(s); }, names_it);
    m.at_most(
        "nothing hidden, yet something named: " + kind, 0.03,
        [&](const Score& s) { return of_kind(s) && hides_nothing(s); }, names_another);
  }
  m.at_most("another cause is named, all kinds", 0.03, any_turned, names_another);
  m.at_most("worse than geometry only", 0.003, any_turned, is_worse);
  return m.take();
}

std::string orientation_table_of(const std::vector<Score>& scores) {
  std::string out =
      "| orientations | arms | named | cannot tell, or nothing found | another cause is named | "
      "worse than geometry | true error of points: geometry, then, mean [sigma] "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const auto& kind : orientation_kinds()) {
    int made = 0, named = 0, vague = 0, wrong = 0, worse = 0;
    double before = 0.0, after = 0.0;
    for (const auto& s : scores) {
      if (s.drawn.kind != kind || !s.made) continue;
      ++made;
      named += names_it(s);
      wrong += names_another(s);
      vague += !names_it(s) && !names_another(s);
      worse += is_worse(s);
      before += s.before;
      after += s.after;
    }
    const double n = std::max(1, made);
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {:.3f}, {:.3f} |\n", kind, made, named,
                       vague, wrong, worse, before / n, after / n);
  }
  return out;
}

}  // namespace plumb::tests
