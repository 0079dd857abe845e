// SPDX-License-Identifier: Apache-2.0
#include "diagnose/series_prior.hpp"

#include <Eigen/Cholesky>
#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "diagnose/constants.hpp"

namespace plumb::offline {
namespace {

constexpr std::array kSlopes = {0.0, 0.5, 1.0, 1.5};
/// Prior over scatter of one reading at 1 m: half a decade apart.
constexpr std::array kSizes = {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0};
constexpr int kFirstSlope = 1, kFirstSize = 4;
/// Of one prior to the next narrower one, and how many are tried at most.
constexpr double kNarrower = 1.5;
constexpr int kMostNarrower = 12;
/// Residual of the equations of a fold, over their right side.
constexpr double kFoldSolved = 1e-4;
constexpr int kMostFoldSteps = 60;

/// Whether a gear may be expected to have such waves. Where poses leave a range of the joint out,
/// nothing but the prior holds the series, so a wide one must not be chosen for what it explains
/// elsewhere.
bool is_expected(const SeriesEvidence& e) { return e.prior.ratio * e.scatter <= kLargestWave_rad; }

/// RMS whitened motion of a joint per radian: what the size of a prior is measured by.
double lever_of(const WhitenedFit& s, const std::vector<int>& joints) {
  double sum = 0.0;
  for (const int joint : joints)
    sum += s.joint[joint].head(s.fit_lines).squaredNorm() / static_cast<double>(s.fit_lines);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, joints.size())));
}

/// The factor of all folds' equations: near those of all folds but one.
class AllFolds {
 public:
  void set(const Eigen::LLT<Eigen::MatrixXd>& llt) { llt_ = &llt; }
  template <class Matrix>
  AllFolds& analyzePattern(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  AllFolds& factorize(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  AllFolds& compute(const Matrix&) {
    return *this;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const { return llt_->solve(right); }
  Eigen::ComputationInfo info() const { return Eigen::Success; }

 private:
  const Eigen::LLT<Eigen::MatrixXd>* llt_ = nullptr;
};

/// Normal equations of the model's columns and a series', scaled by its prior.
struct Equations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

Equations equations(const Eigen::MatrixXd& UU, const Eigen::VectorXd& Uy, const Products& series,
                    const Eigen::VectorXd& ratio) {
  const Eigen::Index p = UU.cols(), b = ratio.size();
  Equations out{Eigen::MatrixXd(p + b, p + b), Eigen::VectorXd(p + b)};
  out.matrix.topLeftCorner(p, p) = UU;
  out.matrix.topRightCorner(p, b) = series.UX * ratio.asDiagonal();
  out.matrix.bottomLeftCorner(b, p) = out.matrix.topRightCorner(p, b).transpose();
  out.matrix.bottomRightCorner(b, b) = ratio.asDiagonal() * series.XX * ratio.asDiagonal();
  out.right << Uy, ratio.cwiseProduct(series.Xy);
  return out;
}

}  // namespace

SeriesPriorSearch::SeriesPriorSearch(const Scorer& scorer, SeriesProducts products)
    : scorer_(&scorer),
      products_(std::move(products)),
      gram_(products_.all.XX - products_.all.UX.transpose() * products_.all.UX),
      unit_(1.0 / lever_of(scorer.whitened(), products_.joints)) {}

SeriesPriorSearch SeriesPriorSearch::of(const std::vector<int>& some) const {
  return {*scorer_, products_.of(some)};
}

Eigen::VectorXd SeriesPriorSearch::ratios(const SeriesPrior& prior) const {
  Eigen::VectorXd out(products_.columns());
  for (Eigen::Index c = 0; c < out.size(); ++c)
    out(c) = prior.ratio *
             std::pow(1.0 + static_cast<double>(c % (2 * products_.waves) / 2), -prior.slope);
  return out;
}

/// As `evidence`, with a prior of its own for every column, in units of the scatter that is left.
SeriesEvidence SeriesPriorSearch::evidence_with(const SeriesPrior& prior) const {
  const Eigen::VectorXd ratio = ratios(prior);
  Eigen::MatrixXd scaled = ratio.asDiagonal() * gram_ * ratio.asDiagonal();
  scaled.diagonal().array() += 1.0;
  const Eigen::LLT<Eigen::MatrixXd> llt(scaled);
  if (llt.info() != Eigen::Success) return {prior};
  const Eigen::VectorXd v = ratio.cwiseProduct(products_.all.Xy);
  const EvidenceScale scale = scorer_->scale();
  const double before = scale.dof * scale.variance + scorer_->whitened().Q;
  const double after = std::max(1e-12 * before, before - v.dot(llt.solve(v)));
  const double n = scale.lines + scale.dof;
  const double paid = llt.matrixLLT().diagonal().array().log().sum();
  return {prior, -paid - 0.5 * n * std::log(after / before), std::sqrt(after / n)};
}

SeriesEvidence SeriesPriorSearch::best_prior() const {
  std::map<std::pair<int, int>, SeriesEvidence> tried;
  const auto at = [&](int slope, int size) -> const SeriesEvidence* {
    if (slope < 0 || slope >= static_cast<int>(kSlopes.size()) || size < 0 ||
        size >= static_cast<int>(kSizes.size()))
      return nullptr;
    const auto [here, fresh] = tried.try_emplace({slope, size});
    if (fresh)
      here->second = evidence_with({unit_ * kSizes[static_cast<std::size_t>(size)],
                                    kSlopes[static_cast<std::size_t>(slope)]});
    return &here->second;
  };
  int slope = kFirstSlope, size = kFirstSize;
  while (size > 0 && !is_expected(*at(slope, size))) --size;
  for (;;) {
    const SeriesEvidence* best = at(slope, size);
    int next_slope = slope, next_size = size;
    for (const auto& [to_slope, to_size] :
         {std::pair{slope - 1, size}, std::pair{slope + 1, size}, std::pair{slope, size - 1},
          std::pair{slope, size + 1}}) {
      const SeriesEvidence* there = at(to_slope, to_size);
      if (there == nullptr || !is_expected(*there) || there->ln_bayes <= best->ln_bayes) continue;
      best = there;
      next_slope = to_slope;
      next_size = to_size;
    }
    if (next_slope == slope && next_size == size) break;
    slope = next_slope;
    size = next_size;
  }
  SeriesEvidence out = *at(slope, size);
  out.ln_bayes -= std::log(static_cast<double>(kSlopes.size() * kSizes.size()));
  return out;
}

SeriesPriorSearch::HeldOut SeriesPriorSearch::held_out(const SeriesPrior& prior) const {
  const WhitenedFit& s = scorer_->whitened();
  const Eigen::VectorXd ratio = ratios(prior);
  Equations all = equations(Eigen::MatrixXd::Identity(s.rank, s.rank),
                            Eigen::VectorXd::Zero(s.rank), products_.all, ratio);
  all.matrix.diagonal().tail(ratio.size()).array() += 1.0;
  all.matrix.diagonal().head(s.rank).array() += 1e-9;  // a fold may be all that says something
  const Eigen::LLT<Eigen::MatrixXd> llt(all.matrix);
  const Eigen::VectorXd start = llt.solve(all.right);
  HeldOut out{prior};
  double lines = 0.0, squares = 0.0;
  for (std::size_t f = 0; f < products_.folds.size(); ++f) {
    const Scorer::Fold& model = scorer_->fold(f);
    const Equations held = equations(model.UU, model.Uy, products_.folds[f], ratio);
    const Eigen::MatrixXd others = all.matrix - held.matrix;
    Eigen::ConjugateGradient<Eigen::MatrixXd, Eigen::Lower | Eigen::Upper, AllFolds> solver;
    solver.preconditioner().set(llt);
    solver.setTolerance(kFoldSolved);
    solver.setMaxIterations(kMostFoldSteps);
    solver.compute(others);
    const Eigen::VectorXd x = solver.solveWithGuess(all.right - held.right, start);
    const double error = model.yy - 2.0 * x.dot(held.right) + x.dot(held.matrix * x);
    const auto count = static_cast<double>(s.folds[f].size() * s.axes);
    out.error += error;
    lines += count;
    squares += error * error / count;
  }
  out.error /= lines;
  const auto K = static_cast<double>(products_.folds.size());
  const double variance = std::max(0.0, squares / lines - out.error * out.error);
  out.standard_error = std::sqrt(variance / std::max(1.0, K - 1.0));
  return out;
}

SeriesEvidence SeriesPriorSearch::narrowest_prior(const SeriesEvidence& most) const {
  std::vector<HeldOut> tried{held_out(most.prior)};
  HeldOut best = tried.front();
  for (const double slope : kSlopes) {
    double ratio = most.prior.ratio;
    for (int i = 0; i < kMostNarrower; ++i, ratio /= kNarrower) {
      const HeldOut here = held_out({ratio, slope});
      tried.push_back(here);
      if (here.error < best.error) best = here;
      if (here.error > best.error + best.standard_error) break;
    }
  }
  HeldOut out = best;
  for (const HeldOut& one : tried)
    if (one.error <= best.error + best.standard_error &&
        (one.prior.ratio < out.prior.ratio ||
         (one.prior.ratio == out.prior.ratio && one.prior.slope > out.prior.slope)))
      out = one;
  return evidence_with(out.prior);
}

}  // namespace plumb::offline
