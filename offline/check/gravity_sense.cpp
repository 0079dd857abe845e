// SPDX-License-Identifier: Apache-2.0
#include "check/gravity_sense.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "check/constants.hpp"
#include "effects/registry.hpp"
#include "noise/weights.hpp"
#include "numbers/lu.hpp"
#include "numbers/pivoted_qr.hpp"
#include "plumb/runtime/chain.hpp"
#include "solve/evaluation.hpp"
#include "solve/outlier.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// Result of fitting the residuals by the moments of gravity along one direction.
struct Yielding {
  double left = 1e300;    // sum of squares
  Eigen::VectorXd times;  // coefficient of each joint over its standard deviation; 0: none
};

class GravityTest {
 public:
  GravityTest(const Cell& cell, const Measurements& measured, const std::vector<int>& rows,
              const Calibration& fitted)
      : state_(fitted.state), some_(pick(measured, rows)), joints_(cell.joints()) {
    FitData data;
    data.measured = &some_;
    data.sigma_m = Rows3::Ones(some_.size(), 3);
    for (int i = 0; i < some_.size(); ++i) data.rows.push_back(i);
    const Solution here = evaluate(data, state_, fitted.parameters);
    const auto count = static_cast<Eigen::Index>(fitted.parameters.size());
    basis_ = householder_basis(here.jacobian, count);
    residual_ = without_geometry(here.residual);
  }

  double all() const { return residual_.squaredNorm(); }
  bool can_tell() const {
    return residual_.size() >= basis_.cols() + joints_ + check::kSpareResiduals;
  }

  /// d: a direction in the base frame, of length 1.
  Yielding along(const Vector3& d) const {
    const Eigen::MatrixXd A = without_geometry(
        turns([&](int, int, const Vector3& z, const Vector3& r) { return z.dot(r.cross(d)); }));
    std::vector<int> used;
    for (int j = 0; j < joints_; ++j)
      if (A.col(j).norm() > 1e-6) used.push_back(j);
    Eigen::MatrixXd B(A.rows(), static_cast<Eigen::Index>(used.size()));
    for (std::size_t k = 0; k < used.size(); ++k)
      B.col(static_cast<Eigen::Index>(k)) = A.col(used[k]);
    Yielding out{.left = all(), .times = Eigen::VectorXd::Zero(joints_)};
    if (used.empty()) return out;
    Eigen::MatrixXd N = B.transpose() * B;
    N.diagonal() *= 1.0 + 1e-9;
    const Eigen::MatrixXd inverse = plumb::offline::inverse(N);
    const Eigen::VectorXd k = inverse * (B.transpose() * residual_);
    out.left = (residual_ - B * k).squaredNorm();
    const auto freedom = static_cast<double>(residual_.size() - basis_.cols() -
                                             static_cast<Eigen::Index>(used.size()));
    for (std::size_t i = 0; i < used.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      out.times(used[i]) = k(at) / std::sqrt(out.left / freedom * inverse(at, at));
    }
    return out;
  }

  /// Sum of squares that is left after fitting errors with a period of one turn. Eccentric gears
  /// have such errors, and they resemble gravity in some direction.
  double left_by_gears() const {
    Eigen::MatrixXd B(residual_.size(), 2 * joints_);
    const auto angle = [&](int i, int j) { return some_.q(i, j); };
    B << without_geometry(
        turns([&](int i, int j, const Vector3&, const Vector3&) { return std::sin(angle(i, j)); })),
        without_geometry(turns(
            [&](int i, int j, const Vector3&, const Vector3&) { return std::cos(angle(i, j)); }));
    return (residual_ - B * PivotedQr(B).solve(residual_)).squaredNorm();
  }

 private:
  template <class Columns>
  Eigen::MatrixXd without_geometry(const Columns& v) const {
    return v - basis_ * (basis_.transpose() * v);
  }

  /// Column j: displacement of the points if joint j turns by size(row, j, its axis, the point
  /// relative to it).
  template <class Size>
  Eigen::MatrixXd turns(const Size& size) const {
    const Chain chain(state_.arm.calibrated);
    const Vector3 target(state_.X_TG.p[0], state_.X_TG.p[1], state_.X_TG.p[2]);
    const Transformd X_MB = from_pose(state_.X_MB);
    ChainFrames frames;
    Eigen::MatrixXd out(residual_rows(), joints_);
    for (int i = 0; i < some_.size(); ++i) {
      const auto q = some_.q.row(i);
      chain.frames({q.data(), static_cast<std::size_t>(q.cols())}, frames);
      const Vector3 point = frames.tip * target;
      for (int j = 0; j < joints_; ++j) {
        const Vector3 z = frames.joint[static_cast<std::size_t>(j)].R.col(2);
        const Vector3 lever = point - frames.joint[static_cast<std::size_t>(j)].p;
        const double turn = chain.revolute(j) ? size(i, j, z, lever) : 0.0;
        const Vector3 moved = X_MB.R * (z.cross(lever) * turn);
        Eigen::Index line = i * (out.rows() / some_.size());
        for (int k = 0; k < 3; ++k)
          if (some_.has_axis[static_cast<std::size_t>(k)]) out(line++, j) = moved(k);
      }
    }
    return out;
  }

  Eigen::Index residual_rows() const { return basis_.rows(); }

  const ArmState& state_;
  Measurements some_;
  int joints_;
  Eigen::MatrixXd basis_;
  Eigen::VectorXd residual_;
};

/// True if two or more joints clearly yield along the direction (against it for sign -1), and no
/// joint clearly the other way.
bool all_yield(const Yielding& y, double sign) {
  const double against =
      std::max(check::kAgainstDeviations, check::kAgainstShare * y.times.cwiseAbs().maxCoeff());
  int sure = 0;
  for (const double t : y.times) {
    if (sign * t < -against) return false;
    sure += sign * t > check::kYieldDeviations ? 1 : 0;
  }
  return sure >= check::kFewestYielding;
}

/// The direction along which the joints really yield if it is not g, else zero.
Vector3 contradicted_by(const GravityTest& test, const Vector3& g) {
  const double enough =
      std::min(check::kGravityExplains * test.all(), check::kBeatsGears * test.left_by_gears());
  const Yielding given = test.along(g);
  if (given.left < check::kGravityExplains * test.all())
    return given.left < enough && all_yield(given, -1.0) ? Vector3(-g) : Vector3(Vector3::Zero());
  Vector3 best = Vector3::Zero();
  double least = std::min(enough, check::kOtherDirection * given.left);
  for (int k = 0; k < 3; ++k) {
    const Vector3 axis = Vector3::Unit(k);
    const Yielding y = test.along(axis);
    if (y.left >= least) continue;
    least = y.left;
    best.setZero();
    if (all_yield(y, 1.0)) best = axis;
    if (all_yield(y, -1.0)) best = -axis;
  }
  return best;
}

std::string in_file(const Vector3& g) {
  const auto plain = [](double x) { return x == 0.0 ? 0.0 : x; };  // no -0
  return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", plain(g.x()), plain(g.y()), plain(g.z()));
}

std::optional<Problem> standing(const Cell& cell, const Vector3& g) {
  const double angle = std::acos(std::clamp(-g.z(), -1.0, 1.0));
  if (angle < check::kUpright) return std::nullopt;
  std::string how;
  if (angle > M_PI - check::kUpright)
    how = "upwards in the base frame: the arm hangs head down, from a ceiling";
  else if (std::abs(angle - M_PI_2) < check::kUpright)
    how = "sideways in the base frame: the arm is mounted on a wall, or moves in an upright plane";
  else
    how = fmt::format("{:.0f} deg off -z of the base: the arm is tilted by as much",
                      angle / check::kDegree_rad);
  return Problem{
      Severity::kNote, "N-CHECK-GRAVITY",
      fmt::format("gravity = {} points {}",
                  in_file(Vector3(cell.gravity[0], cell.gravity[1], cell.gravity[2])), how),
      std::nullopt, "if it stands upright on the floor: gravity = [0, 0, -9.81]"};
}

bool only_geometry(const Cell& cell) {
  return cell.effects.size() == 1 && is_geometry(cell.effects.front().name);
}

}  // namespace

std::vector<Problem> gravity_findings(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows, const Calibration& fitted) {
  const Vector3 full(cell.gravity[0], cell.gravity[1], cell.gravity[2]);
  if (!(full.norm() > 0.0))
    return {{Severity::kNote, "N-CHECK-GRAVITY",
             "gravity = [0, 0, 0] switches the weight of the arm off: no effect of a load can be "
             "found",
             std::nullopt, "if it stands upright on the floor: gravity = [0, 0, -9.81]"}};
  const Vector3 g = full.normalized();
  if (only_geometry(cell) && measured.setup.empty() && !fitted.parameters.empty()) {
    const GravityTest test(
        cell, measured,
        thinned(measured, without_outliers(rows, fitted.outliers), check::kGravityRows), fitted);
    const Vector3 other = test.can_tell() ? contradicted_by(test, g) : Vector3(Vector3::Zero());
    if (other.norm() > 0.0)
      return {{Severity::kWarning, "W-CHECK-GRAVITY",
               fmt::format("the joints yield as if gravity pointed along {}, not along {} as "
                           "cell.toml says",
                           in_file(other * full.norm()), in_file(full)),
               std::nullopt, "if the arm stands so: gravity = " + in_file(other * full.norm())}};
  }
  const auto note = standing(cell, g);
  return note ? std::vector<Problem>{*note} : std::vector<Problem>{};
}

}  // namespace plumb::offline
