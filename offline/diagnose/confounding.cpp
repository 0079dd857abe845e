// SPDX-License-Identifier: Apache-2.0
#include "diagnose/confounding.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "plumb/runtime/effect_library.hpp"

namespace plumb::offline {
namespace {

constexpr double kSameEvidence = 0.5;   // nats
constexpr double kSameMotion = 0.9999;  // share, either way

struct Seen {
  Eigen::MatrixXd X;  // columns cleared of the model, over the fit lines
  Eigen::VectorXd motion;
  Eigen::LDLT<Eigen::MatrixXd> gram;
};

Seen seen_of(const Stage& s, const Found& found) {
  Seen out;
  out.X = motions(s, block_of(s, found)).topRows(s.fit_lines);
  const auto U = s.U.topRows(s.fit_lines);
  out.X -= U * (U.transpose() * out.X).eval();
  out.motion = out.X * found.trial.theta;
  Eigen::MatrixXd gram = out.X.transpose() * out.X;
  // Columns that repeat each other are common; a trace of the largest keeps this solvable.
  gram.diagonal().array() += 1e-10 * gram.diagonal().maxCoeff();
  out.gram.compute(gram);
  return out;
}

bool depends_on_torque(const EffectInfo& info) {
  return (info.needs & (kNeedsMasses | kNeedsPayload)) != 0 || info.name == "gravity_free";
}

}  // namespace

Eigen::MatrixXd reproduction(const Stage& stage, const std::vector<const Found*>& candidates) {
  std::vector<Seen> seen;
  for (const Found* found : candidates) seen.push_back(seen_of(stage, *found));
  const auto n = static_cast<Eigen::Index>(seen.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k) {
      if (i == k) continue;
      const Eigen::VectorXd c = seen[k].X.transpose() * seen[i].motion;
      const double whole = seen[i].motion.squaredNorm();
      out(i, k) = whole > 0.0 ? std::clamp(c.dot(seen[k].gram.solve(c)) / whole, 0.0, 1.0) : 0.0;
    }
  return out;
}

std::vector<std::string> disguises(const EffectEntry& entry) {
  std::vector<std::string> out;
  if (entry.name == "gear_harmonics") {
    out = {"encoder_eccentricity"};
  }
  return out;
}

const Found* tied_with_first(const Stage& stage, const Scan& scan) {
  const Found* first = scan.supported();
  if (first == nullptr) return nullptr;
  for (const auto& other : scan.library) {
    if (other.entry.name == first->entry.name ||
        std::abs(other.ln_bayes() - first->ln_bayes()) > kSameEvidence)
      continue;
    const Eigen::MatrixXd share = reproduction(stage, {first, &other});
    if (std::min(share(0, 1), share(1, 0)) > kSameMotion) return &other;
  }
  return nullptr;
}

std::string separating_measurement(const EffectEntry& a, const EffectEntry& b) {
  const EffectInfo& first = effect_info(find_effect_law(a.name));
  const EffectInfo& second = effect_info(find_effect_law(b.name));
  const unsigned only = first.needs ^ second.needs;
  if ((only & kNeedsDirection) != 0) return "the same poses approached from + and from -";
  if ((only & kNeedsSteps) != 0) return "the same poses again after a longer wait";
  if ((only & kNeedsTemperature) != 0) return "the same poses cold and warm";
  if ((only & (kNeedsTime | kNeedsOrder)) != 0) return "the first poses again at the end";
  if (depends_on_torque(first) || depends_on_torque(second))
    return "the same poses with and without payload";
  if (a.joints != b.joints) return "one of the joints swept alone, the others at rest";
  return "more poses over the whole range of the joint";
}

}  // namespace plumb::offline
