// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/narrow_marks.hpp"

#include <fmt/format.h>

#include "tests/blind/mark_list.hpp"
#include "tests/blind/narrow_case.hpp"

namespace plumb::tests {
namespace {

bool any_case(const Score&) { return true; }
bool with_nothing(const Score& s) { return s.drawn.hidden.empty(); }
bool with_effect(const Score& s) { return !s.drawn.hidden.empty(); }
bool names_something(const Score& s) { return s.claims->alarm; }
bool names_it(const Score& s) { return s.claims->first_right || s.claims->either_right; }
/// It named a single cause for certain, and another one is hidden.
bool is_wrong(const Score& s) {
  return s.finding == offline::Finding::kMissing && !s.claims->either && !s.claims->first_right;
}

}  // namespace

std::vector<Mark> narrow_marks_of(const std::vector<Score>& scores, double granted) {
  MarkList m(scores, granted);
  m.at_most("nothing hidden, yet something named", 0.01, with_nothing, names_something);
  m.at_most("another cause is named for certain", 0.03, with_effect, is_wrong);
  m.at_most("worse than geometry only, on the same path", 0.003, any_case, is_worse);
  return m.take();
}

std::string narrow_table_of(const std::vector<Score>& scores) {
  std::string out =
      "| poses | cases | calibrated | nothing hidden, something named | named, or one of two | "
      "another one for certain | cannot tell, or nothing found | worse than geometry | true error, "
      "median: geometry, then [sigma] |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& kind : narrow_kinds()) {
    std::vector<const Score*> made;
    int all = 0;
    for (const auto& s : scores) {
      if (s.drawn.kind != kind) continue;
      ++all;
      if (s.made) made.push_back(&s);
    }
    const auto count = [&](const Which& of, const Which& holds) {
      int have = 0, hold = 0;
      for (const Score* s : made)
        if (of(*s)) ++have, hold += holds(*s);
      return fmt::format("{} of {}", hold, have);
    };
    const auto median = [&](double Score::*value) {
      std::vector<double> some;
      for (const Score* s : made) some.push_back(s->*value);
      return some.empty() ? 0.0 : median_of(some);
    };
    out +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {:.2f}, {:.2f} |\n", kind, all,
                    made.size(), count(with_nothing, names_something), count(with_effect, names_it),
                    count(with_effect, is_wrong),
                    count(with_effect, [](const Score& s) { return !names_it(s) && !is_wrong(s); }),
                    count(any_case, is_worse), median(&Score::before), median(&Score::after));
  }
  return out;
}

}  // namespace plumb::tests
