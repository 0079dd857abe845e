// SPDX-License-Identifier: Apache-2.0
#include "diagnose/other_gravity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "diagnose/constants.hpp"
#include "diagnose/evidence_scale.hpp"
#include "diagnose/thinned_fit.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "numbers/gaussian.hpp"
#include "plumb/runtime/detail/effect_set.hpp"

namespace plumb::offline {
namespace {

using Eigen::Index;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kNearlyThis = 2.0 * kDegree;    // an axis of the base is meant
constexpr double kSameAsStated = 3.0 * kDegree;  // no other direction
constexpr Index kDirectionPoses = 400;
constexpr int kAlternations = 20;
constexpr double kWorthAScan = 0.8;  // of the evidence under the stated direction

/// A law of a load at some joints, as moved by gravity of the stated size along each axis of the
/// base.
struct Load {
  EffectEntry entry;
  Index parameters = 0;
  Eigen::MatrixXd gram;  // of the columns cleared of the model, shape (3 p, 3 p): x, y, z of each
  Eigen::VectorXd v;
};

struct Direction {
  Vector3 along = Vector3::Zero();
  EffectEntry entry;
  double ln_bayes = kImpossible;
  double signal = 0.0;  // what it explains, over the variance of the noise
};

bool is_tried(const EffectDescriptor& effect, const std::vector<std::string>& not_testable) {
  return effect.search == Search::kGrid && effect.grid.empty() && grows_with_load(effect) &&
         effect.parameters_of_joint == nullptr &&
         (effect.candidate_joints == CandidateJoints::kEach ||
          effect.candidate_joints == CandidateJoints::kNone) &&
         std::find(not_testable.begin(), not_testable.end(), effect.name) == not_testable.end();
}

/// The loads at the poses with gravity along that vector [m/s^2].
void weigh_along(const ArmState& state, const Vector3& gravity, WhitenedFit& s) {
  const Transformd X_TF = from_pose(state.arm.calibrated.tool).inverse();
  for (std::size_t i = 0; i < s.loads.size(); ++i)
    weigh(s.chain, s.frames[i], state.arm.mechanics, {gravity(0), gravity(1), gravity(2)}, X_TF,
          s.context[i].known, s.loads[i]);
}

/// The whitened fit under gravity along each axis of the base.
class Axes {
 public:
  Axes(const WhitenedFit& s, const ArmState& state, double size) : along_{s, s, s} {
    for (int k = 0; k < 3; ++k)
      weigh_along(state, size * Vector3(Eigen::Vector3d::Unit(k)), along_[k]);
  }

  std::optional<Load> load(const EffectEntry& entry, Index parameters) const {
    const WhitenedFit& s = along_[0];
    Eigen::MatrixXd X = Eigen::MatrixXd::Zero(s.fit_lines, 3 * parameters);
    for (Index k = 0; k < 3; ++k) {
      const Regressor one = library_regressor(along_[static_cast<std::size_t>(k)], entry);
      if (one.columns.cols() == 0) continue;
      const Eigen::MatrixXd moved = motions(s, one).topRows(s.fit_lines);
      for (Index c = 0; c < moved.cols(); ++c)
        X.col(3 * one.members[static_cast<std::size_t>(c)] + k) = moved.col(c) / one.typical(c);
    }
    for (Index p = 0; p < parameters; ++p) {
      const double size = X.middleCols(3 * p, 3).norm() /
                          std::sqrt(static_cast<double>(std::max<Index>(1, s.fit_poses())));
      if (!(size > 0.0)) continue;
      X.middleCols(3 * p, 3) *= kTypicalMotion_m / s.sigma_m / size;
    }
    X -= s.U.topRows(s.fit_lines) * (s.U.topRows(s.fit_lines).transpose() * X).eval();
    Load out{entry, parameters, X.transpose() * X, X.transpose() * s.y.head(s.fit_lines)};
    if (!(out.gram.trace() > 0.0)) return std::nullopt;
    return out;
  }

 private:
  std::array<WhitenedFit, 3> along_;
};

/// Columns of the parameters for one direction, out of those for x, y and z: shape (3 p, p).
Eigen::MatrixXd along(const Load& load, const Vector3& d) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * load.parameters, load.parameters);
  for (Index p = 0; p < load.parameters; ++p) out.block(3 * p, p, 3, 1) = Eigen::Vector3d(d);
  return out;
}

/// Least-squares sizes with the widest prior, so that a parameter without motion stays 0.
Eigen::VectorXd solved(const Eigen::MatrixXd& gram, const Eigen::VectorXd& v, double variance) {
  return SymmetricSolver(with_prior(gram, kPriorWidths.back(), variance)).solve(v);
}

/// The direction that explains most, by alternating least squares: sizes for a fixed direction,
/// then the direction for fixed sizes.
Direction direction_of(const Load& load, const Vector3& start, double Q,
                       const EvidenceScale& scale) {
  Eigen::Vector3d d = start;
  Eigen::VectorXd sizes;
  for (int round = 0; round < kAlternations; ++round) {
    const Eigen::MatrixXd D = along(load, d);
    sizes = solved(D.transpose() * load.gram * D, D.transpose() * load.v, scale.variance);
    if (!(sizes.norm() > 0.0)) break;
    Eigen::MatrixXd S(3 * load.parameters, 3);
    for (Index p = 0; p < load.parameters; ++p)
      S.middleRows(3 * p, 3) = sizes(p) * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d next =
        solved(S.transpose() * load.gram * S, S.transpose() * load.v, scale.variance);
    if (!(next.norm() > 0.0)) break;
    d = next.normalized();
  }
  // What yields, yields downwards.
  if (sizes.size() > 0 && sizes.sum() < 0.0) d = -d;
  Direction out;
  out.along = Vector3(d);
  out.entry = load.entry;
  const Eigen::MatrixXd D = along(load, out.along);
  const Eigen::MatrixXd gram = D.transpose() * load.gram * D;
  const Eigen::VectorXd v = D.transpose() * load.v;
  out.ln_bayes = evidence(gram, v, Q, scale).ln_bayes;
  out.signal = v.dot(solved(gram, v, scale.variance)) / scale.variance;
  return out;
}

/// The joints together, each with a size of its own.
Load together(const Axes& axes, const std::vector<EffectEntry>& entries, Index each) {
  EffectEntry all = entries.front();
  all.joints.clear();
  for (const auto& entry : entries) all.joints.push_back(entry.joints.front());
  std::sort(all.joints.begin(), all.joints.end());
  const auto load = axes.load(all, each * static_cast<Index>(all.joints.size()));
  return load ? *load : Load{all, 0, {}, {}};
}

/// The best direction over the laws of a load.
Direction best_direction(const WhitenedFit& s, const ArmState& state, double size,
                         const std::vector<std::string>& not_testable) {
  const Axes axes(s, state, size);
  const EvidenceScale scale = evidence_scale(s);
  Direction best;
  const auto try_from = [&](const Load& load, const Vector3& start) {
    const Direction one = direction_of(load, start, s.Q, scale);
    if (one.ln_bayes > best.ln_bayes) best = one;
  };
  for (const EffectDescriptor* effect : effect_descriptors()) {
    if (!is_tried(*effect, not_testable)) continue;
    const auto each = static_cast<Index>(effect->law->parameters.size());
    const bool of_joints = effect->candidate_joints == CandidateJoints::kEach;
    std::vector<EffectEntry> entries;
    for (int j = 0; j < (of_joints ? s.joints() : 1); ++j) {
      if (of_joints && !s.chain.revolute(j)) continue;
      EffectEntry entry{
          .name = std::string(effect->name), .joints = {}, .options = {}, .place = {}};
      if (of_joints) entry.joints = {j};
      const auto load = axes.load(entry, each);
      if (!load) continue;
      entries.push_back(entry);
      for (int k = 0; k < 3; ++k) try_from(*load, Vector3(Eigen::Vector3d::Unit(k)));
    }
    if (entries.size() < 2 || effect->cause != Cause::kYieldingJoint) continue;
    const Vector3 start = best.along;
    const Load all = together(axes, entries, each);
    if (all.parameters > 0) try_from(all, start);
  }
  return best;
}

Vector3 at_an_axis(const Vector3& d) {
  for (int k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) {
      const Vector3 axis(sign * Eigen::Vector3d::Unit(k));
      if (d.dot(axis) > std::cos(kNearlyThis)) return axis;
    }
  return d;
}

const Found* first_of(const Scan& look) {
  if (look.unknown()) return &*look.pattern;
  return look.supported();
}

/// The highest evidence of any candidate, whether of a law or of a pattern.
double most_nats(const Scan& look) {
  double out = 0.0;
  if (!look.library.empty()) out = std::max(out, look.library.front().ln_bayes());
  if (look.pattern) out = std::max(out, look.pattern->ln_bayes());
  return out;
}

bool leaves_noise(const WhitenedFit& s, double explained) {
  return (1.0 - explained) * times_noise(s) < at_noise(s);
}

/// Evidence for the other gravity from the two fits alone, without any candidate [nats]: they
/// differ if the cell states a load.
double fit_nats(const WhitenedFit& stated, const WhitenedFit& other) {
  const EvidenceScale scale = evidence_scale(stated);
  const double known = scale.dof * scale.variance;
  return -0.5 * (scale.lines + scale.dof) * std::log((known + other.Q) / (known + stated.Q));
}

std::array<double, 3> to_hundredths(const Vector3& g) {
  std::array<double, 3> out{};
  for (int k = 0; k < 3; ++k) out[static_cast<std::size_t>(k)] = std::round(g(k) * 100.0) / 100.0;
  return out;
}

}  // namespace

std::optional<UnderOtherGravity> under_other_gravity(
    const Cell& cell, const Measurements& measured, const Calibration& calibration,
    const std::vector<int>& rows, const std::vector<int>& held, const WhitenedFit& plain,
    const JudgedFit& stated, const std::vector<std::string>& not_testable) {
  const Vector3 g(cell.gravity[0], cell.gravity[1], cell.gravity[2]);
  if (!plain.noise.known || !(g.norm() > 0.0) || times_noise(plain) < kAboveNoise)
    return std::nullopt;
  const Found* now = first_of(stated.look);
  if (now != nullptr && leaves_noise(plain, now->scored.explained)) return std::nullopt;
  const bool many = plain.fit_poses() > kDirectionPoses;
  const WhitenedFit some = thinned(plain, std::min(plain.fit_poses(), kDirectionPoses));
  const Direction found = best_direction(some, calibration.state, g.norm(), not_testable);
  const double share =
      static_cast<double>(plain.fit_poses()) / static_cast<double>(some.fit_poses());
  const double to_beat = most_nats(stated.look);
  const double price = std::log(std::max(1.0, 2.0 * share * found.signal));
  if (found.ln_bayes * (many ? share : 1.0) - price < kWorthAScan * to_beat) return std::nullopt;
  const Vector3 along = at_an_axis(found.along);
  if (along.dot(g) > std::cos(kSameAsStated) * g.norm()) return std::nullopt;

  UnderOtherGravity out;
  out.gravity.stated = cell.gravity;
  out.gravity.found = to_hundredths(along * g.norm());
  Cell turned = cell;
  turned.gravity = out.gravity.found;
  out.cell = std::make_unique<const Cell>(std::move(turned));
  if (!unless_refused([&] { out.calibration = calibrate(*out.cell, measured, rows); }))
    return std::nullopt;
  WhitenedFit other = make_whitened_fit(*out.cell, measured, out.calibration,
                                        without_outliers(rows, out.calibration.outliers), held);
  const double fits = fit_nats(plain, other);
  out.judged = judged(std::move(other), not_testable, {});
  const Found* best = out.judged.look.supported();
  if (best == nullptr || out.judged.look.unknown() ||
      !grows_with_load(descriptor_of(best->entry.name)))
    return std::nullopt;
  out.gravity.nats_ahead = best->ln_bayes() + fits - price - to_beat;
  const bool all_explained = leaves_noise(out.judged.whitened, best->scored.explained);
  const bool clearly = all_explained || now == nullptr ||
                       best->scored.explained > now->scored.explained + kAhead_share;
  // A tilt by any angle imitates much; an arm on a wall or a ceiling does not.
  const bool at_axis = along.cwiseAbs().maxCoeff() > std::cos(kSameAsStated) * along.norm();
  out.gravity.certain =
      clearly && (all_explained || at_axis) && out.gravity.nats_ahead > kAhead_nats;
  if (!clearly || out.gravity.nats_ahead < kSupported) return std::nullopt;
  return out;
}

std::string standing_words(const std::array<double, 3>& gravity) {
  const Vector3 g(gravity[0], gravity[1], gravity[2]);
  const double angle = std::acos(std::clamp(-g(2) / std::max(1e-12, g.norm()), -1.0, 1.0));
  constexpr double kAbout = 5.0 * kDegree;
  if (angle < kNearlyThis) return "the arm seems to stand upright";
  if (angle > std::numbers::pi - kAbout) return "the arm seems to hang from a ceiling";
  if (std::abs(angle - std::numbers::pi / 2.0) < kAbout) return "the arm seems to hang on a wall";
  return fmt::format("the arm seems to be tilted by {:.0f} deg", angle / kDegree);
}

}  // namespace plumb::offline
