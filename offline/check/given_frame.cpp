// SPDX-License-Identifier: Apache-2.0
#include "check/given_frame.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "cell/rotation.hpp"
#include "cell/units.hpp"
#include "check/constants.hpp"
#include "check/regularised_fit.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

/// Share of the target's information that is added to it: a target that no pose shows becomes 0.
constexpr double kFrameRidge = 1e-9;
/// Last digits of a frame in a message: 0.1 mm and 0.01 deg.
constexpr double kRound_m = 1e-4, kRound_rad = M_PI / 18000.0;

struct InFrame {
  Convention convention;
  double rms_m;
};

/// Which wrong unit explains the difference of the two frames, in words; empty if none does.
std::string unit_words(const Transformd& given, const Transformd& meant) {
  for (const auto& [factor, words] : {std::pair{1e3, "its xyz is in m instead of mm"},
                                      std::pair{1e-3, "its xyz is in mm instead of m"},
                                      std::pair{25.4, "its xyz is in inches instead of mm"}})
    if ((meant.p - factor * given.p).norm() < check::kFrameUnit * meant.p.norm()) return words;
  return "";
}

/// How the frame that fits differs from the given one: "it is turned by 37.0 deg about z".
std::string difference_words(const Transformd& given, const Transformd& meant) {
  const Transformd D = given.inverse() * meant;  // base axes as given
  const Eigen::AngleAxisd turn(D.R);
  std::vector<std::string> out;
  if (turn.angle() > check::kFrameTurned_rad) {
    const Eigen::Vector3d axis = turn.axis();
    int along = 0;
    axis.cwiseAbs().maxCoeff(&along);
    const bool one_axis = std::abs(axis(along)) > check::kAlongAxis;
    out.push_back(one_axis
                      ? fmt::format("it is turned by {:.1f} deg about {}",
                                    turn.angle() * 180.0 / M_PI, "xyz"[along])
                      : fmt::format("it is turned by {:.1f} deg about ({:.2f}, {:.2f}, {:.2f})",
                                    turn.angle() * 180.0 / M_PI, axis(0), axis(1), axis(2)));
  }
  if (const std::string unit = unit_words(given, meant); !unit.empty()) {
    out.push_back(unit);
  } else if (D.p.norm() > check::kFrameMoved_m) {
    int along = 0;
    const double most = D.p.cwiseAbs().maxCoeff(&along);
    out.push_back(most > check::kAlongAxis * D.p.norm()
                      ? fmt::format("it is {:.0f} mm off along its {}", 1e3 * most, "xyz"[along])
                      : fmt::format("it is {:.0f} mm off", 1e3 * D.p.norm()));
  }
  return fmt::format("{}", fmt::join(out, " and "));
}

/// Whether the frames differ by a rotation about the first joint's axis, which a wrong zero of that
/// joint would explain as well.
bool may_be_first_zero(const Cell& cell, const Transformd& given, const Transformd& meant) {
  const auto& row = cell.nominal.joints.front();
  const bool about_z = cell.nominal.convention == format::Convention::kStandard ||
                       (row.alpha == 0.0 && row.a == 0.0);
  const Transformd D = given.inverse() * meant, base = from_pose(cell.nominal.base);
  const Eigen::AngleAxisd turn(D.R);
  return about_z && row.type == format::JointType::kRevolute &&
         turn.angle() > check::kFrameTurned_rad &&
         std::abs(turn.axis().dot(base.R.col(2))) > check::kAlongAxis &&
         (D * base.p - base.p).norm() < check::kFrameMoved_m;
}

/// The frame as the cell file would state it, to 0.1 mm and 0.01 deg.
std::string frame_text(const Cell& cell, const format::Pose& X_MB) {
  const auto list = [](const std::array<double, 3>& si, double step, const std::string& unit) {
    std::array<double, 3> shown{};
    for (std::size_t k = 0; k < 3; ++k)
      shown[k] = unit_of(unit)->from_si(std::round(si[k] / step) * step) + 0.0;
    return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", shown[0], shown[1], shown[2]);
  };
  return fmt::format("{{ xyz = {}, rpy = {} }}", list(X_MB.p, kRound_m, cell.length_unit),
                     list(rpy_from_quaternion(X_MB.q), kRound_rad, cell.angle_unit));
}

}  // namespace

std::optional<Problem> given_frame_fault(const Cell& cell, const Measurements& measured,
                                         const std::vector<int>& rows) {
  if (cell.measurement.fit_frame || !cell.measurement.setups.empty()) return std::nullopt;
  const Measurements some = pick(measured, rows);
  std::vector<int> all(rows.size());
  std::iota(all.begin(), all.end(), 0);
  const RegularisedFit free = placed_from_the_labels(cell, some, all);
  const double size =
      std::sqrt((some.p_M.rowwise() - some.p_M.colwise().mean().eval()).squaredNorm() /
                static_cast<double>(some.size()));
  if (free.rms_m > check::kFits * size) return std::nullopt;
  if (misfit_in_given_frame(cell, some, all) < check::kClearly * free.rms_m) return std::nullopt;
  const Transformd given = from_pose(cell.measurement.X_MB), meant = from_pose(free.state.X_MB);
  const std::string difference = difference_words(given, meant);
  if (difference.empty()) return std::nullopt;
  return Problem{
      .severity = Severity::kError,
      .code = "E-CHECK-FRAME",
      .message = fmt::format(
          "the given frame contradicts the points: {}; these points put the base at {}, to "
          "about {:.1f} mm",
          difference, frame_text(cell, free.state.X_MB), 1e3 * free.rms_m),
      .help =
          may_be_first_zero(cell, given, meant)
              ? fmt::format("correct [measurement] frame or, if it is the zero of {0} that "
                            "differs, the offset of {0}: these points cannot tell the two apart",
                            cell.nominal.joints.front().name)
              : "correct [measurement] frame, or let the readings tell it: frame = \"fit\""};
}

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
                            const Interpretation& best) {
  const auto left_by = [&](const Convention& c) {
    return misfit_in_given_frame(read_as(cell, labels, c), read_as(measured, cell, labels, c),
                                 rows);
  };
  InFrame found{best.convention, left_by(best.convention)};
  const double as_given = found.rms_m;
  for (int mirror = 0; mirror <= static_cast<int>(Mirror::kSwapXZ); ++mirror)
    for (const bool inverted : {false, true}) {
      Convention c = best.convention;
      // A fit with a free frame has shown whether the file is left-handed, but not which axis is
      // mirrored.
      if ((mirror == 0) != (c.mirror == Mirror::kNone)) continue;
      c.mirror = static_cast<Mirror>(mirror);
      c.frame_inverted = inverted;
      const double rms = left_by(c);
      if (rms < found.rms_m) found = {c, rms};
    }
  return check::kClearly * found.rms_m < as_given ? found.convention : best.convention;
}

}  // namespace plumb::offline
