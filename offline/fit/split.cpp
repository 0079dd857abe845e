// SPDX-License-Identifier: Apache-2.0
#include "fit/split.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "cell/group_rows.hpp"
#include "cell/random.hpp"
#include "cell/replicates.hpp"
#include "fit/constants.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline {
namespace {

/// One row of each replicate group that is used.
std::vector<int> representatives(const Measurements& m, const std::vector<bool>& used) {
  std::vector<int> first(count_groups(m.replicate_group), -1);
  for (int i = 0; i < m.size(); ++i)
    if (int& row = first[m.replicate_group[i]]; used[i] && row < 0) row = i;
  std::erase(first, -1);
  return first;
}

/// Orders rows so that neighbours in the list are neighbours in joint space (k-d order): splits
/// them at the median of the joint with the widest range, recursively.
void order_by_joints(const RowsN& q, std::vector<int>::iterator begin,
                     std::vector<int>::iterator end) {
  const auto count = end - begin;
  if (count < 3) return;
  Eigen::Index widest = 0;
  double width = -1.0;
  for (Eigen::Index k = 0; k < q.cols(); ++k) {
    const auto [low, high] =
        std::minmax_element(begin, end, [&](int a, int b) { return q(a, k) < q(b, k); });
    if (q(*high, k) - q(*low, k) > width) {
      width = q(*high, k) - q(*low, k);
      widest = k;
    }
  }
  const auto middle = begin + count / 2;
  std::nth_element(begin, middle, end, [&](int a, int b) {
    return q(a, widest) != q(b, widest) ? q(a, widest) < q(b, widest) : a < b;
  });
  order_by_joints(q, begin, middle);
  order_by_joints(q, middle, end);
}

std::vector<int> strata_order(const Measurements& m, const std::vector<bool>& used) {
  auto rows = representatives(m, used);
  if (m.setup.empty()) {
    order_by_joints(m.q, rows.begin(), rows.end());
    return rows;
  }
  // Set-up by set-up, so that the same share of each is held out.
  const auto setup = [&](int row) { return m.setup[static_cast<std::size_t>(row)]; };
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return setup(a) < setup(b); });
  for (auto begin = rows.begin(); begin != rows.end();) {
    const auto end =
        std::find_if(begin, rows.end(), [&](int row) { return setup(row) != setup(*begin); });
    order_by_joints(m.q, begin, end);
    begin = end;
  }
  return rows;
}

/// Copies the value of each replicate group to its rows.
template <class T>
void spread(const Measurements& m, const std::map<int, T>& by_group, std::vector<T>& out) {
  for (int i = 0; i < m.size(); ++i)
    if (const auto it = by_group.find(m.replicate_group[i]); it != by_group.end())
      out[i] = it->second;
}

[[noreturn]] void fail(std::string message, std::string help) {
  throw Failure(Exit::kInput,
                {.code = "E-SPLIT", .message = std::move(message), .help = std::move(help)});
}

void hold_share(const Measurements& m, double share, Random& random, Split& split) {
  const auto order = strata_order(m, split.used);
  const int n = static_cast<int>(order.size());
  const int wanted = std::max(1, static_cast<int>(std::lround(share * n)));
  if (wanted >= n)
    fail(fmt::format("{} cannot give a held-out share of {:.0f}%",
                     counted_words(n, "pose", "poses"), 100 * share),
         "set [measurement] held_out = \"kfold:5\"");
  std::vector<bool> held(count_groups(m.replicate_group), false);
  for (int k = 0; k < wanted; ++k) {
    const int begin = static_cast<int>(static_cast<long long>(k) * n / wanted);
    const int end = static_cast<int>(static_cast<long long>(k + 1) * n / wanted);
    held[m.replicate_group[order[begin + random.below(end - begin)]]] = true;
  }
  std::vector<bool> marks(m.size(), false);
  for (int i = 0; i < m.size(); ++i) marks[i] = split.used[i] && held[m.replicate_group[i]];
  split.held = marks;
}

void make_folds(const Measurements& m, int folds, Random& random, Split& split) {
  const auto order = strata_order(m, split.used);
  const int n = static_cast<int>(order.size());
  if (n < folds)
    fail(fmt::format("{} different poses cannot be split into {} folds", n, folds),
         "measure more poses");
  std::map<int, int> fold;
  std::vector<int> deal(folds);
  for (int begin = 0; begin < n; begin += folds) {
    std::iota(deal.begin(), deal.end(), 0);
    for (int k = folds - 1; k > 0; --k) std::swap(deal[k], deal[random.below(k + 1)]);
    for (int k = 0; k < folds && begin + k < n; ++k)
      fold[m.replicate_group[order[begin + k]]] = deal[k];
  }
  split.folds = folds;
  spread(m, fold, split.fold);
  for (int i = 0; i < m.size(); ++i)
    if (!split.used[i]) split.fold[i] = -1;
}

bool marks_held_rows(const Measurements& m) {
  return std::find(m.set.begin(), m.set.end(), SetMark::kHeld) != m.set.end();
}

void hold_marked(const Measurements& m, Split& split) {
  split.marked = true;
  for (int i = 0; i < m.size(); ++i) split.held[i] = m.set[i] == SetMark::kHeld;
  if (std::none_of(split.held.begin(), split.held.end(), [](bool b) { return b; }))
    fail("no row is marked 'held' in column 'set'", "mark some, or set held_out = \"20%\"");
}

void hold_last_file(const Measurements& m, Split& split) {
  if (m.file.empty() || m.file.front() == m.file.back())
    fail("the held-out file gave no rows", "check [measurement] held_out");
  for (int i = 0; i < m.size(); ++i)
    if (m.file[static_cast<std::size_t>(i)] == m.file.back()) split.held[i] = split.used[i];
}

/// Rows that repeat a held-out pose are not used at all: fitted, they would make its error look
/// smaller than that of a new pose.
void leave_out_repeats_of_held(const Measurements& m, Split& split) {
  std::vector<bool> held(count_groups(m.replicate_group), false);
  for (int i = 0; i < m.size(); ++i)
    if (split.held[i]) held[m.replicate_group[i]] = true;
  int left = 0;
  for (int i = 0; i < m.size(); ++i) {
    if (!split.used[i] || split.held[i]) continue;
    const bool repeats = held[m.replicate_group[i]];
    split.used[i] = !repeats;
    (repeats ? split.repeats_of_held : left) += 1;
  }
  if (left == 0 && split.repeats_of_held > 0)
    fail("every pose to be fitted is held out as well, so that nothing is left to fit",
         "hold out other poses than those fitted, or let plumb choose: plumb fit --held-out 20%");
}

std::size_t used_placements(const Measurements& m) {
  std::set<int> out;
  for (int i = 0; i < m.size() && !m.placement.empty(); ++i)
    if (m.placement[i] >= 0 && m.set[i] != SetMark::kIgnore) out.insert(m.placement[i]);
  return out.size();
}

/// The columns that a split reads, with replicate groups of the rows that stay together. They treat
/// the same pose in two set-ups as one: held out in one of them, it must not be fitted in the
/// other.
Measurements grouped(const Measurements& m, NeverSplit together) {
  Measurements out;
  out.q = m.q;
  out.set = m.set;
  out.setup = m.setup;
  out.kind = m.kind;
  out.placement = m.placement;
  out.file = m.file;
  out.replicate_group = pose_groups(m);
  if (together == NeverSplit::kPoses || used_placements(m) < kFewestPlacements) return out;
  const auto poses = static_cast<int>(count_groups(out.replicate_group));
  std::map<int, int> number;
  for (int i = 0; i < m.size(); ++i) {
    int& group = out.replicate_group[i];
    if (m.of_artefact(i)) group = poses + m.placement[i];
    group = number.emplace(group, static_cast<int>(number.size())).first->second;
  }
  return out;
}

/// Folds of rows that all touch fixed points, as many as there are placements; 0 of other rows, and
/// where there are too few placements.
int folds_of_placements(const Measurements& m, const std::vector<bool>& used) {
  if (m.placement.empty()) return 0;
  std::set<int> groups, placements;
  for (int i = 0; i < m.size(); ++i) {
    if (!used[i]) continue;
    if (m.placement[i] < 0) return 0;
    groups.insert(m.replicate_group[i]);
    placements.insert(m.placement[i]);
  }
  return groups.size() <= placements.size()
             ? std::min(static_cast<int>(groups.size()), kMostPlacementFolds)
             : 0;
}

/// Which rows belong to a set-up of few poses, shape (n,).
std::vector<bool> in_small_setup(const Measurements& m, const std::vector<bool>& used) {
  std::vector<bool> out(used.size(), false);
  if (m.setup.empty()) return out;
  std::map<int, std::set<int>> poses;
  for (int i = 0; i < m.size(); ++i)
    if (used[i]) poses[m.setup[static_cast<std::size_t>(i)]].insert(m.replicate_group[i]);
  for (int i = 0; i < m.size(); ++i)
    out[i] =
        !m.of_artefact(i) && poses[m.setup[static_cast<std::size_t>(i)]].size() < kFewestOfSetup;
  return out;
}

/// A set-up of few poses needs all of them for its frame and reflector, so none is held out.
void fit_all_of_small_setups(const Measurements& m, Split& split) {
  const std::vector<bool> small = in_small_setup(m, split.used);
  for (int i = 0; i < m.size(); ++i) {
    if (!small[i]) continue;
    split.fold[i] = -1;
    split.held[i] = false;
  }
}

Split split_of(const Measurements& m, const HeldOutRule& rule, std::uint64_t seed) {
  Split split;
  split.fold.assign(m.size(), -1);
  split.held.assign(m.size(), false);
  split.used.resize(m.size());
  for (int i = 0; i < m.size(); ++i) split.used[i] = m.set[i] != SetMark::kIgnore;
  Random random(seed);
  switch (rule.kind) {
    case HeldOutRule::Kind::kAuto:
      if (marks_held_rows(m))
        hold_marked(m, split);
      else if (const int folds = folds_of_placements(m, split.used); folds > 0)
        make_folds(m, folds, random, split);
      else if (static_cast<int>(representatives(m, split.used).size()) <= kFoldsUpTo)
        make_folds(m, kAutoFolds, random, split);
      else
        hold_share(m, kHeldShare, random, split);
      break;
    case HeldOutRule::Kind::kShare:
      hold_share(m, rule.share, random, split);
      break;
    case HeldOutRule::Kind::kFolds:
      make_folds(m, rule.folds, random, split);
      break;
    case HeldOutRule::Kind::kColumn:
      hold_marked(m, split);
      break;
    case HeldOutRule::Kind::kFile:
      hold_last_file(m, split);
      break;
  }
  if (!split.marked && rule.kind != HeldOutRule::Kind::kFile) fit_all_of_small_setups(m, split);
  leave_out_repeats_of_held(m, split);
  return split;
}

}  // namespace

Split split_poses(const Measurements& m, const HeldOutRule& rule, std::uint64_t seed,
                  NeverSplit together) {
  return m.setup.empty() ? split_of(m, rule, seed) : split_of(grouped(m, together), rule, seed);
}

std::vector<int> held_together(const Measurements& m) {
  return m.placement.empty() ? m.replicate_group
                             : grouped(m, NeverSplit::kPlacements).replicate_group;
}

std::vector<int> fit_rows(const Split& split) { return fit_rows(split, -2); }

std::vector<int> fit_rows(const Split& split, int fold) {
  std::vector<int> out;
  for (std::size_t i = 0; i < split.used.size(); ++i)
    if (split.used[i] && !split.held[i] && split.fold[i] != fold)
      out.push_back(static_cast<int>(i));
  return out;
}

std::vector<int> held_rows(const Split& split, int fold) {
  std::vector<int> out;
  for (std::size_t i = 0; i < split.used.size(); ++i)
    if (split.used[i] && split.fold[i] == fold) out.push_back(static_cast<int>(i));
  return out;
}

std::vector<int> held_rows(const Split& split) {
  std::vector<int> out;
  for (std::size_t i = 0; i < split.used.size(); ++i)
    if (split.used[i] && (split.held[i] || split.fold[i] >= 0)) out.push_back(static_cast<int>(i));
  return out;
}

std::vector<int> even_choice(const Measurements& m, const std::vector<int>& rows, int most,
                             std::uint64_t seed) {
  const Measurements some = grouped(pick(m, rows), NeverSplit::kPoses);
  Split split;
  split.used.assign(rows.size(), true);
  const auto poses = static_cast<int>(representatives(some, split.used).size());
  if (poses <= most && static_cast<int>(rows.size()) <= 2 * most) return rows;
  if (poses > most) {
    Random random(seed);
    hold_share(some, static_cast<double>(most) / poses, random, split);
  } else {
    split.held = split.used;
  }
  const std::vector<bool> small = in_small_setup(some, split.used);
  std::map<int, std::vector<int>> by_group;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (split.held[i] || small[i]) by_group[some.replicate_group[i]].push_back(rows[i]);
  const auto each = static_cast<std::size_t>(std::max(2, 2 * most / std::min(poses, most)));
  std::vector<int> out;
  for (const auto& [group, repeats] : by_group) {
    const std::size_t kept = std::min(each, repeats.size());
    for (std::size_t k = 0; k < kept; ++k) out.push_back(repeats[k * repeats.size() / kept]);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace plumb::offline
