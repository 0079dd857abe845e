// SPDX-License-Identifier: Apache-2.0
#include "solve/prior_lines.hpp"

#include <algorithm>
#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "effects/registry.hpp"
#include "numbers/cholesky.hpp"
#include "solve/many_rows.hpp"

namespace plumb::offline {
namespace {

bool has_own_prior(const Parameter& p, const FitData& data) {
  const auto& priors = data.cell->fit.priors;
  const auto& earlier = data.arm.names;
  return std::any_of(priors.begin(), priors.end(),
                     [&](const Prior& prior) { return prior.name == p.name; }) ||
         std::find(earlier.begin(), earlier.end(), p.name) != earlier.end();
}

}  // namespace

/// What a distance of u sigma from the mean adds to the residuals, and its slope. Heavy: Huber's,
///
///   u^2 / 2 up to one sigma, |u| - 1/2 beyond
///
/// so that what is hardly seen stays small, what the poses clearly show may be as large as it is,
/// and there is one best fit.
struct PriorLines::Pull {
  double residual, slope;
};
PriorLines::Pull PriorLines::pull_of(double u, KnownParameter::Tail tail) {
  if (tail == KnownParameter::Tail::kNormal || std::abs(u) <= 1.0) return {u, 1.0};
  const double length = std::sqrt(2.0 * std::abs(u) - 1.0);
  return {std::copysign(length, u), 1.0 / length};
}

/// What the cell says, and of effects: that they are rarely many times their typical size. Without
/// it, what geometry nearly imitates (the scale of a tracker) would run away.
std::vector<PriorLines::KnownParameter> PriorLines::known(
    const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters) {
  std::vector<KnownParameter> out;
  if (data.cell == nullptr) return out;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].of_effect() || has_own_prior(parameters[i], data)) continue;
    const auto& [joint, component] = std::pair(parameters[i].joint, parameters[i].component);
    const double typical = effect_parameter(start.arm, joint, component).typical;
    const format::Effect& effect = start.arm.effects[joint];
    const EffectDescriptor& law = descriptor_of(effect.name);
    const double width = law.prior_width;
    const auto tail = law.prior_tail == PriorTail::kNormal ? KnownParameter::Tail::kNormal
                                                           : KnownParameter::Tail::kHeavy;
    const double mean =
        effect.formula.code.empty() ? 0.0 : effect.formula.parameters[component].start;
    if (typical > 0.0) out.push_back({static_cast<Eigen::Index>(i), mean, width * typical, tail});
  }
  ArmState nominal;
  nominal.arm.calibrated = data.cell->nominal;
  for (const auto& prior : data.cell->fit.priors)
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (parameters[i].name != prior.name) continue;
      const double nominal_value =
          parameters[i].of_effect() ? 0.0 : value_of(nominal, parameters[i]);
      using Tail = KnownParameter::Tail;
      using Source = KnownParameter::Source;
      out.push_back({static_cast<Eigen::Index>(i), nominal_value + prior.mean, prior.sigma,
                     prior.of_fleet ? Tail::kHeavy : Tail::kNormal,
                     prior.of_fleet ? Source::kFleet : Source::kCell});
    }
  return out;
}

PriorLines::EarlierNumbers PriorLines::earlier_numbers(const FitData& data,
                                                       const std::vector<Parameter>& parameters) {
  EarlierNumbers out;
  std::vector<Eigen::Index> of_earlier;
  for (std::size_t k = 0; k < data.arm.names.size(); ++k) {
    const auto at = std::find_if(parameters.begin(), parameters.end(),
                                 [&](const Parameter& p) { return p.name == data.arm.names[k]; });
    if (at == parameters.end()) continue;
    out.index.push_back(at - parameters.begin());
    of_earlier.push_back(static_cast<Eigen::Index>(k));
  }
  if (of_earlier.empty()) return out;
  out.mean = data.arm.mean(of_earlier);
  const Eigen::MatrixXd covariance = data.arm.covariance(of_earlier, of_earlier);
  // Metres and radians differ by orders of magnitude from stiffnesses: factored in own units.
  const Eigen::VectorXd sigma = covariance.diagonal().cwiseSqrt();
  const Eigen::MatrixXd correlation =
      sigma.cwiseInverse().asDiagonal() * covariance * sigma.cwiseInverse().asDiagonal();
  out.whitening =
      Cholesky(correlation).whitened(Eigen::MatrixXd(sigma.cwiseInverse().asDiagonal()));
  return out;
}

PriorLines::WeakColumns PriorLines::weak_columns(const FitData& data,
                                                 const std::vector<Parameter>& parameters) {
  WeakColumns out;
  if (data.cell == nullptr || data.weak.weights.rows() == 0) return out;
  ArmState nominal;
  nominal.arm.calibrated = data.cell->nominal;
  const auto& all = data.weak.parameters;
  out.nominal.resize(static_cast<Eigen::Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto at = std::find_if(parameters.begin(), parameters.end(),
                                 [&](const Parameter& p) { return p.name == all[k].name; });
    if (at == parameters.end()) return {};
    out.index.push_back(at - parameters.begin());
    out.nominal(static_cast<Eigen::Index>(k)) = value_of(nominal, *at);
  }
  return out;
}

std::vector<PriorLines::KnownDistance> PriorLines::distances(
    const FitData& data, const std::vector<Parameter>& parameters) {
  std::vector<KnownDistance> out;
  if (data.cell == nullptr) return out;
  const auto first_of = [&](int setup) {
    const auto at = std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) {
      return p.kind == Parameter::Kind::kPoint && p.setup == setup && p.component == 0;
    });
    // All three are fitted only where z of the same point is two behind x.
    const bool all = parameters.end() - at >= 3 && (at + 2)->kind == Parameter::Kind::kPoint &&
                     (at + 2)->setup == setup;
    return all ? at - parameters.begin() : Eigen::Index{-1};
  };
  for (const KnownLength& length : data.cell->measurement.lengths) {
    const Eigen::Index from = first_of(length.from), to = first_of(length.to);
    if (from >= 0 && to >= 0)
      out.push_back({length, from, to, data.cell->measurement.sigma_length_m});
  }
  return out;
}

PriorLines::PriorLines(const FitData& data, const ArmState& start,
                       const std::vector<Parameter>& parameters)
    : data_(data),
      parameters_(parameters),
      known_(known(data, start, parameters)),
      earlier_(earlier_numbers(data, parameters)),
      distances_(distances(data, parameters)),
      weak_(weak_columns(data, parameters)) {}

int PriorLines::count() const {
  const auto directions = weak_.index.empty() ? 0 : data_.weak.weights.rows();
  return static_cast<int>(known_.size() + earlier_.index.size() + distances_.size()) +
         static_cast<int>(directions);
}

PriorLines::Pull PriorLines::pull_of(const KnownParameter& known, const ArmState& state) const {
  const double value = value_of(state, parameters_[static_cast<std::size_t>(known.index)]);
  return pull_of((known.mean - value) / known.sigma, known.tail);
}

double PriorLines::distance_from_sisters(const ArmState& state) const {
  double sum = 0.0;
  int count = 0;
  for (const auto& known : known_) {
    if (known.source != KnownParameter::Source::kFleet) continue;
    sum += std::pow(pull_of(known, state).residual, 2);
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

/// An arm of another batch is far from its sisters in many numbers at once. Then all that they
/// taught weighs less: with s the sum of the squares of the n residuals r, what they add to the
/// cost is half of
///
///   s where s <= n,   n (1 + ln(s / n)) beyond
///
/// by residuals g r with g^2 = n (1 + ln(s / n)) / s.
void PriorLines::doubt_sisters(double* residual, double* jacobian) const {
  std::vector<Eigen::Index> rows;
  double s = 0.0;
  for (std::size_t k = 0; k < known_.size(); ++k) {
    if (known_[k].source != KnownParameter::Source::kFleet) continue;
    rows.push_back(static_cast<Eigen::Index>(k));
    s += residual[k] * residual[k];
  }
  const auto n = static_cast<double>(rows.size());
  if (s <= n) return;
  const double cost = n * (1.0 + std::log(s / n)), g = std::sqrt(cost / s);
  if (jacobian != nullptr) {
    const auto count = static_cast<Eigen::Index>(parameters_.size());
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J(
        jacobian, static_cast<Eigen::Index>(known_.size()), count);
    Eigen::RowVectorXd of_s = Eigen::RowVectorXd::Zero(count);  // derivative of s
    for (const auto row : rows) of_s += 2.0 * residual[row] * J.row(row);
    const Eigen::RowVectorXd of_g = (n / s - cost / s) / (2.0 * g * s) * of_s;
    for (const auto row : rows) J.row(row) = g * J.row(row) + residual[row] * of_g;
  }
  for (const auto row : rows) residual[row] *= g;
}

void PriorLines::evaluate(const ArmState& state, double* residual, double* jacobian) const {
  const auto count = static_cast<Eigen::Index>(parameters_.size());
  Eigen::Index row = 0;
  for (const auto& known : known_) {
    const Pull pull = pull_of(known, state);
    residual[row] = pull.residual;
    if (jacobian != nullptr) {
      Eigen::Map<Eigen::RowVectorXd> slopes(jacobian + row * count, count);
      slopes.setZero();
      slopes(known.index) = -pull.slope / known.sigma;
    }
    ++row;
  }
  doubt_sisters(residual, jacobian);
  const auto next = [&](Eigen::Index lines) {
    residual += lines;
    if (jacobian != nullptr) jacobian += lines * count;
  };
  next(row);
  add_earlier(state, residual, jacobian);
  next(static_cast<Eigen::Index>(earlier_.index.size()));
  add_distances(state, residual, jacobian);
  next(static_cast<Eigen::Index>(distances_.size()));
  add_weak(state, residual, jacobian);
}

void PriorLines::add_earlier(const ArmState& state, double* residual, double* jacobian) const {
  const auto size = static_cast<Eigen::Index>(earlier_.index.size());
  if (size == 0) return;
  Eigen::VectorXd away = earlier_.mean;
  for (Eigen::Index k = 0; k < size; ++k)
    away(k) -= value_of(
        state, parameters_[static_cast<std::size_t>(earlier_.index[static_cast<std::size_t>(k)])]);
  Eigen::Map<Eigen::VectorXd>(residual, size) = earlier_.whitening * away;
  if (jacobian == nullptr) return;
  const auto count = static_cast<Eigen::Index>(parameters_.size());
  Eigen::Map<RowMajorMatrix> J(jacobian, size, count);
  J.setZero();
  for (Eigen::Index k = 0; k < size; ++k)
    J.col(earlier_.index[static_cast<std::size_t>(k)]) = -earlier_.whitening.col(k);
}

void PriorLines::add_distances(const ArmState& state, double* residual, double* jacobian) const {
  const auto count = static_cast<Eigen::Index>(parameters_.size());
  for (std::size_t k = 0; k < distances_.size(); ++k) {
    const KnownDistance& known = distances_[k];
    const Vector3 apart =
        from_pose(state.frame(known.length.to)).p - from_pose(state.frame(known.length.from)).p;
    residual[k] = (known.length.length_m - apart.norm()) / known.sigma_m;
    if (jacobian == nullptr) continue;
    Eigen::Map<Eigen::RowVectorXd> slopes(jacobian + static_cast<Eigen::Index>(k) * count, count);
    slopes.setZero();
    if (apart.norm() == 0.0) continue;
    const Eigen::RowVector3d along = apart.transpose() / (apart.norm() * known.sigma_m);
    // The frame of a point is shifted by what the point is away from the base, the other way.
    slopes.segment<3>(known.from) = -along;
    slopes.segment<3>(known.to) = along;
  }
}

void PriorLines::add_weak(const ArmState& state, double* residual, double* jacobian) const {
  if (weak_.index.empty()) return;
  Eigen::VectorXd away = weak_.nominal;
  for (std::size_t k = 0; k < weak_.index.size(); ++k)
    away(static_cast<Eigen::Index>(k)) -=
        value_of(state, parameters_[static_cast<std::size_t>(weak_.index[k])]);
  const Eigen::VectorXd distance = data_.weak.weights * away;
  const auto count = static_cast<Eigen::Index>(parameters_.size());
  for (Eigen::Index d = 0; d < distance.size(); ++d) {
    const Pull pull = pull_of(distance(d), KnownParameter::Tail::kHeavy);
    residual[d] = pull.residual;
    if (jacobian == nullptr) continue;
    Eigen::Map<Eigen::RowVectorXd> slopes(jacobian + d * count, count);
    slopes.setZero();
    for (std::size_t k = 0; k < weak_.index.size(); ++k)
      slopes(weak_.index[k]) = -pull.slope * data_.weak.weights(d, static_cast<Eigen::Index>(k));
  }
}

}  // namespace plumb::offline
