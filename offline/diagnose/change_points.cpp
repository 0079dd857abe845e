// SPDX-License-Identifier: Apache-2.0
#include "diagnose/change_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnose/evidence.hpp"
#include "diagnose/trial.hpp"

namespace plumb::offline {
namespace {

constexpr double kTypical = 300e-6;  // m and rad: of `step` in the library
constexpr Eigen::Index kLeast = 4;   // poses on either side
constexpr double kSamePayload_kg = 1e-6;

/// Running products of one kind of motion over the poses behind a cut.
struct Running {
  EffectEntry entry;
  Eigen::MatrixXd carriers;  // (lines, c)
  Eigen::MatrixXd XX, UX;
  Eigen::VectorXd Xy;

  Running(const Stage& s, EffectEntry e, Eigen::MatrixXd motion)
      : entry(std::move(e)), carriers(std::move(motion)) {
    XX.setZero(carriers.cols(), carriers.cols());
    UX.setZero(s.rank, carriers.cols());
    Xy.setZero(carriers.cols());
  }
  void add(const Stage& s, Eigen::Index pose) {
    const auto X = carriers.middleRows(pose * s.axes, s.axes);
    XX.noalias() += X.transpose() * X;
    UX.noalias() += s.U.middleRows(pose * s.axes, s.axes).transpose() * X;
    Xy.noalias() += X.transpose() * s.y.segment(pose * s.axes, s.axes);
  }
};

/// Whether another tool hangs on the arm from this pose on: one payload before, one behind. Joints
/// then yield by another torque; that is no slipped encoder.
bool changes_payload(const Stage& s, const std::vector<Eigen::Index>& order, Eigen::Index cut) {
  const auto payload = [&](Eigen::Index i) { return s.context[order[i]].payload_kg; };
  if (!(std::abs(payload(cut) - payload(cut - 1)) > kSamePayload_kg)) return false;
  for (Eigen::Index k = 1; k < kLeast; ++k)
    if (payload(cut - 1 - k) != payload(cut - 1) || payload(cut + k) != payload(cut)) return false;
  return true;
}

EffectEntry step_of(const char* of, std::vector<int> joints = {}) {
  EffectEntry out{.name = "step", .joints = std::move(joints), .options = {}, .place = {}};
  out.options["of"] = std::string(of);
  return out;
}

std::vector<Running> kinds(const Stage& s) {
  std::vector<Running> out;
  out.emplace_back(s, step_of("tool"), s.tool * kTypical);
  out.emplace_back(s, step_of("base"), s.base * kTypical);
  for (int j = 0; j < s.joints(); ++j)
    out.emplace_back(s, step_of("joint", {j}), s.joint[j] * kTypical);
  return out;
}

}  // namespace

std::vector<ChangePoint> change_points(const Stage& s, int& tried) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(s.fit_poses()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return s.context[a].order < s.context[b].order; });
  const EvidenceScale scale = Judge(s).scale();
  std::vector<ChangePoint> out;
  const auto n = static_cast<Eigen::Index>(order.size());
  for (auto& kind : kinds(s)) {
    ChangePoint best{kind.entry, -1e300};
    for (Eigen::Index cut = n - 1; cut >= kLeast; --cut) {
      kind.add(s, order[cut]);
      if (n - cut < kLeast) continue;
      const double before = s.context[order[cut - 1]].order, after = s.context[order[cut]].order;
      if (!kind.entry.joints.empty() && changes_payload(s, order, cut)) continue;
      ++tried;
      const Evidence found = evidence(kind.XX - kind.UX.transpose() * kind.UX, kind.Xy, s.Q, scale);
      if (found.ln_bayes <= best.ln_bayes) continue;
      best.ln_bayes = found.ln_bayes;
      // Poses between the two were not looked at: the middle.
      best.entry.options["after_row"] = std::floor(0.5 * (before + after + 1.0));
    }
    if (best.ln_bayes > -1e300) out.push_back(std::move(best));
  }
  return out;
}

}  // namespace plumb::offline
