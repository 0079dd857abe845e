// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/formula_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "tests/blind/mark_list.hpp"

namespace plumb::tests {
namespace {

constexpr double kNearTrueLaw = 1.5;

bool hides_law(const Score& s) { return s.formula && s.drawn.group == Group::kUnknown; }
bool is_offered(const Score& s) { return s.formula && s.formula->offered > 0; }
bool is_offered_for_law(const Score& s) { return hides_law(s) && is_offered(s); }
bool is_near(const Score& s) { return is_offered(s) && s.formula->over_true_law <= kNearTrueLaw; }
bool is_called_unknown(const Score& s) {
  return hides_law(s) && s.finding_after == offline::Finding::kUnknown;
}

}  // namespace

std::vector<Mark> formula_marks_of(const std::vector<Score>& scores, double granted) {
  MarkList out(scores, granted);
  out.at_least("a law is hidden and called unknown: a formula is offered", 0.80, is_called_unknown,
               is_offered);
  out.at_least("formula: right joint and right variables", 0.90, is_offered_for_law,
               [](const Score& s) { return s.formula->variables_right; });
  out.at_least("formula: error within 1.5 times the true law's", 0.80, is_offered_for_law, is_near);
  out.at_least("a law is hidden and called unknown: error within 1.5 times the true law's", 0.80,
               is_called_unknown, is_near);
  out.at_most(
      "nothing hidden, yet a formula is offered", 0.0,
      [](const Score& s) { return s.drawn.group == Group::kNothing; }, is_offered);
  out.at_most(
      "an effect of the library is hidden, yet a formula is offered", 0.0,
      [](const Score& s) { return s.drawn.group == Group::kOne; }, is_offered);
  return out.take();
}

std::string formula_table_of(const std::vector<Score>& scores) {
  std::map<std::string, std::vector<const Score*>> by_law;
  for (const auto& s : scores)
    if (s.made && hides_law(s)) by_law[s.drawn.hidden.front().law].push_back(&s);
  std::string out =
      "| law | cases | called unknown | formula offered | right variables | within 1.5 | error "
      "over the true law's, median: before, after |\n|---|---|---|---|---|---|---|\n";
  for (const auto& [law, all] : by_law) {
    const auto count = [&all = all](const std::function<bool(const Score&)>& holds) {
      return std::count_if(all.begin(), all.end(), [&](const Score* s) { return holds(*s); });
    };
    const auto median = [&all = all](double FormulaScore::*value) {
      std::vector<double> some;
      for (const Score* s : all)
        if (is_offered(*s)) some.push_back((*s->formula).*value);
      return some.empty() ? std::string("-") : fmt::format("{:.2f}", median_of(some));
    };
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {}, {} |\n", law, all.size(),
                       count(is_called_unknown), count(is_offered),
                       count([](const Score& s) { return s.formula->variables_right; }),
                       count(is_near), median(&FormulaScore::before_over_true_law),
                       median(&FormulaScore::over_true_law));
  }
  return out;
}

std::string formula_line_of(int number, const Score& s) {
  std::string hidden;
  for (const auto& effect : s.drawn.request.effects) hidden += " " + effect;
  if (!s.made || !s.formula)
    return fmt::format("{} {}{}: not made: {}", number, name_of(s.drawn.group), hidden, s.why_not);
  const FormulaScore& f = *s.formula;
  return fmt::format(
      "{} {} N={} {:.1f} s{} | {} | offered {} variables {} over true law {:.2f} -> {:.2f} held "
      "{:.2f} "
      "|| {} || {}",
      number, name_of(s.drawn.group), s.drawn.request.poses, s.seconds, hidden,
      offline::name_of(s.finding_after), f.offered, f.variables_right, f.before_over_true_law,
      f.over_true_law, f.held_ratio, f.law, s.said);
}

}  // namespace plumb::tests
