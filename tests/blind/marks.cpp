// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/blind/mark_list.hpp"

namespace plumb::tests {
namespace {

using offline::Finding;
bool known_one(const Score& s) { return s.drawn.group == Group::kOne; }

void add_naming(MarkList& m) {
  m.at_least("right class first, >= 1 sigma", 0.95, known_one,
             [](const Score& s) { return s.class_first; });
  m.at_least("right effect and joint first", 0.90, known_one,
             [](const Score& s) { return s.joint_first; });
  m.at_least(
      "effect of 0.5 sigma, N >= 150", 0.85,
      [](const Score& s) { return s.drawn.group == Group::kWeak; },
      [](const Score& s) { return s.class_first; });
  m.at_most(
      "nothing hidden, yet something named", 0.01,
      [](const Score& s) { return s.drawn.group == Group::kNothing; },
      [](const Score& s) { return s.finding != Finding::kComplete; });
  m.at_most(
      "cases with a false extra effect", 0.03,
      [](const Score& s) { return s.drawn.group != Group::kUnknown; },
      [](const Score& s) { return s.extra > 0; });
  m.at_most(
      "cases with an unrelated extra effect", 0.01,
      [](const Score& s) { return s.drawn.group != Group::kUnknown; },
      [](const Score& s) { return s.claims && s.claims->unrelated > 0; });
  m.at_least(
      "unknown effect: verdict and inputs, >= 2 sigma", 0.95,
      [](const Score& s) { return s.drawn.group == Group::kUnknown; },
      [](const Score& s) { return s.unknown_said && s.inputs_right; });
  m.at_most(
      "known effect called unknown", 0.01,
      [](const Score& s) { return s.drawn.group == Group::kOne || s.drawn.group == Group::kWeak; },
      [](const Score& s) { return s.finding == Finding::kUnknown; });
  m.at_least(
      "step of 5 sigma: pose within 1", 0.95,
      [](const Score& s) { return s.drawn.group == Group::kStep; },
      [](const Score& s) { return s.step_found; });
  for (std::size_t i = 0; i < 3; ++i)
    m.at_least(
        fmt::format("three effects: recall of the one of {} sigma", i == 0   ? 5
                                                                    : i == 1 ? 2
                                                                             : 1),
        i == 0   ? 0.97
        : i == 1 ? 0.90
                 : 0.80,
        [](const Score& s) { return s.drawn.group == Group::kThree; },
        [i](const Score& s) { return s.recalled[i]; });
}

/// The scale of a tracker and the size of the arm are one: no diagnosis can undo that.
bool hides_tracker(const Score& s) {
  return std::any_of(s.drawn.hidden.begin(), s.drawn.hidden.end(),
                     [](const auto& h) { return h.law == "tracker"; });
}

/// What is hidden acts on fresh poses as it did on the measured ones.
bool is_steady(const Score& s) {
  return !hides_tracker(s) && (s.drawn.group == Group::kNothing || s.drawn.group == Group::kOne ||
                               s.drawn.group == Group::kWeak);
}

void add_errors(MarkList& m) {
  struct Row {
    int poses;
    double error, held;
  };
  for (const Row& row :
       {Row{45, 0.80, 1.25}, Row{150, 0.45, 1.10}, Row{500, 0.30, 1.05}, Row{1500, 0.25, 1.05}}) {
    const Which strong = [row](const Score& s) {
      return s.drawn.group == Group::kOne && s.drawn.request.poses == row.poses &&
             s.drawn.hidden.front().sigmas == 5.0 && !hides_tracker(s);
    };
    m.median_at_most(fmt::format("true error after, 5 sigma effect, N = {} [sigma]", row.poses),
                     row.error, strong, [](const Score& s) { return s.after; });
    m.median_at_most(fmt::format("held-out RMS / floor, N = {}", row.poses), row.held, strong,
                     [](const Score& s) { return s.held_over_floor; });
  }
  for (const auto& [poses, within] : {std::pair{45, 0.20}, std::pair{500, 0.08}})
    m.at_least(
        fmt::format("reported held-out error within {:.0f} % of the truth, N = {}", 100.0 * within,
                    poses),
        0.95,
        [poses = poses](const Score& s) { return s.drawn.request.poses == poses && is_steady(s); },
        [within](const Score& s) { return std::abs(s.held_over_true - 1.0) <= within; });
  m.at_least(
      "what was added lowered the true error", 0.97,
      [](const Score& s) { return s.added > 0 && !hides_tracker(s); },
      [](const Score& s) { return s.after < s.before; });
  m.at_least(
      "a tree on the rest hurts by 1 % at most", 0.99,
      [](const Score& s) { return s.with_tree >= 0.0; },
      [](const Score& s) { return s.with_tree <= 1.01 * s.after + 0.02; });
  m.at_most(
      "worse than geometry only", 0.005, [](const Score& s) { return !hides_tracker(s); },
      is_worse);
}

std::string result_of(const Mark& mark) {
  if (mark.reached) return "passed";
  return mark.passed ? "missed, within the allowance" : "missed";
}

std::string claims_text(const Score& s) {
  if (!s.claims) return "";
  const Claims& c = *s.claims;
  return fmt::format(
      " lead {:.1f} {}{}{}{} unrelated {}{} fall {:.2f}+-{:.2f} true {:.2f} held/true {:.2f}",
      c.lead, c.first_right ? "right" : "wrong", c.alarm ? "" : " silent",
      c.either ? (c.either_right ? " either-right" : " either-wrong") : "",
      c.first_doubtful ? " doubtful" : "", c.unrelated,
      c.doubtful_right > 0 ? fmt::format(" right-but-doubtful {}", c.doubtful_right) : "", c.fall,
      c.fall_se, c.fall_counts ? c.true_fall : 0.0, s.held_over_true);
}

}  // namespace

std::vector<Mark> marks_of(const std::vector<Score>& scores, double granted) {
  MarkList out(scores, granted);
  add_naming(out);
  add_errors(out);
  return out.take();
}

std::string table_of(const std::vector<Mark>& marks) {
  std::string out = "| mark | found | pass | |\n|---|---|---|---|\n";
  for (const auto& m : marks)
    out += fmt::format("| {} | {} | {} | {} |\n", m.what, m.value, m.pass, result_of(m));
  return out;
}

std::string line_of(int number, const Score& s) {
  std::string hidden;
  for (const auto& effect : s.drawn.request.effects) hidden += " " + effect;
  if (!s.drawn.kind.empty()) hidden = " [" + s.drawn.kind + "]" + hidden;
  if (!s.made)
    return fmt::format("{} {}{}: not made: {}", number, name_of(s.drawn.group), hidden, s.why_not);
  return fmt::format(
      "{} {} N={} class {} joint {} extra {} unk {} in {} err {:.2f}->{:.2f} held {:.2f} of floor, "
      "{:.3f} of truth {:.2f}s{} "
      "{} || {}",
      number, name_of(s.drawn.group), s.drawn.request.poses, s.class_first, s.joint_first, s.extra,
      s.unknown_said, s.inputs_right, s.before, s.after, s.held_over_floor, s.held_over_true,
      s.seconds, hidden, claims_text(s), s.said);
}

}  // namespace plumb::tests
