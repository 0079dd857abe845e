// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/imitator_marks.hpp"

#include <fmt/format.h>

#include "tests/blind/imitator_case.hpp"
#include "tests/blind/mark_list.hpp"

namespace plumb::tests {
namespace {

bool any_imitator(const Score&) { return true; }
bool is_named_wrongly(const Score& s) { return outcome_of(s) == Outcome::kWrong; }

}  // namespace

Outcome outcome_of(const Score& s) {
  const Claims& claims = *s.claims;
  if (claims.unrelated_certain > 0 || claims.turned_gravity) return Outcome::kWrong;
  if (claims.first_right || claims.either_right || (s.unknown_said && s.inputs_right))
    return Outcome::kRight;
  const bool one =
      s.finding == offline::Finding::kMissing && !claims.either && !claims.first_doubtful;
  const bool only_others = claims.either && !claims.slow_motion;
  return one || only_others ? Outcome::kWrong : Outcome::kVague;
}

std::vector<Mark> imitator_marks_of(const std::vector<Score>& scores, double granted) {
  MarkList m(scores, granted);
  for (const auto& kind : imitator_kinds())
    m.at_most(
        "another cause is named: " + kind, 0.03,
        [&kind](const Score& s) { return s.drawn.kind == kind; }, is_named_wrongly);
  m.at_most("another cause is named, all kinds", 0.03, any_imitator, is_named_wrongly);
  m.at_most("worse than geometry only", 0.003, any_imitator, is_worse);
  return m.take();
}

std::string imitator_table_of(const std::vector<Score>& scores) {
  std::string out =
      "| what is hidden | cases | right | cannot tell, or nothing found | another cause is named | "
      "of these, added | worse than geometry | true error, median: geometry, then [sigma] "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (const auto& kind : imitator_kinds()) {
    std::vector<const Score*> made;
    for (const auto& s : scores)
      if (s.drawn.kind == kind && s.made) made.push_back(&s);
    const auto count = [&made](const Which& holds) {
      int hold = 0;
      for (const Score* s : made) hold += holds(*s);
      return hold;
    };
    const auto median = [&made](double Score::*value) {
      std::vector<double> some;
      for (const Score* s : made) some.push_back(s->*value);
      return some.empty() ? 0.0 : median_of(some);
    };
    const auto came_to = [&count](Outcome what) {
      return count([what](const Score& s) { return outcome_of(s) == what; });
    };
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.2f}, {:.2f} |\n", kind, made.size(),
                       came_to(Outcome::kRight), came_to(Outcome::kVague), came_to(Outcome::kWrong),
                       count([](const Score& s) { return s.claims->unrelated_certain > 0; }),
                       count(is_worse), median(&Score::before), median(&Score::after));
  }
  return out;
}

}  // namespace plumb::tests
