// SPDX-License-Identifier: Apache-2.0
#include "tree/domain.hpp"

#include <algorithm>

#include "plumb/runtime/detail/trained_domain.hpp"

namespace plumb::offline {
namespace {

constexpr double kSmallestSpan = 1e-6;  // of a joint's trained range [rad] or [m]

}  // namespace

format::Domain trained_box(const Samples& q) {
  format::Domain out;
  for (Eigen::Index k = 0; k < q.cols(); ++k) {
    const double low = q.col(k).minCoeff(), high = q.col(k).maxCoeff();
    const double hair = std::max(0.0, kSmallestSpan - (high - low)) / 2.0;
    out.q_min.push_back(low - hair);
    out.q_max.push_back(high + hair);
  }
  return out;
}

int moving_joints(const Samples& q) {
  int count = 0;
  for (Eigen::Index k = 0; k < q.cols(); ++k)
    count += q.col(k).maxCoeff() - q.col(k).minCoeff() > kSmallestSpan;
  return count;
}

Samples normalised(const format::Domain& domain, const Samples& q) {
  const TrainedDomain trained(domain);
  Samples out(q.rows(), q.cols());
  std::array<double, format::kMaxJoints> u;
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    const SampleRow row(q, i);
    trained.normalise(row.span(), {u.data(), row.span().size()});
    for (Eigen::Index k = 0; k < q.cols(); ++k) out(i, k) = u[k];
  }
  return out;
}

Eigen::VectorXd trust(const format::Domain& domain, const Samples& q) {
  const TrainedDomain trained(domain);
  Eigen::VectorXd out(q.rows());
  std::array<double, format::kMaxJoints> u;
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    const SampleRow row(q, i);
    out[i] = trained.normalise(row.span(), {u.data(), row.span().size()});
  }
  return out;
}

}  // namespace plumb::offline
