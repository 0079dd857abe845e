// SPDX-License-Identifier: Apache-2.0
#include "check/coverage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "arm/predicted_points.hpp"
#include "check/arm_shape.hpp"
#include "check/constants.hpp"

namespace plumb::offline {
namespace {

class JointReport {
 public:
  JointReport(const format::JointRow& row, std::vector<double> q) : row_(row), q_(std::move(q)) {
    std::sort(q_.begin(), q_.end());
  }

  JointCoverage report() const {
    JointCoverage out{.joint = row_.name,
                      .q_min = q_.front(),
                      .q_max = q_.back(),
                      .limit_min = row_.q_min,
                      .limit_max = row_.q_max};
    const double used = out.q_max - out.q_min, allowed = out.limit_max - out.limit_min;
    out.share = allowed > 0.0 ? std::min(1.0, used / allowed) : 0.0;
    for (const double q : q_) {
      const int tenth = used > 0.0 ? static_cast<int>(10.0 * (q - out.q_min) / used) : 0;
      ++out.tenths[std::min(tenth, 9)];
    }
    out.text = words(out, used);
    return out;
  }

 private:
  std::string shown(double q) const {
    const bool slides = row_.type == format::JointType::kPrismatic;
    return slides ? fmt::format("{:.0f} mm", q * 1e3)
                  : fmt::format("{:.0f} deg", q / check::kDegree_rad);
  }

  std::string words(const JointCoverage& c, double used) const {
    if (used < check::kStill) return fmt::format("never moves, it stays at {}", shown(c.q_min));
    std::size_t widest = 1;
    for (std::size_t i = 1; i < q_.size(); ++i)
      if (q_[i] - q_[i - 1] > q_[widest] - q_[widest - 1]) widest = i;
    if (q_[widest] - q_[widest - 1] > check::kGap * used)
      return fmt::format("nothing between {} and {}", shown(q_[widest - 1]), shown(q_[widest]));
    for (std::size_t k = 0; k < c.tenths.size(); ++k)
      if (c.tenths[k] > check::kCrowded * static_cast<double>(q_.size()))
        return fmt::format("crowded near {}",
                           shown(c.q_min + used * (static_cast<double>(k) + 0.5) / 10.0));
    return "spread over its range";
  }

  const format::JointRow& row_;
  std::vector<double> q_;
};

}  // namespace

Coverage coverage(const Cell& cell, const Measurements& measured, const std::vector<int>& rows,
                  const ArmState& placed) {
  Coverage out;
  out.readings = static_cast<int>(rows.size());
  std::set<int> groups;
  for (const int i : rows) groups.insert(measured.replicate_group[i]);
  out.poses = static_cast<int>(groups.size());
  for (int j = 0; j < cell.joints(); ++j) {
    std::vector<double> q;
    for (const int i : rows) q.push_back(measured.q(i, j));
    out.joints.push_back(JointReport(cell.nominal.joints[j], std::move(q)).report());
  }
  ArmState in_base = placed;
  in_base.X_MB = format::Pose{};
  const Measurements some = pick(measured, rows);
  const Rows3 points = predict_points(in_base, some.q);
  for (int k = 0; k < 3; ++k) {
    out.box_min[k] = points.col(k).minCoeff();
    out.box_max[k] = points.col(k).maxCoeff();
  }
  return out;
}

std::vector<Problem> coverage_findings(const Coverage& coverage) {
  std::vector<std::string> narrow;
  for (const auto& joint : coverage.joints)
    if (joint.share < check::kLittleOfLimits)
      narrow.push_back(fmt::format("{} ({:.0f} %)", joint.joint, 100.0 * joint.share));
  if (narrow.empty()) return {};
  return {{Severity::kWarning, "W-CHECK-COVERAGE",
           fmt::format("the poses use little of the limits of {}: predictions beyond are guesses",
                       fmt::join(narrow, ", ")),
           std::nullopt, "measure where the arm will work, or narrow q = [min, max] in cell.toml"}};
}

}  // namespace plumb::offline
