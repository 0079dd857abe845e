// SPDX-License-Identifier: Apache-2.0
#include "cli/corrected.hpp"

#include <algorithm>

namespace plumb::offline::cli {
namespace {

/// The joint state from which each row is solved: its own, else the last solution.
class Seeds {
 public:
  Seeds(const Targets& targets, std::vector<double> start)
      : targets_(targets), last_(std::move(start)) {}

  std::vector<double> at(int row) const {
    if (targets_.seed.rows() == 0) return last_;
    const auto q = targets_.seed.row(row);
    return {q.data(), q.data() + q.size()};
  }
  SeedKind kind() const {
    if (targets_.seed.rows() == 0) return SeedKind::kLastSolution;
    return targets_.commanded ? SeedKind::kCommanded : SeedKind::kMeasured;
  }
  void solved(const Correction& correction) {
    if (!refused(correction.status)) std::copy_n(correction.q.begin(), last_.size(), last_.begin());
  }

 private:
  const Targets& targets_;
  std::vector<double> last_;
};

/// Without a quaternion the nominal orientation at the seed is meant.
Transformd target_pose(const Targets& targets, int row, const Chain& nominal,
                       std::span<const double> seed) {
  const auto p = targets.p_B.row(row);
  if (targets.quat_B.rows() > 0) {
    const auto q = targets.quat_B.row(row);
    return from_pose({{p(0), p(1), p(2)}, {q(0), q(1), q(2), q(3)}});
  }
  Transformd X_BD = nominal.forward(seed);
  X_BD.p = p.transpose();
  return X_BD;
}

}  // namespace

Corrected correct_targets(const Corrector& corrector, const Targets& targets,
                          const std::vector<double>& start,
                          const std::vector<std::string>& sensors) {
  Seeds seeds(targets, start);
  Corrected out;
  for (int row = 0; row < targets.table.rows(); ++row) {
    const auto seed = seeds.at(row);
    const Transformd X_BD = target_pose(targets, row, corrector.nominal(), seed);
    const Correction correction =
        corrector.solve(X_BD, seed, seeds.kind(), context_at(targets.context, row, sensors));
    seeds.solved(correction);
    out.command.push_back(to_pose(correction.X_BC));
    out.status.push_back(correction.status);
    if (refused(correction.status)) continue;
    const Matrix3 turn = correction.X_BC.R * X_BD.R.transpose();
    out.largest_m = std::max(out.largest_m, (correction.X_BC.p - X_BD.p).norm());
    out.largest_rad = std::max(out.largest_rad, rotation_vector(turn).norm());
  }
  return out;
}

}  // namespace plumb::offline::cli
