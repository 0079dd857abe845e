// SPDX-License-Identifier: Apache-2.0
#include "diagnose/held_out_predictions.hpp"

#include <algorithm>
#include <utility>

#include "arm/predicted_points.hpp"
#include "fit/unseen_points.hpp"
#include "noise/usual_errors.hpp"

namespace plumb::offline {

HeldOutPredictions::HeldOutPredictions(const MeasurementSettings& settings,
                                       const Measurements& measured, const Split& split)
    : settings_(&settings),
      measured_(&measured),
      rows_(held_rows(split)),
      predicted_(measured.p_M) {
  if (measured.has_orientation()) turns_rad_ = Eigen::VectorXd::Zero(measured.size());
}

void HeldOutPredictions::put(const Calibration& calibration, const std::vector<int>& fitted,
                             const std::vector<int>& held) {
  const Rows3 points = predict_held_out(*settings_, *measured_, fitted, held, calibration.state);
  if (turns_rad_.size() > 0)
    turns_rad_(held) = turn_errors(calibration.state, pick(*measured_, held));
  for (std::size_t i = 0; i < held.size(); ++i)
    predicted_.row(held[i]) = points.row(static_cast<Eigen::Index>(i));
}

std::vector<double> HeldOutPredictions::errors_m() const {
  const Rows3 error = residuals(*measured_, predicted_);
  std::vector<double> norms;
  for (int row : rows_) norms.push_back(error.row(row).norm());
  return norms;
}

std::set<int> HeldOutPredictions::bad_rows(double sigma_m) const {
  const auto far = far_rows(errors_m(), sigma_m);
  return are_single(far.size(), rows_.size()) ? far : std::set<int>();
}

ErrorStats HeldOutPredictions::stats(const BadRows& bad) const {
  std::vector<double> all = errors_m(), usual;
  const auto far = far_rows(all, bad.sigma_m);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (!bad.rows.contains(rows_[i]) || !far.contains(rows_[i])) usual.push_back(all[i]);
  return summarise(std::move(usual));
}

ErrorStats HeldOutPredictions::turn_stats() const {
  if (turns_rad_.size() == 0) return {};
  const Eigen::VectorXd held = turns_rad_(rows_);
  return summarise({held.begin(), held.end()});
}

std::set<int> HeldOutPredictions::far_rows(const std::vector<double>& errors_m,
                                           double sigma_m) const {
  std::set<int> out;
  for (const std::size_t i : standing_out(errors_m, measured_->usual_axes(), sigma_m).which)
    out.insert(rows_[i]);
  return out;
}

}  // namespace plumb::offline
