// SPDX-License-Identifier: Apache-2.0
#include "cli/refusals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cell/units.hpp"
#include "numbers/spectrum.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

constexpr double kNearlyAll = 0.8;      // share of refused targets that a mistake must explain
constexpr double kNearPosition = 0.15;  // share of the reach: nearer targets fit their seeds
constexpr double kNearTurn_rad = 0.5;   // a target turned by less fits its seed, too
constexpr double kTakesPart = 0.35;     // least share of a joint in a motion of unit length
constexpr double kSpread = 0.1;         // scatter of a common offset, as a share of it
constexpr double kNoticeable_m = 0.05;  // a common offset smaller than this is not mentioned
constexpr std::size_t kShownSets = 3;   // sets of joints that are named

/// The farthest the tool can be from the base, or a little more.
double reach_of(const Chain& chain) {
  double sum = 0.0;
  for (int i = 1; i <= chain.joints(); ++i) sum += chain.constant(i).p.norm();
  return std::max(sum, 1e-3);
}

double turn(const Matrix3& A, const Matrix3& B) {
  return rotation_vector(Matrix3(A * B.transpose())).norm();
}

/// The most frequent sets of joints whose motions cancel, and the number of rows with other sets.
std::string cancelling(const std::map<std::string, std::size_t>& by_joints, std::size_t rows) {
  std::vector<std::pair<std::string, std::size_t>> order(by_joints.begin(), by_joints.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  order.resize(std::min(order.size(), kShownSets));
  std::vector<std::string> out;
  for (const auto& [joints, count] : order) {
    out.push_back(fmt::format("{} of {}", count, joints));
    rows -= count;
  }
  if (rows > 0) out.push_back(fmt::format("{} of others", rows));
  return fmt::format(" (where motions cancel: {})", fmt::join(out, "; "));
}

/// The orientation meant if its quaternion was written with the scalar last and read scalar first.
Matrix3 scalar_last(const Matrix3& R) {
  const auto q = to_pose({.R = R, .p = Vector3::Zero()}).q;
  return from_pose({{0.0, 0.0, 0.0}, {q[3], q[0], q[1], q[2]}}).R;
}

}  // namespace

Refusals::Refusals(const Corrector& corrector, const format::Chain& arm)
    : corrector_(&corrector), arm_(&arm), reach_m_(reach_of(corrector.nominal())) {}

void Refusals::add(const Transformd& X_BD, std::span<const double> seed, Status status,
                   bool has_orientation) {
  ++rows_;
  ++by_status_[status];
  if (status == Status::kNearSingular) ++by_joints_[singular_joints(seed)];
  compare(X_BD, seed, has_orientation);
}

void Refusals::add(const Refusals& more) {
  rows_ += more.rows_;
  for (const auto& [status, rows] : more.by_status_) by_status_[status] += rows;
  for (const auto& [joints, rows] : more.by_joints_) by_joints_[joints] += rows;
  for (std::size_t k = 0; k < explained_.size(); ++k) explained_[k] += more.explained_[k];
  for (std::size_t k = 0; k < scaled_.size(); ++k) scaled_[k] += more.scaled_[k];
  position_ = more.position_;
  position_unit_m_ = more.position_unit_m_;
  joint_ = more.joint_;
  farthest_m_ = std::max(farthest_m_, more.farthest_m_);
  beyond_reach_ += more.beyond_reach_;
  offset_sum_ += more.offset_sum_;
  offset_squares_ += more.offset_squares_;
}

/// The joints whose motions cancel at the tip: the large entries of the right singular vector of
/// the smallest singular value.
std::string Refusals::singular_joints(std::span<const double> seed) const {
  const Chain& chain = corrector_->nominal();
  ChainFrames frames;
  Jacobian J;
  chain.frames(seed, frames);
  jacobian(chain, frames, J);
  J.topRows<3>() /= corrector_->limits().length_scale_m;
  const Eigen::MatrixXd all = J.leftCols(chain.joints());
  const Eigen::VectorXd still = right_singular(all).vectors.rightCols<1>();
  std::vector<std::string> names;
  for (Eigen::Index j = 0; j < still.size(); ++j)
    if (std::abs(still(j)) > kTakesPart)
      names.push_back(arm_->joints[static_cast<std::size_t>(j)].name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void Refusals::compare(const Transformd& X_BD, std::span<const double> seed, bool has_orientation) {
  const Chain& chain = corrector_->nominal();
  const Transformd X_BN = chain.forward(seed);
  const double distance = X_BD.p.norm();
  const auto near = [&](const Vector3& p) {
    return (p - X_BN.p).norm() < kNearPosition * reach_m_;
  };
  farthest_m_ = std::max(farthest_m_, distance);
  beyond_reach_ += distance > 1.05 * (reach_m_ + chain.constant(0).p.norm()) ? 1 : 0;
  offset_sum_ += X_BD.p - X_BN.p;
  offset_squares_ += (X_BD.p - X_BN.p).squaredNorm();
  const bool placed = near(X_BD.p);
  for (std::size_t k = 0; k < kFactors.size(); ++k)
    scaled_[k] += !placed && near(X_BD.p * kFactors[k]) ? 1 : 0;
  if (placed && has_orientation && turn(X_BD.R, X_BN.R) > kNearTurn_rad) {
    explained_[kScalarLast] += turn(scalar_last(X_BD.R), X_BN.R) < kNearTurn_rad ? 1 : 0;
    explained_[kInverse] += turn(X_BD.R.transpose(), X_BN.R) < kNearTurn_rad ? 1 : 0;
  }
  std::vector<double> degrees(seed.begin(), seed.end());
  bool all_turn = !placed;
  for (std::size_t j = 0; j < degrees.size(); ++j) {
    if (!chain.revolute(static_cast<int>(j))) continue;
    all_turn = all_turn && std::abs(show::to_deg(degrees[j])) < 7.0;
    degrees[j] = show::to_deg(degrees[j]);
  }
  explained_[kRadians] +=
      all_turn && (chain.forward(degrees).p - X_BD.p).norm() < kNearPosition * reach_m_ ? 1 : 0;
}

std::string Refusals::phrase(Status status, std::size_t rows) const {
  const bool one = rows == 1;
  switch (status) {
    case Status::kFarFromSeed:
      return fmt::format("{} {} farther than {:.2g} rad from {} seed", rows, one ? "lies" : "lie",
                         corrector_->limits().max_seed_distance, one ? "its" : "their");
    case Status::kNearSingular:
      return fmt::format("{} {} near a singular pose", rows, one ? "lies" : "lie");
    case Status::kOtherConfiguration:
      return fmt::format("{} would need another configuration of the arm than {} seed", rows,
                         one ? "its" : "their");
    case Status::kNotConverged:
      return fmt::format("{} could not be reached to 1 um and 1 urad", rows);
    case Status::kNotFinite:
      return fmt::format("{} {} no pose or joint state that the arm can have", rows,
                         one ? "is" : "are");
    default:
      return fmt::format("{} {}", rows, to_string(status));
  }
}

std::string Refusals::words() const {
  std::vector<std::pair<Status, std::size_t>> order(by_status_.begin(), by_status_.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> out;
  for (const auto& [status, rows] : order) {
    out.push_back(phrase(status, rows));
    if (status != Status::kNearSingular) continue;
    out.back() += cancelling(by_joints_, rows);
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

Status Refusals::commonest() const {
  const auto most =
      std::max_element(by_status_.begin(), by_status_.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == by_status_.end() ? Status::kOk : most->first;
}

void Refusals::name_columns(const Table& targets) {
  if (const Column* x = targets.find("x"); x != nullptr && unit_of(x->unit)) {
    position_ = x->header;
    position_unit_m_ = unit_of(x->unit)->to_si(1.0);
  }
  for (const char* name : {"q1", "qc1"})
    if (const Column* q = targets.find(name); q != nullptr) joint_ = q->header;
}

/// Says that the targets lie at their seeds if their coordinates are multiplied by the factor.
std::string Refusals::wrong_unit(double factor) const {
  static constexpr std::array<std::pair<const char*, double>, 4> kUnits{
      {{"micrometres", 1e-6}, {"millimetres", 1e-3}, {"inches", 25.4e-3}, {"metres", 1.0}}};
  std::string meant = "another unit";
  for (const auto& [name, metres] : kUnits)
    if (std::abs(metres / (position_unit_m_ * factor) - 1.0) < 1e-6) meant = name;
  const std::string seen = farthest_m_ < 5e-3 * reach_m_
                               ? fmt::format("no target is farther than {:.2g} mm from the base",
                                             show::to_mm(farthest_m_))
                               : fmt::format("times {:.5g} they lie at their seeds", factor);
  return fmt::format("{}: {} in {}?", seen, meant, position_);
}

std::string Refusals::likely_mistake() const {
  const auto nearly_all = [&](std::size_t count) {
    return static_cast<double>(count) >= kNearlyAll * static_cast<double>(rows_);
  };
  if (rows_ == 0) return "";
  // A very small factor moves all targets into the base, which may be near their seeds. So only
  // factors above 1 count for targets that are in the base already.
  const bool tiny = farthest_m_ < 5e-3 * reach_m_;
  for (std::size_t k = 0; k < kFactors.size(); ++k)
    if (tiny ? kFactors[k] > 1.0 && nearly_all(scaled_[k]) : nearly_all(scaled_[k]))
      return wrong_unit(kFactors[k]);
  if (tiny) return wrong_unit(1e3);
  if (nearly_all(explained_[kRadians]))
    return fmt::format(
        "no joint of a seed is beyond 7 deg, and as radians they lie at their "
        "targets: radians in {} ...?",
        joint_);
  if (nearly_all(explained_[kScalarLast]))
    return "read as x, y, z, w the quaternions agree with the seeds: is the order qw, qx, qy, qz?";
  if (nearly_all(explained_[kInverse]))
    return "the inverse rotations agree with the seeds: is it the base seen from the tool?";
  const double n = static_cast<double>(rows_);
  const Vector3 offset = offset_sum_ / n;
  const double scatter = std::sqrt(std::max(0.0, offset_squares_ / n - offset.squaredNorm()));
  if (offset.norm() > kNoticeable_m && rows_ > 2 && scatter < kSpread * offset.norm())
    return fmt::format(
        "all of them lie about ({:.0f}, {:.0f}, {:.0f}) mm from the nominal poses of their seeds: "
        "are they in another frame than the base, or for another tool?",
        show::to_mm(offset(0)), show::to_mm(offset(1)), show::to_mm(offset(2)));
  if (nearly_all(beyond_reach_))
    return fmt::format(
        "they lie up to {:.2f} m from the base, and the arm reaches {:.2f} m: "
        "another frame or unit?",
        farthest_m_, reach_m_ + corrector_->nominal().constant(0).p.norm());
  return "";
}

}  // namespace plumb::offline::cli
