// SPDX-License-Identifier: Apache-2.0
#include "solve/weak_direction_search.hpp"

#include <algorithm>
#include <cmath>

#include "arm/arm_change.hpp"
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

std::vector<bool> are_lengths(const std::vector<Parameter>& parameters) {
  std::vector<bool> out;
  for (const auto& p : parameters) out.push_back(p.is_length());
  return out;
}

/// Differences of the arm's numbers from nominal, in units of the prior.
Eigen::VectorXd differences(const FitData& data, const ArmState& state, const HeldNumbers& held) {
  ArmState nominal;
  nominal.arm.calibrated = data.cell->nominal;
  Eigen::VectorXd out(static_cast<Eigen::Index>(held.sigma.size()));
  for (std::size_t i = 0; i < held.sigma.size(); ++i)
    out(static_cast<Eigen::Index>(i)) =
        (value_of(state, held.parameters[i]) - value_of(nominal, held.parameters[i])) /
        held.sigma[i];
  return out;
}

/// The directions that the poses tell, in units of the prior: differences along them, with 1 sigma
/// of the readings, and the share of each number in them, shape (directions, numbers).
struct Told {
  Eigen::VectorXd differences, sigma;
  Eigen::MatrixXd share;
  std::vector<bool> is_length;
};

/// ln of the density of what is told if arms were built so many times farther from nominal than the
/// prior says. Each direction has a Student density, so that one number that is far off says little
/// of all others.
double ln_density(const Told& told, const BuiltTimes& times) {
  Eigen::VectorXd variance(told.share.cols());
  for (Eigen::Index i = 0; i < variance.size(); ++i) {
    const double t = told.is_length[static_cast<std::size_t>(i)] ? times.lengths : times.angles;
    variance(i) = t * t;
  }
  const Eigen::ArrayXd all = (told.share * variance).array() + told.sigma.array().square();
  const Eigen::ArrayXd squares = told.differences.array().square() / all;
  return -0.5 * (all.log() + (kBuiltDof + 1.0) * (1.0 + squares / kBuiltDof).log()).sum();
}

/// How many times farther from nominal than the prior says this arm is built, by what the poses
/// clearly tell of it. Not where the cell states another prior than the usual one.
BuiltTimes built_times(const Told& told, const FitSettings& settings) {
  const FitSettings usual;
  if (settings.prior_m != usual.prior_m || settings.prior_rad != usual.prior_rad) return {};
  const double as_stated = ln_density(told, {});
  BuiltTimes out;
  double best = as_stated + kBuiltAhead_nats;
  for (const double lengths : kBuiltTimes)
    for (const double angles : kBuiltTimes)
      if (const double here = ln_density(told, {lengths, angles}); here > best) {
        best = here;
        out = {lengths, angles};
      }
  return out;
}

}  // namespace

WeakDirections weak_directions(const FitData& data, const ArmState& state,
                               const std::vector<Parameter>& parameters) {
  WeakDirections out;
  HeldNumbers held = held_numbers(data, parameters);
  if (held.parameters.empty()) return out;
  std::vector<Parameter> order = std::move(held.others);
  const auto first = static_cast<Eigen::Index>(order.size());
  order.insert(order.end(), held.parameters.begin(), held.parameters.end());
  FitData thin = data;
  thin.weak = {};
  thin.rows = thinned(data, kRankRows);
  Eigen::VectorXd sigma = as_vector(held.sigma);
  const Eigen::MatrixXd shown = less_the_first(jacobian_for_all(data, thin, state, order), first);
  const auto along = [&] {
    Eigen::MatrixXd square = Eigen::MatrixXd::Zero(sigma.size(), sigma.size());
    const Eigen::Index rows = std::min(shown.rows(), square.rows());
    square.topRows(rows) = shown.topRows(rows) * sigma.asDiagonal();
    return right_singular(square);
  };
  const auto strong_of = [](const Eigen::VectorXd& s) {
    return static_cast<Eigen::Index>((s.array() >= kWeakBelow).count());
  };
  RightSingular all = along();
  Eigen::Index strong = strong_of(all.values);
  const Eigen::MatrixXd told = all.vectors.leftCols(strong).transpose();
  out.built =
      built_times({told * differences(data, state, held), all.values.head(strong).cwiseInverse(),
                   told.cwiseAbs2(), are_lengths(held.parameters)},
                  data.cell->fit);
  if (out.built.lengths > 1.0 || out.built.angles > 1.0) {
    for (Eigen::Index i = 0; i < sigma.size(); ++i)
      sigma(i) *= held.parameters[static_cast<std::size_t>(i)].is_length() ? out.built.lengths
                                                                           : out.built.angles;
    all = along();
    strong = strong_of(all.values);
  }
  const Eigen::MatrixXd V = all.vectors.rightCols(sigma.size() - strong);
  out.weights = V.transpose() * sigma.cwiseInverse().asDiagonal();
  out.share = V.rowwise().squaredNorm();
  out.parameters = std::move(held.parameters);
  return out;
}

WeakDirections all_directions(const FitData& data, const ArmState& state,
                              const std::vector<Parameter>& parameters) {
  WeakDirections out = weak_directions(data, state, parameters);
  if (out.parameters.empty()) return out;
  out.weights = as_vector(held_numbers(data, parameters).sigma).cwiseInverse().asDiagonal();
  out.built = {};
  return out;
}

}  // namespace plumb::offline
