// SPDX-License-Identifier: Apache-2.0
#include "diagnose/formula_choice.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "diagnose/constants.hpp"
#include "numbers/cholesky.hpp"

namespace plumb::offline {
namespace {

using Places = std::vector<Eigen::Index>;

/// Normal equations of the terms, cleared of the model.
struct Normal {
  Eigen::MatrixXd G;    // (T, T)
  Eigen::VectorXd v;    // (T,)
  Eigen::VectorXd raw;  // (T,) squares of the columns as they were
  double Q = 0.0, lines = 1.0;
};

double nats_of(double lines, double before, double after) {
  return 0.5 * lines * std::log(std::max(before, 1e-300) / std::max(after, 1e-300));
}

/// What a term costs: that it was chosen among so many, and its number.
double price(std::size_t terms, double lines) {
  return std::log(static_cast<double>(terms)) + 0.5 * std::log(lines);
}

/// Terms taken one by one, the best first, in the order in which they were taken.
class Forward {
 public:
  Forward(const Normal& normal, Places allowed)
      : normal_(normal),
        allowed_(std::move(allowed)),
        price_(price(std::max<std::size_t>(1, allowed_.size()), normal.lines)),
        left_(normal.Q) {}

  Places take() {
    // Each step adds a term that pays or drops one that does not, so the evidence only rises.
    for (std::size_t step = 0; step < 4 * kMostFormulaTerms; ++step)
      if (!drop() && !(chosen_.size() < kMostFormulaTerms && add())) break;
    return chosen_;
  }

 private:
  bool add() {
    const Eigen::MatrixXd inside = normal_.G(chosen_, chosen_);
    const SymmetricSolver solver(inside);
    double most = 0.0;
    Eigen::Index best = -1;
    for (const Eigen::Index c : allowed_) {
      if (std::find(chosen_.begin(), chosen_.end(), c) != chosen_.end()) continue;
      double square = normal_.G(c, c), product = normal_.v(c);
      if (!chosen_.empty()) {
        const Eigen::VectorXd column = normal_.G(chosen_, c), along = normal_.v(chosen_);
        const Eigen::VectorXd shares = solver.solve(column);
        square -= column.dot(shares);
        product -= shares.dot(along);
      }
      if (!(square > kFormulaOwnShare * normal_.raw(c))) continue;
      const double gain = product * product / square;
      if (gain > most) {
        most = gain;
        best = c;
      }
    }
    if (best < 0 || nats_of(normal_.lines, left_, left_ - most) < price_) return false;
    chosen_.push_back(best);
    left_ -= most;
    return true;
  }

  bool drop() {
    if (chosen_.size() < 2) return false;
    const Eigen::MatrixXd inside = normal_.G(chosen_, chosen_);
    const Eigen::VectorXd along = normal_.v(chosen_);
    const Eigen::MatrixXd inverse = SymmetricSolver(inside).inverse();
    const Eigen::VectorXd theta = inverse * along;
    Eigen::Index least = 0;
    const Eigen::VectorXd cost = theta.cwiseAbs2().cwiseQuotient(inverse.diagonal());
    cost.minCoeff(&least);
    if (nats_of(normal_.lines, left_ + cost(least), left_) >= price_) return false;
    left_ += cost(least);
    chosen_.erase(chosen_.begin() + least);
    return true;
  }

  const Normal& normal_;
  Places allowed_, chosen_;
  double price_, left_;
};

/// What the terms explain of the sum of squares.
double explained_by(const Normal& normal, const Places& terms) {
  if (terms.empty()) return 0.0;
  const Eigen::MatrixXd inside = normal.G(terms, terms);
  const Eigen::VectorXd along = normal.v(terms);
  return along.dot(SymmetricSolver(inside).solve(along));
}

Regressor some_of(const Regressor& all, const Places& terms) {
  Regressor out = all;
  out.columns = all.columns(Eigen::all, terms);
  out.typical = all.typical(terms);
  return out;
}

/// Scored so that sizes are fitted by least squares, nearly without a prior.
RegressorScore score_of_terms(const Scorer& scorer, const std::vector<Products>& folds,
                              const Places& terms) {
  RegressorScore out;
  for (const auto& fold : folds)
    out.folds.push_back({fold.XX(terms, terms), fold.UX(Eigen::all, terms), fold.Xy(terms)});
  out.active.resize(terms.size());
  std::iota(out.active.begin(), out.active.end(), Eigen::Index{0});
  out.theta.setZero(static_cast<Eigen::Index>(terms.size()));
  out.evidence.width = kPriorWidths.back();
  out.variance = scorer.scale().variance;
  return out;
}

/// Sum of squares of a fold as the others predict it, with these terms and without any.
double left_in(const Scorer& scorer, std::size_t f, const Regressor* some,
               const RegressorScore& scored) {
  const WhitenedFit& s = scorer.whitened();
  const Segment& at = s.folds[f];
  const auto lines = Eigen::seqN(s.table.begin(at.begin), s.table.count(at.begin, at.end));
  const auto fitted = some == nullptr ? scorer.without(f) : scorer.without(f, scored);
  Eigen::VectorXd out = s.y(lines) - s.U(lines, Eigen::all) * fitted.model;
  if (some != nullptr) out -= motion(s, *some, fitted.regressor)(lines);
  return out.squaredNorm();
}

class Chooser {
 public:
  Chooser(const Scorer& scorer, const Regressor& columns, const std::vector<FormulaTerm>& terms)
      : scorer_(scorer),
        columns_(columns),
        terms_(terms),
        folds_(scorer.products_by_fold(columns)) {
    const Products all = sum_of(folds_);
    whole_ = {all.XX - all.UX.transpose() * all.UX, all.Xy, all.XX.diagonal(), scorer.whitened().Q,
              scorer.scale().lines};
    for (std::size_t f = 0; f < folds_.size(); ++f)
      before_.push_back(left_in(scorer, f, nullptr, {}));
  }

  std::vector<FormulaChoice> choose() const {
    const auto any = [](const FormulaTerm&) { return true; };
    const Places best = Forward(whole_, places(any)).take();
    std::vector<FormulaChoice> out;
    if (best.empty() || !holds_in_every_fold()) return out;
    add(best, out);
    add(first_few(best), out);
    for (const auto shape : {FormulaTerm::Shape::kWave, FormulaTerm::Shape::kPower})
      add(Forward(whole_, places([&](const FormulaTerm& t) { return t.shape == shape; })).take(),
          out);
    std::stable_sort(out.begin(), out.end(), [](const FormulaChoice& a, const FormulaChoice& b) {
      return a.nats > b.nats;
    });
    return out;
  }

 private:
  Places places(const std::function<bool(const FormulaTerm&)>& wanted) const {
    Places out;
    for (std::size_t c = 0; c < terms_.size(); ++c)
      if (wanted(terms_[c])) out.push_back(static_cast<Eigen::Index>(c));
    return out;
  }

  /// Whether the error of every fold falls with the terms that the others choose.
  bool holds_in_every_fold() const {
    for (std::size_t f = 0; f < folds_.size(); ++f) {
      const auto cleared = scorer_.cleared_without(f, folds_);
      const Normal normal{cleared.XX, cleared.Xy, whole_.raw, cleared.Q, cleared.scale.lines};
      const Places chosen = Forward(normal, places([](const FormulaTerm&) { return true; })).take();
      if (chosen.empty() || !(left_with(f, chosen) < before_[f])) return false;
    }
    return true;
  }

  double left_with(std::size_t f, const Places& terms) const {
    const Regressor some = some_of(columns_, terms);
    return left_in(scorer_, f, &some, score_of_terms(scorer_, folds_, terms));
  }

  /// As few of the first terms as explain nearly all that all of them do.
  Places first_few(const Places& all) const {
    Places out;
    const double enough = kFormulaShort * explained_by(whole_, all);
    for (const Eigen::Index c : all) {
      out.push_back(c);
      if (explained_by(whole_, out) >= enough) break;
    }
    return out;
  }

  void add(Places terms, std::vector<FormulaChoice>& out) const {
    if (terms.empty()) return;
    std::sort(terms.begin(), terms.end());
    const std::vector<std::size_t> same(terms.begin(), terms.end());
    for (const auto& other : out)
      if (other.terms == same) return;
    double before = 0.0, after = 0.0;
    for (std::size_t f = 0; f < folds_.size(); ++f) {
      const double left = left_with(f, terms);
      if (!(left < before_[f])) return;
      before += before_[f];
      after += left;
    }
    const double paid = static_cast<double>(terms.size()) * price(terms_.size(), whole_.lines);
    const double nats = nats_of(whole_.lines, before, after) - paid;
    if (nats > 0.0) out.push_back({same, nats});
  }

  const Scorer& scorer_;
  const Regressor& columns_;
  const std::vector<FormulaTerm>& terms_;
  std::vector<Products> folds_;
  Normal whole_;
  std::vector<double> before_;
};

}  // namespace

std::vector<FormulaChoice> choose_formulas(const Scorer& scorer, const Regressor& columns,
                                           const std::vector<FormulaTerm>& terms) {
  if (terms.empty()) return {};
  return Chooser(scorer, columns, terms).choose();
}

}  // namespace plumb::offline
