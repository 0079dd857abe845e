// SPDX-License-Identifier: Apache-2.0
#include "urdf/followers.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace plumb::offline {
namespace {

constexpr double kOneAxis = 1e-6;  // [rad] and [m]: what rounded numbers of a file leave

/// The motions of both commute and are of one kind.
bool on_one_axis(const JointAxis& a, const JointAxis& b) {
  if (a.type != b.type || a.direction.cross(b.direction).norm() > kOneAxis) return false;
  return a.type == format::JointType::kPrismatic ||
         a.direction.cross(b.point - a.point).norm() < kOneAxis;
}

class Folding {
 public:
  Folding(const std::vector<JointAxis>& joints, const std::vector<Follower>& followers)
      : joints_(joints), followers_(followers), leads_(joints.size(), true) {
    for (const Follower& one : followers) leads_[one.joint] = false;
  }

  OwnJoints folded() {
    out_.own.resize(joints_.size());
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (!leads_[i]) continue;
      out_.own[i] = out_.axes.size();
      out_.axes.push_back(joints_[i]);
    }
    out_.scale.assign(out_.axes.size(), 1.0);
    for (const Follower& one : followers_) add(one);
    std::erase_if(out_.coupling, [](const auto& c) { return c.ratio == 0.0; });
    for (auto& [joint, by, ratio] : out_.coupling) ratio /= out_.scale[joint];
    widen_limits();
    return std::move(out_);
  }

 private:
  /// The joint with a value of its own beside which `i` moves; none: number of joints.
  std::size_t beside(std::size_t i) const {
    for (const int step : {-1, 1})
      for (std::size_t k = i + step; k < joints_.size() && on_one_axis(joints_[i], joints_[k]);
           k += step)
        if (leads_[k]) return k;
    return joints_.size();
  }

  void add(const Follower& one) {
    const std::size_t k = beside(one.joint);
    if (k == joints_.size() || joints_[k].type != joints_[one.leader].type)
      return out_.left_over.push_back(&one);
    const std::size_t row = out_.own[one.joint] = out_.own[k], by = out_.own[one.leader];
    const bool along = joints_[k].direction.dot(joints_[one.joint].direction) > 0.0;
    const double ratio = along ? one.ratio : -one.ratio;
    if (row == by) {
      out_.scale[row] += ratio;
      return;
    }
    auto& all = out_.coupling;
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const auto& c) { return c.joint == row && c.by == by; });
    if (same != all.end())
      same->ratio += ratio;
    else
      all.push_back({static_cast<std::uint8_t>(row), static_cast<std::uint8_t>(by), ratio});
  }

  void widen_limits() {
    const std::vector<JointAxis> values = out_.axes;
    for (const auto& [joint, by, ratio] : out_.coupling) {
      const auto [low, high] = std::minmax({ratio * values[by].q_min, ratio * values[by].q_max});
      out_.axes[joint].q_min += low;
      out_.axes[joint].q_max += high;
    }
  }

  const std::vector<JointAxis>& joints_;
  const std::vector<Follower>& followers_;
  std::vector<bool> leads_;
  OwnJoints out_;
};

}  // namespace

OwnJoints without_followers(const std::vector<JointAxis>& joints,
                            const std::vector<Follower>& followers) {
  return Folding(joints, followers).folded();
}

}  // namespace plumb::offline
