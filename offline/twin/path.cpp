// SPDX-License-Identifier: Apache-2.0
#include "twin/path.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/targets.hpp"
#include "simulate/random.hpp"

namespace plumb::offline::twin {
namespace {

constexpr int kDrawnPerStation = 4;    // candidates, so that the next one is near and reachable
constexpr int kTriesPerStation = 200;  // random poses, most of which are refused
constexpr int kBetween = 8;            // poses that are checked on the way
/// Least dexterity (NominalArm::dexterity) at a station and on the way. Chosen: above the default
/// of GuardLimits::min_singular_value, 0.02, below which a correction of the pose is refused.
constexpr double kAtStation = 0.06, kOnTheWay = 0.04;
constexpr double kPeak = 1.875;      // ratio of the highest speed of a Move to its mean speed
constexpr double kNearby = 0.25;     // share of the range of a joint
constexpr double kShortest_s = 0.1;  // of a move
constexpr int kParts = 32;           // parts of a move in which the speed of the tool is checked

bool well_between(const NominalArm& arm, const VectorXd& a, const VectorXd& b, int configuration) {
  for (int k = 1; k < kBetween; ++k) {
    const VectorXd q = a + (b - a) * k / kBetween;
    if (arm.configuration(q) != configuration || arm.dexterity(q) < kOnTheWay) return false;
  }
  return true;
}

/// Random joint positions of one configuration, in the order in which they were drawn.
std::vector<VectorXd> drawn(const Cell& cell, const NominalArm& arm, int count, double range,
                            std::uint64_t seed) {
  sim::Random random(seed, "path");
  std::vector<VectorXd> out;
  int configuration = 0;
  for (int k = 0; k < count * kTriesPerStation && static_cast<int>(out.size()) < count; ++k) {
    VectorXd q(cell.joints());
    for (int j = 0; j < cell.joints(); ++j) {
      const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
      const double share = 0.5 + range * (random.uniform() - 0.5);
      q(j) = row.q_min + share * (row.q_max - row.q_min);
    }
    if (arm.dexterity(q) < kAtStation) continue;
    if (out.empty()) configuration = arm.configuration(q);
    if (arm.configuration(q) == configuration) out.push_back(q);
  }
  return out;
}

/// The nearest of the unused joint positions that can be reached on a straight way; -1 if there is
/// none.
int next(const NominalArm& arm, const VectorXd& here, const std::vector<VectorXd>& all,
         const std::vector<bool>& used) {
  std::vector<std::pair<double, int>> order;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (!used[k]) order.emplace_back((all[k] - here).cwiseAbs().maxCoeff(), static_cast<int>(k));
  std::sort(order.begin(), order.end());
  const int configuration = arm.configuration(here);
  for (const auto& [away, k] : order)
    if (well_between(arm, here, all[static_cast<std::size_t>(k)], configuration)) return k;
  return -1;
}

/// A random joint position nearby, for when the straight ways to all unused ones are blocked; empty
/// if none is found.
VectorXd nearby(const Cell& cell, const NominalArm& arm, const VectorXd& here, double range,
                sim::Random& random) {
  const int configuration = arm.configuration(here);
  for (int k = 0; k < kTriesPerStation; ++k) {
    VectorXd q = here;
    for (int j = 0; j < cell.joints(); ++j) {
      const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
      const double span = range * (row.q_max - row.q_min);
      const double middle = 0.5 * (row.q_min + row.q_max);
      q(j) +=
          span * kNearby * random.uniform(-1.0, 1.0) * (kTriesPerStation - k) / kTriesPerStation;
      q(j) = std::clamp(q(j), middle - 0.5 * span, middle + 0.5 * span);
    }
    if (arm.dexterity(q) < kAtStation || arm.configuration(q) != configuration) continue;
    if (q != here && well_between(arm, here, q, configuration)) return q;
  }
  return {};
}

}  // namespace

Path generated_path(const Cell& cell, int stations, double range, std::uint64_t seed) {
  const NominalArm arm(cell.nominal);
  const auto all = drawn(cell, arm, stations * kDrawnPerStation, range, seed);
  std::vector<bool> used(all.size(), false);
  Path out{RowsN(stations, cell.joints())};
  sim::Random random(seed, "path nearby");
  int found = 0;
  VectorXd here = all.empty() ? VectorXd() : all.front();
  if (!all.empty()) used.front() = true;
  while (here.size() > 0) {
    out.q.row(found++) = here.transpose();
    if (found == stations) break;
    const int at = next(arm, here, all, used);
    if (at >= 0) used[static_cast<std::size_t>(at)] = true;
    here = at >= 0 ? all[static_cast<std::size_t>(at)] : nearby(cell, arm, here, range, random);
  }
  if (found < stations)
    throw Failure(Exit::kNumbersSayNo,
                  {.code = "E-TWIN-PATH",
                   .message = fmt::format("only {} of {} stations lie away from singular poses",
                                          found, stations),
                   .help = "ask for fewer with --stations, or give a path with --path"});
  return out;
}

Path path_from(const Cell& cell, const std::filesystem::path& file) {
  const Targets targets = read_targets(file, cell.nominal);
  const auto refuse = [&](int row, const std::string& message, const std::string& help) {
    throw Failure(Exit::kInput,
                  {.code = "E-TWIN-PATH",
                   .message = message,
                   .place = Place{.file = targets.table.file,
                                  .line = targets.table.lines[static_cast<std::size_t>(row)]},
                   .help = help});
  };
  if (targets.seed.rows() == 0)
    refuse(0, "the targets have no joints to be reached from", "add columns q1_deg ...");
  const NominalArm arm(cell.nominal);
  Path out{targets.seed};
  for (int row = 0; row < out.stations(); ++row) {
    VectorXd q = out.q.row(row).transpose();
    Isometry3d X_BT = arm.forward(q);
    X_BT.translation() = targets.p_B.row(row).transpose();
    if (targets.quat_B.rows() > 0) {
      const auto e = targets.quat_B.row(row);
      X_BT.linear() = Eigen::Quaterniond(e(0), e(1), e(2), e(3)).normalized().toRotationMatrix();
    }
    if (!arm.inverse(X_BT, q))
      refuse(row, "the nominal arm does not reach this target from its joints",
             "state the joints q1_deg ... that belong to the target");
    out.q.row(row) = q.transpose();
  }
  return out;
}

Move::Move(const NominalArm& arm, VectorXd from, VectorXd to, const SpeedLimits& limits)
    : from_(std::move(from)), to_(std::move(to)), duration_s_(kShortest_s) {
  duration_s_ =
      std::max(duration_s_, kPeak * (to_ - from_).cwiseAbs().maxCoeff() / limits.joint_rad_per_s);
  const double part_s = duration_s_ / kParts;
  double excess = 1.0;
  Isometry3d before = arm.forward(from_);
  for (int k = 1; k <= kParts; ++k) {
    const Isometry3d now = arm.forward(at(k * part_s));
    const double way_m = (now.translation() - before.translation()).norm();
    const double turn = Eigen::AngleAxisd(now.linear() * before.linear().transpose()).angle();
    excess = std::max(
        {excess, way_m / part_s / limits.tool_m_per_s, turn / part_s / limits.tool_rad_per_s});
    before = now;
  }
  duration_s_ *= excess;
}

VectorXd Move::at(double time_s) const {
  const double s = std::clamp(time_s / duration_s_, 0.0, 1.0);
  return from_ + (to_ - from_) * (s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));
}

}  // namespace plumb::offline::twin
