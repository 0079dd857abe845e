// SPDX-License-Identifier: Apache-2.0
#include "check/separation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arm/neighbouring_axes.hpp"
#include "cell/artefacts.hpp"
#include "check/arm_shape.hpp"
#include "check/constants.hpp"
#include "numbers/pivoted_qr.hpp"
#include "solve/evaluation.hpp"
#include "solve/imagined_poses.hpp"
#include "solve/parameter_subset.hpp"

namespace plumb::offline {
namespace {

/// Pairs that are told, the most correlated ones, and partners that a sentence names.
constexpr std::size_t kMostPairs = 12, kMostPartners = 6;

/// How a column is made of others: which ones, and what is left.
struct Mixture {
  std::vector<int> partners;  // into kept, largest first
  double left = 0.0;          // share
};

Mixture mixture(const Eigen::MatrixXd& kept, const Eigen::VectorXd& column) {
  Mixture out;
  const double whole = column.norm();
  if (!(whole > 0.0)) return out;
  if (kept.cols() == 0) {
    out.left = 1.0;
    return out;
  }
  const Eigen::VectorXd x = PivotedQr(kept).solve(column);
  out.left = (column - kept * x).norm() / whole;
  std::vector<std::pair<double, int>> shares;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double share = std::abs(x(i)) * kept.col(i).norm() / whole;
    if (share > check::kPartnerShare) shares.emplace_back(-share, static_cast<int>(i));
  }
  std::sort(shares.begin(), shares.end());
  for (const auto& [share, i] : shares) out.partners.push_back(i);
  return out;
}

class Explainer {
 public:
  Explainer(const Cell& cell, const FitData& data, const ArmState& state,
            const std::vector<Parameter>& kept)
      : cell_(cell),
        data_(data),
        state_(state),
        kept_(kept),
        shape_(arm_shape(cell, *data.measured, data.rows, state)) {}

  std::vector<Separation> explain(const std::vector<Parameter>& held,
                                  const Eigen::MatrixXd& covariance) {
    parallel_lengths();
    if (!held.empty()) explain_held(held);
    explain_pairs(covariance);
    return std::move(out_);
  }

 private:
  std::string joint(int j) const { return cell_.nominal.joints[j].name; }

  /// "J2.d" of parallel neighbours, which the model leaves out from the start.
  void parallel_lengths() {
    for (int j = 0; j + 1 < cell_.joints(); ++j) {
      const std::string d = joint(j) + ".d", next = joint(j + 1) + ".d";
      const auto has = [&](const std::string& name) {
        return std::any_of(kept_.begin(), kept_.end(),
                           [&](const Parameter& p) { return p.name == name; });
      };
      if (shape_.angle_to_next[j] > kNearParallel_rad || has(d)) continue;
      if (cell_.nominal.joints[j].type != format::JointType::kRevolute) continue;
      out_.push_back({Separation::Cause::kArm,
                      d,
                      {next},
                      1.0,
                      fmt::format("{} and {} cannot be separated: {}", d, next, parallel(j))});
    }
  }

  std::string parallel(int j) const {
    return fmt::format("{} and {} are parallel to {:.2g} deg", joint(j), joint(j + 1),
                       std::max(shape_.angle_to_next[j] / check::kDegree_rad, 1e-3));
  }

  void explain_held(const std::vector<Parameter>& held) {
    const Eigen::MatrixXd K = evaluate(data_, state_, kept_).jacobian;
    const Eigen::MatrixXd H = evaluate(data_, state_, held).jacobian;
    const Eigen::MatrixXd K_anywhere = anywhere_of(kept_);
    for (std::size_t i = 0; i < held.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const Mixture here = mixture(K, H.col(column));
      const bool seen = here.left > check::kSeparable;
      const bool anywhere =
          held[i].of_effect() ||
          mixture(K_anywhere, anywhere_of({held[i]}).col(0)).left > check::kSeparable;
      out_.push_back(sentence(held[i], here, seen, anywhere));
    }
  }

  Eigen::MatrixXd anywhere_of(std::vector<Parameter> parameters) const {
    std::erase_if(parameters, [](const Parameter& p) { return p.of_effect(); });
    return at_imagined_poses(cell_, data_, state_, parameters);
  }

  Separation sentence(const Parameter& p, const Mixture& here, bool seen, bool anywhere) const {
    using Cause = Separation::Cause;
    Separation out{Cause::kChoice, p.name, {}, 1.0, ""};
    bool only_base = true, only_target = true;
    for (const int i : here.partners) {
      out.partners.push_back(kept_[i].name);
      only_base = only_base && kept_[i].of_base();
      only_target = only_target && kept_[i].kind == Parameter::Kind::kTarget;
    }
    const std::string with =
        out.partners.empty() ? "the rest" : fmt::format("{}", fmt::join(out.partners, ", "));
    const std::string cannot = fmt::format("{} cannot be separated from {}: ", p.name, with);
    if (!seen && only_base && p.of_robot() && !data_.measured->placement.empty()) {
      out.text = p.name + " moves all of the arm: touched points do not tell where it stands";
    } else if (seen) {
      out.cause = Cause::kWeak;
      out.text = fmt::format("{} is seen too weakly to be better than {}: {}", p.name,
                             p.of_effect() ? "none" : "nominal", reason(p, here));
    } else if (!anywhere && !here.partners.empty() && p.of_robot() && only_base) {
      out.text = cannot + "both move the base; the fitted frame carries it";
    } else if (!anywhere && !here.partners.empty() && p.of_robot() && only_target) {
      out.text = cannot + "both move the reflector on the flange; the fitted target carries it";
    } else if (!anywhere) {
      const auto why = arm_reason(p, here);
      out.cause = why.empty() ? Cause::kChoice : Cause::kArm;
      out.text =
          cannot + (why.empty() ? "no pose of this arm does, and one of them is enough" : why);
    } else {
      out.cause = Cause::kPoses;
      out.text = here.partners.size() > kMostPartners
                     ? fmt::format("{} needs more poses than these", p.name)
                     : cannot + poses_reason(p, here);
    }
    return out;
  }

  bool of_effects(const Parameter& p, const Mixture& here) const {
    return p.of_effect() || std::any_of(here.partners.begin(), here.partners.end(),
                                        [&](int i) { return kept_[i].of_effect(); });
  }

  /// Why p, whose partners may be of effects, cannot be told. Only an effect of single joints can
  /// have a joint that never moves.
  std::string effect_reason(const Parameter& p) const {
    if (p.of_effect())
      for (const int j : state_.arm.effects[static_cast<std::size_t>(p.joint)].joints)
        if (shape_.used[static_cast<std::size_t>(j)] < check::kStill)
          return fmt::format("{} never moves in these poses: move it by > 60 deg", joint(j));
    return "in these poses they move the measured point alike";
  }

  /// The first and the last joint that p and its partners belong to, none of which may be of an
  /// effect.
  std::pair<int, int> span(const Parameter& p, const Mixture& here) const {
    int first = cell_.joints() - 1, last = 0;
    const auto take = [&](const Parameter& parameter) {
      const bool frame = parameter.of_base();
      const int j = frame ? 0 : parameter.of_robot() ? parameter.joint : cell_.joints() - 1;
      first = std::min(first, j);
      last = std::max(last, j);
    };
    take(p);
    for (const int i : here.partners) take(kept_[i]);
    // A row speaks of the link to the next joint, or from the one before.
    const bool standard = cell_.nominal.convention == format::Convention::kStandard;
    return {standard ? first : std::max(0, first - 1),
            standard ? std::min(cell_.joints() - 1, last + 1) : last};
  }

  std::string arm_reason(const Parameter& p, const Mixture& here) const {
    if (of_effects(p, here)) return "";
    const auto [first, last] = span(p, here);
    if (last == cell_.joints() - 1 && shape_.reflector_off_last_axis_m < check::kOnAxis_m)
      return off_axis();
    for (int j = first; j < last; ++j)
      if (shape_.angle_to_next[j] < kNearParallel_rad) return parallel(j);
    return "";
  }

  std::string off_axis() const {
    return fmt::format(
        "the reflector is {:.2f} mm from the axis of {}, so that turning it hardly "
        "moves the point: mount it further out",
        shape_.reflector_off_last_axis_m * 1e3, joint(cell_.joints() - 1));
  }

  std::string reason(const Parameter& p, const Mixture& here) const {
    if (of_effects(p, here)) return effect_reason(p);
    const auto [first, last] = span(p, here);
    if (still_joint(first, last) >= 0) return poses_reason(p, here);
    const std::string arm = arm_reason(p, here);
    return arm.empty() ? poses_reason(p, here) : arm;
  }

  int still_joint(int first, int last) const {
    for (int j = first; j <= last; ++j)
      if (shape_.used[j] < check::kStill) return j;
    return -1;
  }

  std::string poses_reason(const Parameter& p, const Mixture& here) const {
    if (of_effects(p, here)) return effect_reason(p);
    const auto [first, last] = span(p, here);
    if (const int j = still_joint(first, last); j >= 0)
      return fmt::format("{} never moves in these poses: move it by > 60 deg", joint(j));
    if (shape_.flat) return "all points lie in one plane: measure at other heights as well";
    int least = first;
    for (int j = first; j <= last; ++j)
      if (shape_.used[j] / shape_.limits[j] < shape_.used[least] / shape_.limits[least]) least = j;
    if (shape_.used[least] > check::kWideRange &&
        shape_.used[least] > check::kWideShare * shape_.limits[least])
      return "in all these poses they move the point alike; more poses, further apart, help";
    const bool slides = cell_.nominal.joints[least].type == format::JointType::kPrismatic;
    return fmt::format("these poses do not separate them; add poses that move {} over more than {}",
                       joint(least), slides ? "half of its travel" : "60 deg");
  }

  void explain_pairs(const Eigen::MatrixXd& covariance) {
    std::vector<Separation> pairs;
    const Eigen::VectorXd sigma = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt();
    for (Eigen::Index i = 0; i < covariance.rows(); ++i)
      for (Eigen::Index k = i + 1; k < covariance.rows(); ++k) {
        const double rho = covariance(i, k) / (sigma(i) * sigma(k));
        const Parameter &a = kept_[i], &b = kept_[k];
        if (std::abs(rho) < check::kCorrelated || (!a.of_robot() && !b.of_robot())) continue;
        // Points are as far as the arm is large; that nothing tells its size is said once.
        if ((a.of_base() || b.of_base()) && lacks_length(cell_)) continue;
        Mixture both;
        both.partners = {static_cast<int>(k)};
        pairs.push_back(
            {Separation::Cause::kWeak,
             a.name,
             {b.name},
             rho,
             fmt::format("{} and {} cannot be told apart by these poses (correlation {:+.2f}): {}",
                         a.name, b.name, rho, reason(a, both))});
      }
    std::sort(pairs.begin(), pairs.end(), [](const Separation& a, const Separation& b) {
      return std::abs(a.rho) > std::abs(b.rho);
    });
    if (pairs.size() > kMostPairs) pairs.resize(kMostPairs);
    out_.insert(out_.end(), pairs.begin(), pairs.end());
  }

  const Cell& cell_;
  const FitData& data_;
  const ArmState& state_;
  const std::vector<Parameter>& kept_;
  ArmShape shape_;
  std::vector<Separation> out_;
};

}  // namespace

std::vector<Separation> separations(const Cell& cell, const FitData& data, const ArmState& state,
                                    const std::vector<Parameter>& kept,
                                    const std::vector<Parameter>& held,
                                    const Eigen::MatrixXd& covariance) {
  return Explainer(cell, data, state, kept).explain(held, covariance);
}

}  // namespace plumb::offline
