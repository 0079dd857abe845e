// SPDX-License-Identifier: Apache-2.0
#include "diagnose/change_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "diagnose/constants.hpp"
#include "diagnose/evidence_scale.hpp"
#include "effects/registry.hpp"
#include "fit/cut_search.hpp"
#include "fit/moving_part.hpp"
#include "fit/running_sums.hpp"

namespace plumb::offline {
namespace {

constexpr double kSamePayload_kg = 1e-6;

EffectEntry step_of(const MovingPart& part) {
  EffectEntry out{.name = change_point_effect(), .joints = {}, .options = {}, .place = {}};
  if (part.joint >= 0) out.joints = {part.joint};
  set_option(out, OptionKey::kOf, std::string(name_of(part.source)));
  return out;
}

Eigen::MatrixXd motions_of(const WhitenedFit& s, const MovingPart& part) {
  return part.source == MotionSource::kTool   ? s.tool
         : part.source == MotionSource::kBase ? s.base
                                              : Eigen::MatrixXd(s.joint[part.joint]);
}

/// A part that may have moved, and what is summed of its motions over the poses behind a cut.
struct Kind {
  EffectEntry entry;
  Eigen::MatrixXd motions;  // (lines, c) per typical step
  RunningSums behind;

  Kind(const WhitenedFit& s, const MovingPart& part)
      : entry(step_of(part)),
        motions(motions_of(s, part) * kTypicalStep),
        behind(motions.cols(), s.rank) {}

  void pass(const WhitenedFit& s, Eigen::Index pose) {
    behind.add(motions.middleRows(pose * s.axes, s.axes), s.y.segment(pose * s.axes, s.axes),
               s.U.middleRows(pose * s.axes, s.axes));
  }
  double ln_bayes(const WhitenedFit& s, const EvidenceScale& scale) const {
    return evidence(behind.XX - behind.UX.transpose() * behind.UX, behind.Xy, s.Q, scale).ln_bayes;
  }
};

/// Whether the payload changes at this pose: constant before and constant behind. The joints then
/// yield under another torque, which must not pass for a slipped encoder.
bool changes_payload(const WhitenedFit& s, const std::vector<Eigen::Index>& order,
                     Eigen::Index cut) {
  const auto payload = [&](Eigen::Index i) { return s.context[order[i]].known.payload_kg; };
  if (!(std::abs(payload(cut) - payload(cut - 1)) > kSamePayload_kg)) return false;
  for (Eigen::Index k = 1; k < kFewestBesideStep; ++k)
    if (payload(cut - 1 - k) != payload(cut - 1) || payload(cut + k) != payload(cut)) return false;
  return true;
}

std::vector<Eigen::Index> poses_in_order(const WhitenedFit& s) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(s.fit_poses()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  put_in_order(order, [&](Eigen::Index pose) { return s.context[pose].order; });
  return order;
}

/// The row before the cut; if rows between the two poses were not scanned, the middle of them.
double row_before(const WhitenedFit& s, const std::vector<Eigen::Index>& order, int cut) {
  const double before = s.context[order[cut - 1]].order, after = s.context[order[cut]].order;
  return std::floor(0.5 * (before + after + 1.0));
}

CutRange cuts_between(const std::vector<Eigen::Index>& order) {
  return cuts_of(VisitRun{0, static_cast<int>(order.size())}, static_cast<int>(kFewestBesideStep));
}

}  // namespace

std::vector<ChangePoint> change_points(const WhitenedFit& s, int& tried) {
  const std::vector<Eigen::Index> order = poses_in_order(s);
  const EvidenceScale scale = evidence_scale(s);
  std::vector<ChangePoint> out;
  for (const MovingPart& part : moving_parts(s.joints())) {
    Kind kind(s, part);
    const auto best = best_cut(
        static_cast<int>(order.size()), cuts_between(order),
        [&](int visit) { kind.pass(s, order[visit]); },
        [&](int cut) -> std::optional<double> {
          if (part.joint >= 0 && changes_payload(s, order, cut)) return std::nullopt;
          ++tried;
          return kind.ln_bayes(s, scale);
        });
    if (!best) continue;
    set_option(kind.entry, OptionKey::kAfterRow, row_before(s, order, best->cut));
    out.push_back({std::move(kind.entry), best->score});
  }
  return out;
}

void sharpen(const WhitenedFit& s, Eigen::Index poses, EffectEntry& step) {
  const std::vector<Eigen::Index> order = poses_in_order(s);
  const EvidenceScale scale = evidence_scale(s);
  const double after_row = number_option(step, OptionKey::kAfterRow, 0.0);
  const auto found = static_cast<int>(
      std::partition_point(order.begin(), order.end(),
                           [&](auto pose) { return s.context[pose].order < after_row; }) -
      order.begin());
  for (const MovingPart& part : moving_parts(s.joints())) {
    const EffectEntry one = step_of(part);
    if (one.joints != step.joints ||
        text_option(one, OptionKey::kOf, "") != text_option(step, OptionKey::kOf, ""))
      continue;
    Kind kind(s, part);
    const auto best = best_cut(
        static_cast<int>(order.size()),
        cuts_near(cuts_between(order), found, static_cast<int>(poses)),
        [&](int visit) { kind.pass(s, order[visit]); },
        [&](int) -> std::optional<double> { return kind.ln_bayes(s, scale); });
    if (best && best->score > kImpossible)
      set_option(step, OptionKey::kAfterRow, row_before(s, order, best->cut));
    return;
  }
}

}  // namespace plumb::offline
