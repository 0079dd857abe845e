// SPDX-License-Identifier: Apache-2.0
#include "recheck/turned.hpp"

#include <cmath>
#include <utility>

#include "arm/predicted_points.hpp"
#include "noise/orientation_floor.hpp"
#include "numbers/tails.hpp"
#include "recheck/constants.hpp"

namespace plumb::offline::recheck {
namespace {

std::vector<double> angles(const Rows3& turns) {
  const Eigen::VectorXd sizes = turns.rowwise().norm();
  return {sizes.begin(), sizes.end()};
}

std::vector<double> held_out_angles(const Fit& fit) {
  std::vector<double> out;
  for (const int row : held_rows(fit.split)) out.push_back(fit.turned_G.row(row).norm());
  if (!out.empty()) return out;
  for (const int row : fit_rows(fit.split)) out.push_back(fit.turned_G.row(row).norm());
  return out;
}

/// ln of the chance that angles scatter so much more than usual.
double ln_chance(const Rows3& turns, double usual_rad, int poses) {
  const double times = sigma_of_angles(angles(turns)) / usual_rad;
  return ln_f_tail(times * times, static_cast<double>(poses), kTrusted);
}

}  // namespace

bool TurnCheck::turned() const { return judged() && ln_p < std::log(kTooMuch); }

TurnCheck check_turns(const Run& calibrated, const ArmState& state, const Measurements& rows,
                      int poses, bool placed) {
  TurnCheck out;
  if (calibrated.fit.turned_G.size() == 0 || !rows.has_orientation()) return out;
  std::vector<double> then = held_out_angles(calibrated.fit);
  const double usual_rad = sigma_of_angles(then);
  const Rows3 off_T = turns_of_target(state, rows);
  const Eigen::RowVector3d constant = off_T.colwise().mean();
  const Rows3 rest = off_T.rowwise() - constant;
  if (poses < kFewestForOddOnes || !(usual_rad > 0.0)) return out;
  out.then = summarise(std::move(then));
  out.now = summarise(angles(placed ? rest : off_T));
  out.ln_p = ln_chance(placed ? rest : off_T, usual_rad, poses);
  out.constant_rad = constant.norm();
  out.is_constant =
      !placed && out.turned() && ln_chance(rest, usual_rad, poses) > std::log(kTooMuch);
  return out;
}

}  // namespace plumb::offline::recheck
