// SPDX-License-Identifier: Apache-2.0
#include "solve/weak_direction_search.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/spectrum.hpp"
#include "numbers/triangle.hpp"
#include "solve/constants.hpp"
#include "solve/scaled_jacobian.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// 1 sigma of the prior of a number about its nominal value [SI]; 0 if it has none, or if it has a
/// prior of its own.
double prior_of(const Parameter& p, const FitData& data) {
  const FitSettings& settings = data.cell->fit;
  if (!p.of_robot() || p.of_effect()) return 0.0;
  for (const auto& own : settings.priors)
    if (own.name == p.name) return 0.0;
  for (const auto& earlier : data.arm.names)
    if (earlier == p.name) return 0.0;
  return p.is_length() ? settings.prior_m : settings.prior_rad;
}

/// The lower right block of R in J = Q R: the columns of J from `first` on without the part that
/// the columns before explain, up to an orthogonal factor.
Eigen::MatrixXd less_the_first(const Eigen::MatrixXd& J, Eigen::Index first) {
  const Eigen::VectorXd scale = per_norm(J);
  const Eigen::MatrixXd scaled = J * scale.asDiagonal();
  const Eigen::Index rows = std::min(J.rows(), J.cols());
  const Eigen::MatrixXd R = householder_triangle(scaled);
  const Eigen::Index last = J.cols() - first;
  return R.bottomRightCorner(std::max<Eigen::Index>(0, rows - first), last) *
         scale.tail(last).cwiseInverse().asDiagonal();
}

/// The numbers of the arm that have the prior of the cell, and its 1 sigma for each.
struct HeldNumbers {
  std::vector<Parameter> parameters, others;
  std::vector<double> sigma;
};
HeldNumbers held_numbers(const FitData& data, const std::vector<Parameter>& parameters) {
  HeldNumbers out;
  if (data.cell == nullptr) return out;
  for (const auto& p : parameters) {
    const double sigma = prior_of(p, data);
    (sigma > 0.0 ? out.parameters : out.others).push_back(p);
    if (sigma > 0.0) out.sigma.push_back(sigma);
  }
  return out;
}

Eigen::VectorXd as_vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

}  // namespace

WeakDirections weak_directions(const FitData& data, const ArmState& state,
                               const std::vector<Parameter>& parameters) {
  WeakDirections out;
  HeldNumbers held = held_numbers(data, parameters);
  if (held.parameters.empty()) return out;
  std::vector<Parameter> order = std::move(held.others);
  const auto first = static_cast<Eigen::Index>(order.size());
  out.parameters = std::move(held.parameters);
  order.insert(order.end(), out.parameters.begin(), out.parameters.end());
  FitData thin = data;
  thin.weak = {};
  thin.rows = thinned(data, kRankRows);
  const Eigen::VectorXd sigma = as_vector(held.sigma);
  const Eigen::MatrixXd shown =
      less_the_first(jacobian_for_all(data, thin, state, order), first) * sigma.asDiagonal();
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(sigma.size(), sigma.size());
  square.topRows(std::min(shown.rows(), square.rows())) =
      shown.topRows(std::min(shown.rows(), square.rows()));
  const auto [s, every] = right_singular(square);
  const auto strong = static_cast<Eigen::Index>((s.array() >= kWeakBelow).count());
  const Eigen::MatrixXd V = every.rightCols(sigma.size() - strong);
  out.weights = V.transpose() * sigma.cwiseInverse().asDiagonal();
  out.share = V.rowwise().squaredNorm();
  return out;
}

WeakDirections all_directions(const FitData& data, const ArmState& state,
                              const std::vector<Parameter>& parameters) {
  WeakDirections out = weak_directions(data, state, parameters);
  if (!out.parameters.empty())
    out.weights = as_vector(held_numbers(data, parameters).sigma).cwiseInverse().asDiagonal();
  return out;
}

}  // namespace plumb::offline
