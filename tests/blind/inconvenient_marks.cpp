// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/inconvenient_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/blind/inconvenient_case.hpp"
#include "tests/blind/mark_list.hpp"

namespace plumb::tests {
namespace {

constexpr double kClearLead_nats = 10.0;

bool hides_nothing(const Score& s) { return s.drawn.group == Group::kNothing; }
bool hides_known(const Score& s) { return s.drawn.group == Group::kOne; }
bool hides_unknown(const Score& s) { return s.drawn.group == Group::kUnknown; }

/// No diagnosis can tell the scale of a tracker from the size of the arm, and the shifts of the
/// tracker and the reflector do not act on new poses.
bool hides_law(const Score& s, const std::string& law) {
  return std::any_of(s.drawn.hidden.begin(), s.drawn.hidden.end(),
                     [&](const auto& hidden) { return hidden.law == law; });
}
bool is_judged_by_error(const Score& s) { return !hides_law(s, "tracker"); }

/// A single cause was named, by a lead that leaves no doubt.
bool is_clear(const Score& s) {
  const bool named =
      s.finding == offline::Finding::kMissing || s.finding == offline::Finding::kUnknown;
  return hides_known(s) && named && !s.claims->either && s.claims->lead > kClearLead_nats;
}

void add_held_out(MarkList& m) {
  for (const auto& [poses, within] : {std::pair{45, 0.20}, std::pair{500, 0.08}})
    m.at_least(
        fmt::format("reported held-out error within {:.0f} % of the truth, N = {}", 100.0 * within,
                    poses),
        0.97,
        [poses](const Score& s) {
          return s.drawn.request.poses == poses && !hides_unknown(s) && is_judged_by_error(s);
        },
        [within](const Score& s) { return std::abs(s.held_over_true - 1.0) <= within; });
  for (const auto& [poses, limit] :
       {std::pair{45, 0.62}, std::pair{150, 0.38}, std::pair{500, 0.22}})
    m.median_at_most(
        fmt::format("true error after, convenient arms, 5 sigma effect, N = {} [sigma]", poses),
        limit,
        [poses](const Score& s) {
          return s.drawn.kind == kConvenient && hides_known(s) && s.drawn.request.poses == poses &&
                 s.drawn.hidden.front().sigmas == 5.0 && is_judged_by_error(s);
        },
        [](const Score& s) { return s.after; });
}

struct Count {
  int of = 0, hold = 0;
  void add(bool holds) { ++of, hold += holds; }
  std::string text() const {
    return of == 0 ? "-" : fmt::format("{:.1f} % of {}", 100.0 * hold / of, of);
  }
};

Count count(const std::vector<Score>& scores, const Which& of, const Which& holds) {
  Count out;
  for (const auto& s : scores)
    if (s.made && of(s)) out.add(holds(s));
  return out;
}

std::string kinds_table(const std::vector<Score>& scores) {
  std::string out =
      "| kind | cases | false alarm | clear lead: class right | named or one of two, right | "
      "unknown: inputs | unrelated extra | worse than geometry "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (const auto& kind : inconvenient_kinds()) {
    const auto of_kind = [&](const Which& which) -> Which {
      return [&kind, which](const Score& s) { return s.drawn.kind == kind && which(s); };
    };
    const auto row = [&](const Which& of, const Which& holds) {
      return count(scores, of_kind(of), holds).text();
    };
    const Which any = [](const Score&) { return true; };
    out += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} |\n", kind, count(scores, of_kind(any), any).of,
        row(hides_nothing, [](const Score& s) { return s.claims->alarm; }),
        row(is_clear, [](const Score& s) { return s.claims->first_right; }),
        row(hides_known,
            [](const Score& s) { return s.claims->first_right || s.claims->either_right; }),
        row(hides_unknown, [](const Score& s) { return s.unknown_said && s.inputs_right; }),
        row(hides_known, [](const Score& s) { return s.claims->unrelated > 0; }),
        row(is_judged_by_error, is_worse));
  }
  return out;
}

std::string leads_table(const std::vector<Score>& scores) {
  struct Range {
    const char* name;
    double from, to;
  };
  std::string out = "| lead of the first candidate [nats] | its class is right |\n|---|---|\n";
  for (const Range& range : {Range{"0 to 3", 0.0, 3.0}, Range{"3 to 5", 3.0, 5.0},
                             Range{"5 to 10", 5.0, 10.0}, Range{"above 10", 10.0, HUGE_VAL}})
    out += fmt::format("| {} | {} |\n", range.name,
                       count(
                           scores,
                           [range](const Score& s) {
                             return hides_known(s) && s.finding == offline::Finding::kMissing &&
                                    s.claims->lead >= range.from && s.claims->lead < range.to;
                           },
                           [](const Score& s) { return s.claims->first_right; })
                           .text());
  return out;
}

std::string falls_table(const std::vector<Score>& scores) {
  std::string out =
      "| promised fall of the error, from folds | true fall within 1 SE | within 2 SE | median of "
      "(true - promised) / SE |\n|---|---|---|---|\n";
  for (const auto& [name, from, to] :
       {std::tuple{"up to 20 %", 0.0, 0.2}, std::tuple{"20 to 60 %", 0.2, 0.6},
        std::tuple{"above 60 %", 0.6, 2.0}, std::tuple{"all", 0.0, 2.0}}) {
    std::vector<double> off;
    for (const auto& s : scores)
      if (s.made && s.claims->fall_counts && s.claims->fall_se > 0.0 && s.claims->fall >= from &&
          s.claims->fall < to)
        off.push_back((s.claims->true_fall - s.claims->fall) / s.claims->fall_se);
    Count one, two;
    for (const double x : off) one.add(std::abs(x) <= 1.0), two.add(std::abs(x) <= 2.0);
    std::sort(off.begin(), off.end());
    out += fmt::format("| {} | {} | {} | {} |\n", name, one.text(), two.text(),
                       off.empty() ? "-" : fmt::format("{:+.2f}", off[off.size() / 2]));
  }
  return out;
}

}  // namespace

std::vector<Mark> inconvenient_marks_of(const std::vector<Score>& scores, double granted) {
  MarkList m(scores, granted);
  for (const auto& kind : inconvenient_kinds())
    m.at_most(
        "nothing else hidden, yet something named: " + kind, 0.01,
        [&kind](const Score& s) { return s.drawn.kind == kind && hides_nothing(s); },
        [](const Score& s) { return s.claims->alarm; });
  m.at_least("right class first, where it leads by more than 10 nats", 0.97, is_clear,
             [](const Score& s) { return s.claims->first_right; });
  m.at_least(
      "'A or B' contains the truth", 0.98,
      [](const Score& s) { return hides_known(s) && s.claims->either; },
      [](const Score& s) { return s.claims->either_right; });
  m.at_least("unknown effect: verdict and inputs", 0.97, hides_unknown,
             [](const Score& s) { return s.unknown_said && s.inputs_right; });
  m.at_most("cases with an unrelated extra effect", 0.01, hides_known,
            [](const Score& s) { return s.claims->unrelated > 0; });
  m.at_most("worse than geometry only", 0.003, is_judged_by_error, is_worse);
  add_held_out(m);
  return m.take();
}

std::string inconvenient_tables_of(const std::vector<Score>& scores) {
  return kinds_table(scores) + "\n" + leads_table(scores) + "\n" + falls_table(scores);
}

}  // namespace plumb::tests
