// SPDX-License-Identifier: Apache-2.0
#include "fit/likeness_judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "cell/earlier_arm.hpp"
#include "effects/fitted_laws.hpp"
#include "fit/constants.hpp"
#include "numbers/gaussian.hpp"
#include "numbers/spectrum.hpp"
#include "numbers/triangle.hpp"
#include "program/counted_words.hpp"
#include "program/file.hpp"
#include "solve/evaluation.hpp"
#include "solve/many_rows.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// Values of Hypothesis::changed that are no index of a number.
constexpr int kUnchanged = -1, kOffsets = -2;

/// A number that both arms have.
struct SharedNumber {
  Parameter parameter;
  Eigen::Index in_earlier;
  double built = 0.0;  // 1 sigma of its difference from nominal among arms, SI
};

bool of_measurement(const ArmState& at, const Parameter& p) {
  const format::Effect& effect = at.arm.effects[static_cast<std::size_t>(p.joint)];
  return is_measurement_law(find_fitted_law(effect.name));
}

double built_within(const FitData& data, const ArmState& at, const Parameter& p, double value) {
  if (p.of_effect())
    return std::hypot(effect_parameter(at.arm, p.joint, p.component).typical, value);
  const FitSettings& fit = data.cell->fit;
  const double stated = p.is_length() ? fit.prior_m : fit.prior_rad;
  return stated > 0.0 ? std::min(stated, kMostBuilt) : kUnsetPrior;
}

/// Whether the number is a constant that adds to the position of its joint.
bool is_offset(const FitData& data, const Parameter& p) {
  if (p.of_effect()) return false;
  const auto& row = data.cell->nominal.joints[static_cast<std::size_t>(p.joint)];
  return p.kind == (row.type == format::JointType::kPrismatic ? Parameter::Kind::kD
                                                              : Parameter::Kind::kTheta);
}

double nominal_of(const FitData& data, const Parameter& p) {
  if (p.of_effect()) return 0.0;
  ArmState nominal;
  nominal.arm.calibrated = data.cell->nominal;
  return value_of(nominal, p);
}

[[noreturn]] void refuse(const EarlierArm& earlier, const std::string& why) {
  throw Failure(Exit::kInput, {.code = "E-FIT-EARLIER",
                               .message = fmt::format("{} {}", display_name(earlier.run), why),
                               .help = "name a run of this arm, or of one of the same model"});
}

std::vector<SharedNumber> shared_numbers(const FitData& data, const ArmState& at,
                                         const std::vector<Parameter>& parameters,
                                         const EarlierArm& earlier) {
  std::vector<SharedNumber> out;
  const auto& own = data.cell->fit.priors;
  for (const auto& p : parameters) {
    const auto found = std::find_if(earlier.numbers.begin(), earlier.numbers.end(),
                                    [&](const auto& n) { return n.name == p.name; });
    const bool stated = std::any_of(own.begin(), own.end(),
                                    [&](const Prior& prior) { return prior.name == p.name; });
    if (found == earlier.numbers.end() || stated || !p.of_robot()) continue;
    if (p.of_effect() && of_measurement(at, p)) continue;
    const double built = built_within(data, at, p, found->value);
    if (built > 0.0) out.push_back({p, found - earlier.numbers.begin(), built});
  }
  if (out.empty())
    refuse(earlier,
           "has no number in common with this fit: another [fit] model, or all are held fixed");
  return out;
}

/// The shared numbers of the earlier arm as differences from nominal, in units of `built`.
struct ScaledEarlierArm {
  Eigen::VectorXd nominal, built;  // SI
  Eigen::VectorXd x;               // its differences from nominal
  Eigen::MatrixXd C;               // their covariance
};

ScaledEarlierArm scaled(const FitData& data, const std::vector<SharedNumber>& shared,
                        const EarlierArm& earlier) {
  const auto count = static_cast<Eigen::Index>(shared.size());
  ScaledEarlierArm out;
  out.nominal.resize(count);
  out.built.resize(count);
  out.x.resize(count);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < count; ++i) {
    const SharedNumber& one = shared[static_cast<std::size_t>(i)];
    rows.push_back(one.in_earlier);
    out.nominal(i) = nominal_of(data, one.parameter);
    out.built(i) = one.built;
    const double value = earlier.numbers[static_cast<std::size_t>(one.in_earlier)].value;
    out.x(i) = (value - out.nominal(i)) / one.built;
  }
  const Eigen::VectorXd per_built = out.built.cwiseInverse();
  out.C = per_built.asDiagonal() * Eigen::MatrixXd(earlier.covariance(rows, rows)) *
          per_built.asDiagonal();
  return out;
}

/// The readings reduced by QR to equations for the shared numbers u, with all other parameters
/// free: z = R (u - u0) + noise of variance 1. `rest` is the sum of squares of the `rest_lines`
/// remaining lines, on which no parameter has an effect.
struct SharedEquations {
  Eigen::MatrixXd R;
  Eigen::VectorXd z;
  double rest = 0.0;
  double rest_lines = 0.0;
};

SharedEquations shared_equations(const FitData& data, const ArmState& at,
                                 const std::vector<Parameter>& parameters,
                                 const std::vector<SharedNumber>& shared,
                                 const Eigen::VectorXd& built) {
  const auto is_shared = [&](const Parameter& p) {
    return std::any_of(shared.begin(), shared.end(),
                       [&](const SharedNumber& one) { return one.parameter.name == p.name; });
  };
  std::vector<Parameter> order;
  for (const auto& p : parameters)
    if (!is_shared(p)) order.push_back(p);
  const auto free = static_cast<Eigen::Index>(order.size());
  for (const auto& one : shared) order.push_back(one.parameter);
  FitData some = data;
  some.arm = {};
  some.weak = {};
  some.rows = thinned(data, kManyRows);
  const Solution here = evaluate(some, at, order);
  const Eigen::Index columns = here.jacobian.cols(), lines = here.jacobian.rows();
  Eigen::MatrixXd A(lines, columns + 1);
  A.leftCols(columns) = here.jacobian;
  A.rightCols(1) = here.residual;
  A.middleCols(free, built.size()) *= built.asDiagonal();
  for (Eigen::Index k = 0; k < free; ++k) A.col(k) /= std::max(A.col(k).norm(), 1e-300);
  const Eigen::MatrixXd triangle = householder_triangle(A);
  const Eigen::Index told = std::max<Eigen::Index>(0, std::min(lines, columns) - free);
  SharedEquations out;
  out.R = triangle.block(free, free, told, built.size());
  out.z = triangle.block(free, columns, told, 1);
  if (lines > columns) {
    out.rest = std::pow(triangle(columns, columns), 2);
    out.rest_lines = static_cast<double>(lines - columns);
  }
  return out;
}

/// One hypothesis: the shared numbers are normal about those of the earlier arm with this spread,
/// and the number `changed` may have any value.
struct Hypothesis {
  double weight = 0.0;  // posterior probability; until `normalise` its logarithm plus a constant
  double scale = 1.0, spread = 0.0, noise = 1.0;
  int changed = kUnchanged;
  std::size_t base = 0;  // index of its mean and covariance without a change
};

struct Gaussian {
  Eigen::VectorXd mean;
  Eigen::MatrixXd P;
};

/// All hypotheses with their posterior probabilities.
class LikenessMixture {
 public:
  /// offsets: indices of the joint offsets among the shared numbers.
  LikenessMixture(ScaledEarlierArm earlier, SharedEquations equations, Eigen::VectorXd u0,
                  std::vector<Eigen::Index> offsets)
      : earlier_(std::move(earlier)),
        equations_(std::move(equations)),
        u0_(std::move(u0)),
        offsets_(std::move(offsets)) {
    for (const double scale : kScales) weigh(scale);
    normalise();
  }

  const std::vector<Hypothesis>& hypotheses() const { return all_; }

  /// Fills in mean and covariance of the mixture, and how many of the numbers the readings decide.
  void conclude(const std::vector<SharedNumber>& shared, LikenessJudgement& out) const {
    const Eigen::Index count = earlier_.x.size();
    const Eigen::MatrixXd information = equations_.R.transpose() * equations_.R;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(count);
    Eigen::MatrixXd second = Eigen::MatrixXd::Zero(count, count);  // E[u u^T]
    double noise = 0.0;
    for (const auto& h : all_) {
      const Gaussian posterior = posterior_of(h);
      mean += h.weight * posterior.mean;
      second += h.weight * (posterior.P + posterior.mean * posterior.mean.transpose());
      noise += h.weight * h.noise * h.noise;
      out.decided += h.weight * information.cwiseProduct(posterior.P).sum() / (h.noise * h.noise);
    }
    for (const auto& one : shared) out.arm.names.push_back(one.parameter.name);
    out.arm.mean = earlier_.nominal + earlier_.built.cwiseProduct(mean);
    out.arm.covariance = earlier_.built.asDiagonal() * (second - mean * mean.transpose()) *
                         earlier_.built.asDiagonal();
    out.noise_times = std::sqrt(noise);
  }

 private:
  /// Distribution of the shared numbers under this hypothesis, before the readings.
  Gaussian prior_of(const Hypothesis& h) const {
    Gaussian out = bases_[h.base];
    const double variance = std::pow(kChangeTimes * h.scale, 2);
    if (h.changed >= 0) out.P(h.changed, h.changed) += variance;
    if (h.changed == kOffsets)
      for (const auto k : offsets_) out.P(k, k) += variance;
    return out;
  }

  /// Distribution of the shared numbers under this hypothesis, given the readings.
  Gaussian posterior_of(const Hypothesis& h) const {
    Gaussian out = prior_of(h);
    const Eigen::MatrixXd across = out.P * equations_.R.transpose();
    Eigen::MatrixXd S = equations_.R * across;
    S.diagonal().array() += h.noise * h.noise;
    const Cholesky llt(S);
    const Eigen::VectorXd off = equations_.z - equations_.R * (out.mean - u0_);
    out.mean += across * llt.solve(off);
    out.P -= across * llt.solve(across.transpose());
    return out;
  }

  void weigh(double scale) {
    const Eigen::Index count = earlier_.x.size();
    const Eigen::MatrixXd T = scale * scale * Eigen::MatrixXd::Identity(count, count);
    const Eigen::MatrixXd of_run = earlier_.C + T;
    const Cholesky llt(of_run);
    const double ln_earlier = ln_normal(earlier_.x, llt);
    const Eigen::VectorXd d = T * llt.solve(earlier_.x);
    const Eigen::MatrixXd V = T - T * llt.solve(T);
    for (const double spread : kSpreads) {
      const double r2 = 1.0 - spread * spread;
      bases_.push_back({std::sqrt(r2) * d, r2 * V + spread * spread * T});
      const double chance =
          spread == 0.0 ? kSameArmPrior
                        : (1.0 - kSameArmPrior) / static_cast<double>(std::size(kSpreads) - 1);
      weigh(scale, spread, ln_earlier + std::log(chance));
    }
  }

  /// Weighs one spread at every noise, with and without a number that has changed.
  void weigh(double scale, double spread, double ln_before) {
    const Gaussian& base = bases_.back();
    const Eigen::VectorXd z = equations_.z - equations_.R * (base.mean - u0_);
    const Eigen::MatrixXd seen = equations_.R * base.P * equations_.R.transpose();
    const SymmetricEigen eigen = symmetric_eigen(seen);
    const Eigen::MatrixXd Ut = eigen.vectors.transpose();
    const Eigen::ArrayXd w = Ut * z;
    const Eigen::MatrixXd moved = Ut * equations_.R * (kChangeTimes * scale);
    const bool may_change = spread <= kMostWithChange;
    for (const double noise : kNoises) {
      const Eigen::ArrayXd S = eigen.values.array().max(0.0) + noise * noise;
      const Eigen::ArrayXd Sw = w / S;
      const double ln = ln_before - 0.5 * ((w * Sw).sum() + S.log().sum()) -
                        0.5 * equations_.rest / (noise * noise) -
                        equations_.rest_lines * std::log(noise) -
                        1.5 * std::log1p(0.5 * std::pow(std::log(noise) / kNoiseScale, 2));
      Hypothesis one{ln, scale, spread, noise, kUnchanged, bases_.size() - 1};
      if (may_change) one.weight += std::log(1.0 - 2.0 * kChangeChance);
      all_.push_back(one);
      if (!may_change) continue;
      one.changed = kOffsets;
      one.weight = ln + ln_of_offsets(one, S, Sw, Ut) + std::log(kChangeChance);
      all_.push_back(one);
      for (Eigen::Index j = 0; j < moved.cols(); ++j) {
        const Eigen::ArrayXd v = moved.col(j);
        const double more = 1.0 + (v * v / S).sum();
        one.changed = static_cast<int>(j);
        one.weight = ln + std::log(kChangeChance / static_cast<double>(moved.cols())) -
                     0.5 * std::log(more) + 0.5 * std::pow((v * Sw).sum(), 2) / more;
        all_.push_back(one);
      }
    }
  }

  /// Change of the log evidence if the offsets of all joints may have changed, by the Woodbury
  /// identity.
  double ln_of_offsets(const Hypothesis& h, const Eigen::ArrayXd& S, const Eigen::ArrayXd& Sw,
                       const Eigen::MatrixXd& Ut) const {
    if (offsets_.empty()) return 0.0;
    const Eigen::MatrixXd V = Ut * equations_.R(Eigen::all, offsets_) * (kChangeTimes * h.scale);
    const Cholesky llt(with_prior(V.transpose() * S.inverse().matrix().asDiagonal() * V));
    const Eigen::VectorXd towards = V.transpose() * Sw.matrix();
    return 0.5 * towards.dot(llt.solve(towards)) - 0.5 * llt.ln_det();
  }

  /// Turns log weights into probabilities, and drops negligible hypotheses.
  void normalise() {
    double most = -HUGE_VAL, sum = 0.0;
    for (const auto& h : all_) most = std::max(most, h.weight);
    for (auto& h : all_) sum += h.weight = std::exp(h.weight - most);
    for (auto& h : all_) h.weight /= sum;
    std::erase_if(all_, [](const Hypothesis& h) { return h.weight < kNegligible; });
    double left = 0.0;
    for (const auto& h : all_) left += h.weight;
    for (auto& h : all_) h.weight /= left;
  }

  ScaledEarlierArm earlier_;
  SharedEquations equations_;
  Eigen::VectorXd u0_;
  std::vector<Eigen::Index> offsets_;
  std::vector<Gaussian> bases_;
  std::vector<Hypothesis> all_;
};

/// The shared numbers of `at` as differences from nominal, in units of `built`.
Eigen::VectorXd scaled_numbers(const ArmState& at, const std::vector<SharedNumber>& shared,
                               const ScaledEarlierArm& earlier) {
  Eigen::VectorXd out(earlier.x.size());
  for (Eigen::Index i = 0; i < out.size(); ++i)
    out(i) = (value_of(at, shared[static_cast<std::size_t>(i)].parameter) - earlier.nominal(i)) /
             earlier.built(i);
  return out;
}

Likeness summary(const LikenessMixture& mixture, const std::vector<SharedNumber>& shared,
                 const FitSettings& settings) {
  Likeness out;
  out.numbers = static_cast<int>(shared.size());
  Eigen::VectorXd changed = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(shared.size()));
  double unlike = 0.0, variance = 0.0, r2 = 0.0, offsets = 0.0;
  for (const auto& h : mixture.hypotheses()) {
    if (h.spread <= kSameSpread) out.same_chance += h.weight;
    if (h.spread >= kUnlikeSpread) unlike += h.weight;
    if (h.changed >= 0) changed(h.changed) += h.weight;
    if (h.changed == kOffsets) offsets += h.weight;
    r2 += h.weight * (1.0 - h.spread * h.spread);
    variance += h.weight * std::pow(h.spread * h.scale, 2);
  }
  if (out.same_chance > kSureLikeness)
    out.kind = Likeness::Kind::kSame;
  else if (unlike > kSureLikeness)
    out.kind = Likeness::Kind::kUnlike;
  else if (out.same_chance + unlike < 1.0 - kSureLikeness)
    out.kind = Likeness::Kind::kSister;
  out.share = std::sqrt(r2);
  const auto of = [](double stated) { return stated > 0.0 ? stated : kUnsetPrior; };
  out.spread_m = std::sqrt(variance) * of(settings.prior_m);
  out.spread_rad = std::sqrt(variance) * of(settings.prior_rad);
  Eigen::Index likely = 0;
  if (changed.maxCoeff(&likely) > kSureLikeness)
    out.changed = shared[static_cast<std::size_t>(likely)].parameter.name;
  if (offsets > kSureLikeness) out.changed = "offsets";
  return out;
}

}  // namespace

LikenessJudgement judge_likeness(const FitData& data, const ArmState& at,
                                 const std::vector<Parameter>& parameters,
                                 const EarlierArm& earlier) {
  const auto shared = shared_numbers(data, at, parameters, earlier);
  const ScaledEarlierArm known = scaled(data, shared, earlier);
  std::vector<Eigen::Index> offsets;
  for (std::size_t i = 0; i < shared.size(); ++i)
    if (is_offset(data, shared[i].parameter)) offsets.push_back(static_cast<Eigen::Index>(i));
  const LikenessMixture mixture(known, shared_equations(data, at, parameters, shared, known.built),
                                scaled_numbers(at, shared, known), std::move(offsets));
  LikenessJudgement out{.likeness = summary(mixture, shared, data.cell->fit), .arm = {}};
  mixture.conclude(shared, out);
  out.likeness.run = earlier.run.string();
  return out;
}

KnownArm known_within(double spread, const FitData& data, const ArmState& at,
                      const std::vector<Parameter>& parameters, const EarlierArm& earlier) {
  const auto shared = shared_numbers(data, at, parameters, earlier);
  const ScaledEarlierArm known = scaled(data, shared, earlier);
  KnownArm out;
  for (const auto& one : shared) out.names.push_back(one.parameter.name);
  out.mean = known.nominal + known.built.cwiseProduct(known.x);
  Eigen::MatrixXd P = known.C;
  P.diagonal().array() += spread * spread;
  out.covariance = known.built.asDiagonal() * P * known.built.asDiagonal();
  return out;
}

void check_same_model(const Cell& cell, const EarlierArm& earlier) {
  const auto& joints = cell.nominal.joints;
  const bool modified = cell.nominal.convention == format::Convention::kModified;
  if (earlier.modified != modified)
    refuse(earlier, "is of an arm whose rows stand in the other convention");
  if (earlier.rows.size() != joints.size())
    refuse(earlier, fmt::format("is of an arm of {}, this one has {}",
                                counted_words(static_cast<long long>(earlier.rows.size()), "joint",
                                              "joints"),
                                joints.size()));
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto& then = earlier.rows[i];
    const auto& now = joints[i];
    if (then.joint != now.name)
      refuse(earlier, fmt::format("calls joint {} {}, not {}", i + 1, then.joint, now.name));
    if (then.prismatic != (now.type == format::JointType::kPrismatic))
      refuse(earlier, fmt::format("has another kind of joint {}", now.name));
    const auto check = [&](const char* what, double calibrated, double nominal) {
      const std::string name = now.name + "." + what;
      const auto fitted = std::find_if(earlier.numbers.begin(), earlier.numbers.end(),
                                       [&](const auto& n) { return n.name == name; });
      const double before = fitted == earlier.numbers.end() ? calibrated : fitted->nominal;
      if (std::abs(before - nominal) > kSameNominal)
        refuse(earlier,
               fmt::format("is of another model: its nominal {} is not that of this cell", name));
    };
    check("theta", then.theta, now.theta);
    check("d", then.d, now.d);
    check("a", then.a, now.a);
    check("alpha", then.alpha, now.alpha);
  }
}

}  // namespace plumb::offline
