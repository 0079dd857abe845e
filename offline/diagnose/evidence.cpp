// SPDX-License-Identifier: Apache-2.0
#include "diagnose/evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/constants.hpp"
#include "numbers/gaussian.hpp"
#include "numbers/spectrum.hpp"

namespace plumb::offline {
namespace {

double ln_bayes_at(double tau, const Eigen::ArrayXd& w, const Eigen::ArrayXd& v, double Q,
                   const EvidenceScale& scale) {
  const double ridge = scale.variance / (tau * tau);
  return evidence_gain((1.0 + w / ridge).log().sum(), scale.dof * scale.variance + Q,
                       (v.square() / (w + ridge)).sum(), scale.lines + scale.dof)
      .ln_bayes;
}

}  // namespace

Evidence evidence(const Eigen::MatrixXd& gram, const Eigen::VectorXd& v, double Q,
                  const EvidenceScale& scale) {
  if (gram.rows() == 0) return {};
  // Comparisons with NaN are always false, so a NaN score would be ranked arbitrarily.
  if (!gram.allFinite() || !v.allFinite() || !std::isfinite(Q)) return {.ln_bayes = kImpossible};
  Eigen::ArrayXd w, u;
  if (gram.rows() == 1) {
    w = gram.diagonal().array();
    u = v.array();
  } else {
    const SymmetricEigen eigen = symmetric_eigen(gram);
    w = eigen.values.array();
    u = (eigen.vectors.transpose() * v).array();
  }
  w = w.max(0.0);
  std::array<double, kPriorWidths.size()> ln{};
  std::size_t best = 0;
  for (std::size_t i = 0; i < kPriorWidths.size(); ++i) {
    ln[i] = ln_bayes_at(kPriorWidths[i], w, u, Q, scale);
    if (ln[i] > ln[best]) best = i;
  }
  double sum = 0.0;
  for (double l : ln) sum += std::exp(l - ln[best]);
  return {ln[best] + std::log(sum / static_cast<double>(kPriorWidths.size())), kPriorWidths[best]};
}

}  // namespace plumb::offline
