// SPDX-License-Identifier: Apache-2.0
#include "diagnose/confounding.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnose/constants.hpp"
#include "effects/registry.hpp"
#include "numbers/cholesky.hpp"
#include "numbers/products.hpp"

namespace plumb::offline {
namespace {

struct Seen {
  Eigen::MatrixXd X;  // columns cleared of the model, over the fit lines
  Eigen::VectorXd motion;
  SymmetricSolver gram;
};

Seen seen_of(const WhitenedFit& s, const Found& found) {
  Seen out;
  out.X = motions(s, regressor_of(s, found)).topRows(s.fit_lines);
  const auto U = s.U.topRows(s.fit_lines);
  out.X -= U * transposed_product(U, out.X);
  out.motion = out.X * found.scored.theta;
  Eigen::MatrixXd gram = gram_matrix(out.X);
  // Columns are often linearly dependent. A small ridge keeps the equations solvable.
  gram.diagonal().array() += 1e-10 * gram.diagonal().maxCoeff();
  out.gram = SymmetricSolver(gram);
  return out;
}

/// Share of the squared motion of one effect that the columns of the other reproduce.
double share_of(const Seen& moved, const Seen& by) {
  const Eigen::VectorXd c = by.X.transpose() * moved.motion;
  const double whole = moved.motion.squaredNorm();
  return whole > 0.0 ? std::clamp(c.dot(by.gram.solve(c)) / whole, 0.0, 1.0) : 0.0;
}

}  // namespace

Eigen::MatrixXd reproduction(const WhitenedFit& whitened,
                             const std::vector<const Found*>& candidates) {
  std::vector<Seen> seen;
  for (const Found* found : candidates) seen.push_back(seen_of(whitened, *found));
  const auto n = static_cast<Eigen::Index>(seen.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k) {
      if (i != k) out(i, k) = share_of(seen[i], seen[k]);
    }
  return out;
}

std::vector<double> mutual_reproduction(const WhitenedFit& whitened, const Found& first,
                                        const std::vector<const Found*>& others) {
  std::vector<double> out;
  if (others.empty()) return out;
  const Seen own = seen_of(whitened, first);
  for (const Found* other : others) {
    const Seen its = seen_of(whitened, *other);
    out.push_back(std::min(share_of(own, its), share_of(its, own)));
  }
  return out;
}

std::vector<std::string> disguises(const EffectEntry& entry) {
  const auto same = descriptor_of(entry.name).same_motion;
  return std::vector<std::string>(same.begin(), same.end());
}

const Found* tied_with_first(const WhitenedFit& whitened, const Scan& scan) {
  const Found* first = scan.supported();
  if (first == nullptr) return nullptr;
  for (const auto& other : scan.library) {
    if (other.entry.name == first->entry.name ||
        std::abs(other.ln_bayes() - first->ln_bayes()) > kSameEvidence)
      continue;
    const Eigen::MatrixXd share = reproduction(whitened, {first, &other});
    if (std::min(share(0, 1), share(1, 0)) > kSameMotion) return &other;
  }
  return nullptr;
}

std::string separating_measurement(const EffectEntry& a, const EffectEntry& b) {
  const EffectDescriptor &first = descriptor_of(a.name), &second = descriptor_of(b.name);
  const unsigned only = first.law->needs ^ second.law->needs;
  if ((only & kNeedsDirection) != 0) return "the same poses approached from + and from -";
  if ((only & kNeedsSteps) != 0) return "poses reached by short and by long moves of the joint";
  if ((only & kNeedsTemperature) != 0) return "the same poses cold and warm";
  if ((only & (kNeedsTime | kNeedsOrder)) != 0) return "the first poses again at the end";
  if (grows_with_load(first) || grows_with_load(second))
    return "the same poses with and without payload";
  if (a.joints != b.joints) return "one of the joints swept alone, the others at rest";
  return "more poses over the whole range of the joint";
}

}  // namespace plumb::offline
