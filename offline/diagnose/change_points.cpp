// SPDX-License-Identifier: Apache-2.0
#include "diagnose/change_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnose/constants.hpp"
#include "diagnose/evidence_scale.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

constexpr double kSamePayload_kg = 1e-6;

/// Running products of one kind of motion over the poses behind a cut.
struct Running {
  EffectEntry entry;
  Eigen::MatrixXd carriers;  // (lines, c)
  Eigen::MatrixXd XX, UX;
  Eigen::VectorXd Xy;

  Running(const WhitenedFit& s, EffectEntry e, Eigen::MatrixXd motion)
      : entry(std::move(e)), carriers(std::move(motion)) {
    XX.setZero(carriers.cols(), carriers.cols());
    UX.setZero(s.rank, carriers.cols());
    Xy.setZero(carriers.cols());
  }
  void add(const WhitenedFit& s, Eigen::Index pose) {
    const auto X = carriers.middleRows(pose * s.axes, s.axes);
    XX.noalias() += X.transpose() * X;
    UX.noalias() += s.U.middleRows(pose * s.axes, s.axes).transpose() * X;
    Xy.noalias() += X.transpose() * s.y.segment(pose * s.axes, s.axes);
  }
};

/// Whether another tool hangs on the arm from this pose on: one payload before, one behind. Joints
/// then yield by another torque; that is no slipped encoder.
bool changes_payload(const WhitenedFit& s, const std::vector<Eigen::Index>& order,
                     Eigen::Index cut) {
  const auto payload = [&](Eigen::Index i) { return s.context[order[i]].known.payload_kg; };
  if (!(std::abs(payload(cut) - payload(cut - 1)) > kSamePayload_kg)) return false;
  for (Eigen::Index k = 1; k < kFewestBesideStep; ++k)
    if (payload(cut - 1 - k) != payload(cut - 1) || payload(cut + k) != payload(cut)) return false;
  return true;
}

EffectEntry step_of(const char* of, std::vector<int> joints = {}) {
  EffectEntry out{
      .name = change_point_effect(), .joints = std::move(joints), .options = {}, .place = {}};
  set_option(out, OptionKey::kOf, std::string(of));
  return out;
}

std::vector<Running> kinds(const WhitenedFit& s) {
  std::vector<Running> out;
  out.emplace_back(s, step_of("tool"), s.tool * kTypicalStep);
  out.emplace_back(s, step_of("base"), s.base * kTypicalStep);
  for (int j = 0; j < s.joints(); ++j)
    out.emplace_back(s, step_of("joint", {j}), s.joint[j] * kTypicalStep);
  return out;
}

std::vector<Eigen::Index> in_order(const WhitenedFit& s) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(s.fit_poses()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return s.context[a].order < s.context[b].order; });
  return order;
}

/// Poses between the two were not looked at: the middle.
double between(double before, double after) { return std::floor(0.5 * (before + after + 1.0)); }

}  // namespace

std::vector<ChangePoint> change_points(const WhitenedFit& s, int& tried) {
  const std::vector<Eigen::Index> order = in_order(s);
  const EvidenceScale scale = evidence_scale(s);
  std::vector<ChangePoint> out;
  const auto n = static_cast<Eigen::Index>(order.size());
  for (auto& kind : kinds(s)) {
    ChangePoint best{kind.entry, -1e300};
    for (Eigen::Index cut = n - 1; cut >= kFewestBesideStep; --cut) {
      kind.add(s, order[cut]);
      if (n - cut < kFewestBesideStep) continue;
      const double before = s.context[order[cut - 1]].order, after = s.context[order[cut]].order;
      if (!kind.entry.joints.empty() && changes_payload(s, order, cut)) continue;
      ++tried;
      const Evidence found = evidence(kind.XX - kind.UX.transpose() * kind.UX, kind.Xy, s.Q, scale);
      if (found.ln_bayes <= best.ln_bayes) continue;
      best.ln_bayes = found.ln_bayes;
      set_option(best.entry, OptionKey::kAfterRow, between(before, after));
    }
    if (best.ln_bayes > -1e300) out.push_back(std::move(best));
  }
  return out;
}

void sharpen(const WhitenedFit& s, Eigen::Index poses, EffectEntry& step) {
  const std::vector<Eigen::Index> order = in_order(s);
  const EvidenceScale scale = evidence_scale(s);
  auto all = kinds(s);
  const auto kind = std::find_if(all.begin(), all.end(), [&](const Running& one) {
    return one.entry.joints == step.joints &&
           text_option(one.entry, OptionKey::kOf, "") == text_option(step, OptionKey::kOf, "");
  });
  if (kind == all.end()) return;
  const double after_row = number_option(step, OptionKey::kAfterRow, 0.0);
  const auto n = static_cast<Eigen::Index>(order.size());
  const Eigen::Index found =
      std::partition_point(order.begin(), order.end(),
                           [&](auto pose) { return s.context[pose].order < after_row; }) -
      order.begin();
  double best = kImpossible;
  for (Eigen::Index cut = n - 1; cut >= std::max(kFewestBesideStep, found - poses); --cut) {
    kind->add(s, order[cut]);
    if (n - cut < kFewestBesideStep || cut > found + poses) continue;
    const Evidence here =
        evidence(kind->XX - kind->UX.transpose() * kind->UX, kind->Xy, s.Q, scale);
    if (here.ln_bayes <= best) continue;
    best = here.ln_bayes;
    set_option(step, OptionKey::kAfterRow,
               between(s.context[order[cut - 1]].order, s.context[order[cut]].order));
  }
}

}  // namespace plumb::offline
