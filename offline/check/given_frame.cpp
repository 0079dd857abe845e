// SPDX-License-Identifier: Apache-2.0
#include "check/given_frame.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

constexpr double kFrameClearly = 10.0;
constexpr double kFrameRidge = 1e-9;

struct InFrame {
  Convention convention;
  double rms_m;
};

}  // namespace

double misfit_in_given_frame(const Cell& cell, const Measurements& measured,
                             const std::vector<int>& rows) {
  // X_MB^-1 p_M = p_BT + R_BT t: linear in the reflector's place t.
  const Chain chain(cell.nominal);
  const Transformd X_MB = from_pose(cell.measurement.X_MB);
  Eigen::MatrixXd A(3 * rows.size(), 3);
  Eigen::VectorXd b(3 * rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto q = measured.q.row(rows[i]);
    const auto X_BT = chain.forward({q.data(), static_cast<std::size_t>(q.cols())});
    const Transformd X_MT = X_MB * X_BT;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<Eigen::Index>(3 * i) + k;
      const double used = measured.has_axis[k] ? 1.0 : 0.0;
      A.row(at) = used * X_MT.R.row(k);
      b(at) = used * (measured.p_M(rows[i], k) - X_MT.p(k));
    }
  }
  Eigen::Vector3d t(cell.measurement.target_T.data());
  if (cell.measurement.fit_target) {
    Eigen::Matrix3d N = A.transpose() * A;
    N.diagonal().array() += kFrameRidge * static_cast<double>(rows.size());
    t = N.ldlt().solve(A.transpose() * b);
  }
  return std::sqrt((b - A * t).squaredNorm() / static_cast<double>(rows.size()));
}

Convention with_given_frame(const Cell& cell, const Measurements& measured,
                            const std::vector<int>& rows, const Convention& labels,
                            const Reading& best) {
  const auto left_by = [&](const Convention& c) {
    return misfit_in_given_frame(read_as(cell, labels, c), read_as(measured, cell, labels, c),
                                 rows);
  };
  InFrame found{best.convention, left_by(best.convention)};
  const double as_given = found.rms_m;
  for (int mirror = 0; mirror <= static_cast<int>(Mirror::kSwapXZ); ++mirror)
    for (const bool inverted : {false, true}) {
      Convention c = best.convention;
      // A free frame shows whether the file is left-handed; only which axis is open.
      if ((mirror == 0) != (c.mirror == Mirror::kNone)) continue;
      c.mirror = static_cast<Mirror>(mirror);
      c.frame_inverted = inverted;
      const double rms = left_by(c);
      if (rms < found.rms_m) found = {c, rms};
    }
  return kFrameClearly * found.rms_m < as_given ? found.convention : best.convention;
}

}  // namespace plumb::offline
