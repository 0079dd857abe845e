// SPDX-License-Identifier: Apache-2.0
#include "diagnose/change_points.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "diagnose/constants.hpp"
#include "diagnose/evidence_scale.hpp"
#include "effects/registry.hpp"
#include "noise/cut_search.hpp"
#include "noise/moving_part.hpp"
#include "noise/running_sums.hpp"
#include "numbers/gaussian.hpp"
#include "numbers/pivoted_qr.hpp"

namespace plumb::offline {
namespace {

constexpr double kSamePayload_kg = 1e-6;
constexpr double kIndependent = 1e-7;  // least share of a column that the others do not explain

EffectEntry step_of(const MovingPart& part) {
  EffectEntry out{.name = change_point_effect(), .joints = {}, .options = {}, .place = {}};
  if (part.joint >= 0) out.joints = {part.joint};
  set_option(out, OptionKey::kOf, std::string(name_of(part.source)));
  return out;
}

Eigen::MatrixXd motions_of(const WhitenedFit& s, const MovingPart& part) {
  return part.source == MotionSource::kTool   ? s.tool
         : part.source == MotionSource::kBase ? s.base
                                              : Eigen::MatrixXd(s.joint[part.joint]);
}

std::vector<Eigen::Index> poses_in_order(const WhitenedFit& s) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(s.fit_poses()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  put_in_order(order, [&](Eigen::Index pose) { return s.context[pose].order; });
  return order;
}

/// Columns cleared of the model and made orthonormal, over the fit lines.
Eigen::MatrixXd cleared(const WhitenedFit& s, Eigen::MatrixXd X) {
  if (X.cols() == 0) return X;
  const auto U = s.U.topRows(s.fit_lines);
  for (int pass = 0; pass < 2; ++pass) X -= U * (U.transpose() * X).eval();
  const PivotedQr qr(X, kIndependent);
  return qr.basis(qr.rank());
}

/// A part that may have moved, with running sums of its motions over the poses behind a cut. If it
/// has moved at other cuts as well, those moves belong to the model.
class CutSearch {
 public:
  CutSearch(const WhitenedFit& s, const MovingPart& part)
      : s_(s),
        entry_(step_of(part)),
        motions_((motions_of(s, part) * kTypicalStep).topRows(s.fit_lines)),
        order_(poses_in_order(s)),
        scale_(evidence_scale(s)),
        behind_(motions_.cols(), s.rank),
        model_(s.U.topRows(s.fit_lines).transpose()),
        others_(0, s.fit_lines),
        y_(s.y.head(s.fit_lines)),
        Q_(s.Q) {}

  const EffectEntry& entry() const { return entry_; }
  const std::vector<Eigen::Index>& order() const { return order_; }
  int poses() const { return static_cast<int>(order_.size()); }
  CutRange cuts() const {
    return cuts_of(VisitRun{0, poses()}, static_cast<int>(kFewestBesideStep));
  }

  /// The columns of these cuts become part of the model: of this part's, or of another one's.
  void beside(const std::vector<int>& cuts) { beside(*this, cuts); }
  void beside(const CutSearch& part, const std::vector<int>& cuts) {
    const Eigen::MatrixXd others = cleared(s_, part.columns(cuts));
    scale_ = evidence_scale(s_);
    scale_.lines = std::max(1.0, scale_.lines - static_cast<double>(others.cols()));
    others_ = others.transpose();
    y_ = s_.y.head(s_.fit_lines);
    y_ -= others * (others.transpose() * y_).eval();
    Q_ = y_.squaredNorm();
    behind_ = RunningSums(motions_.cols(), s_.rank + others.cols());
  }

  /// The best of these cuts, by ln_bayes() or explained() of the motion behind it. `score_of(cut)`
  /// returns a std::optional<double>: nothing if the cut is not to be tried. To be called once
  /// after the construction or `beside`.
  template <class ScoreOf>
  std::optional<BestCut> best(const CutRange& cuts, const ScoreOf& score_of) {
    return best_cut(
        poses(), cuts, [&](int visit) { pass(visit); }, score_of);
  }
  double ln_bayes() const { return evidence(gram(), behind_.Xy, Q_, scale_).ln_bayes; }

  /// Sum of squares that the motion behind the cut explains. It finds the same best cut as the
  /// evidence and costs much less.
  double explained() const {
    return behind_.Xy.dot(
        with_prior(gram(), kPriorWidths.back(), scale_.variance).ldlt().solve(behind_.Xy));
  }

  /// Evidence of the moves at all these cuts together.
  double ln_bayes(const std::vector<int>& cuts) const {
    Eigen::MatrixXd X = columns(cuts);
    const auto U = s_.U.topRows(s_.fit_lines);
    X -= U * (U.transpose() * X).eval();
    return evidence(X.transpose() * X, X.transpose() * s_.y.head(s_.fit_lines), s_.Q,
                    evidence_scale(s_))
        .ln_bayes;
  }

 private:
  void pass(int visit) {
    const Eigen::Index pose = order_[static_cast<std::size_t>(visit)];
    const Eigen::Index at = s_.table.begin(pose), lines = s_.table.count(pose);
    const auto X = motions_.middleRows(at, lines);
    behind_.add(X, y_.segment(at, lines));
    behind_.add_model(0, model_.middleCols(at, lines), X);
    behind_.add_model(s_.rank, others_.middleCols(at, lines), X);
  }
  RunningSums::Square gram() const { return behind_.XX - behind_.UX.transpose() * behind_.UX; }

  /// The motions behind each cut, shape (fit lines, cuts * numbers).
  Eigen::MatrixXd columns(const std::vector<int>& cuts) const {
    const Eigen::Index each = motions_.cols();
    Eigen::MatrixXd out =
        Eigen::MatrixXd::Zero(motions_.rows(), each * static_cast<Eigen::Index>(cuts.size()));
    for (std::size_t k = 0; k < cuts.size(); ++k)
      for (int visit = cuts[k]; visit < poses(); ++visit) {
        const Eigen::Index pose = order_[static_cast<std::size_t>(visit)];
        const Eigen::Index at = s_.table.begin(pose), lines = s_.table.count(pose);
        out.block(at, static_cast<Eigen::Index>(k) * each, lines, each) =
            motions_.middleRows(at, lines);
      }
    return out;
  }

  const WhitenedFit& s_;
  EffectEntry entry_;
  Eigen::MatrixXd motions_;  // (fit lines, c) per typical step
  std::vector<Eigen::Index> order_;
  EvidenceScale scale_;
  RunningSums behind_;
  /// Columns of the model and of the other moves, orthonormal and stored as rows: shapes
  /// (rank, fit lines) and (columns, fit lines).
  Eigen::MatrixXd model_, others_;
  Eigen::VectorXd y_;
  double Q_;
};

/// Whether the payload changes at this pose and is constant before and behind it. Under another
/// payload the joints yield otherwise, which must not be taken for a slipped encoder.
bool changes_payload(const WhitenedFit& s, const std::vector<Eigen::Index>& order,
                     Eigen::Index cut) {
  const auto payload = [&](Eigen::Index i) { return s.context[order[i]].known.payload_kg; };
  if (!(std::abs(payload(cut) - payload(cut - 1)) > kSamePayload_kg)) return false;
  for (Eigen::Index k = 1; k < kFewestBesideStep; ++k)
    if (payload(cut - 1 - k) != payload(cut - 1) || payload(cut + k) != payload(cut)) return false;
  return true;
}

/// The row before the cut. If rows between its two poses were not scanned, the middle one of these.
double row_before(const WhitenedFit& s, const std::vector<Eigen::Index>& order, int cut) {
  const double before = s.context[order[cut - 1]].order, after = s.context[order[cut]].order;
  return std::floor(0.5 * (before + after + 1.0));
}

/// The best cut beside `others`, at least kFewestBesideStep poses from each of them.
std::optional<int> best_beside(CutSearch& part, const std::vector<int>& others,
                               const CutRange& cuts) {
  part.beside(others);
  const auto best = part.best(cuts, [&](int cut) -> std::optional<double> {
    for (const int other : others)
      if (std::abs(cut - other) < kFewestBesideStep) return std::nullopt;
    return part.explained();
  });
  if (!best) return std::nullopt;
  return best->cut;
}

/// Searches every cut again beside the others, at most `near` visits from where it was, and sorts
/// them.
void settle_near(CutSearch& part, std::vector<int>& cuts, int near) {
  const std::vector<int> found = cuts;
  settle(cuts, kSettlingRounds, [&](int& cut) {
    std::vector<int> others = cuts;
    std::erase(others, cut);
    const int before = cut, here = found[static_cast<std::size_t>(&cut - cuts.data())];
    cut = best_beside(part, others, cuts_near(part.cuts(), here, near)).value_or(cut);
    return cut != before;
  });
  std::sort(cuts.begin(), cuts.end());
}

double price_of_place(Eigen::Index poses) {
  return std::log(static_cast<double>(std::max<Eigen::Index>(1, poses)));
}

/// The evidence of the best single move of a part beside those of another one.
double best_move_beside(CutSearch& part, const CutSearch& other, const std::vector<int>& cuts) {
  part.beside(other, cuts);
  const auto best =
      part.best(part.cuts(), [&](int) -> std::optional<double> { return part.ln_bayes(); });
  return best ? best->score : 0.0;
}

/// Whether a single move of the tool explains more than a further one of the base, or the other
/// way round: several moves of the one can imitate a move of the other.
bool other_body_moved(const WhitenedFit& s, const MovingPart& moving, const CutSearch& part,
                      const std::vector<int>& cuts, double further_nats) {
  for (const MovingPart& other : moving_parts(s.joints())) {
    if (other.joint >= 0 || other.source == moving.source) continue;
    CutSearch body(s, other);
    if (best_move_beside(body, part, cuts) > further_nats) return true;
  }
  return false;
}

/// Further moves of the part, as long as the evidence pays for their places.
std::vector<int> further_moves(const WhitenedFit& s, const MovingPart& moving, CutSearch& part,
                               int first) {
  std::vector<int> out{first};
  double ln_bayes = part.ln_bayes(out);
  while (ln_bayes > 0.0 && out.size() < kMostMoves) {
    std::vector<int> more = out;
    const auto next = best_beside(part, out, part.cuts());
    if (!next) break;
    more.push_back(*next);
    settle_near(part, more, part.poses());
    const double with = part.ln_bayes(more);
    if (with < ln_bayes + kSupported + price_of_place(s.fit_poses())) break;
    if (other_body_moved(s, moving, part, out, with - ln_bayes)) break;
    out = std::move(more);
    ln_bayes = with;
  }
  return out;
}

ChangePoint at_cuts(const WhitenedFit& s, const CutSearch& part, const std::vector<int>& cuts) {
  ChangePoint out{part.entry(), {}};
  for (const int cut : cuts) out.after_rows.push_back(row_before(s, part.order(), cut));
  set_option(out.entry, OptionKey::kAfterRow, out.after_rows.front());
  return out;
}

}  // namespace

std::vector<ChangePoint> change_points(const WhitenedFit& s, int& tried) {
  std::vector<ChangePoint> out;
  for (const MovingPart& moving : moving_parts(s.joints())) {
    CutSearch part(s, moving);
    const auto best = part.best(part.cuts(), [&](int cut) -> std::optional<double> {
      if (moving.joint >= 0 && changes_payload(s, part.order(), cut)) return std::nullopt;
      ++tried;
      return part.ln_bayes();
    });
    if (!best) continue;
    out.push_back(at_cuts(s, part,
                          moving.joint >= 0 ? std::vector<int>{best->cut}
                                            : further_moves(s, moving, part, best->cut)));
  }
  return out;
}

Regressor moves_regressor(const WhitenedFit& s, const EffectEntry& step,
                          const std::vector<double>& after_rows) {
  Regressor out;
  for (const double row : after_rows) {
    EffectEntry one = step;
    set_option(one, OptionKey::kAfterRow, row);
    const Regressor move = library_regressor(s, one);
    if (out.columns.cols() == 0) {
      out = move;
    } else if (move.columns.cols() > 0) {
      Eigen::MatrixXd columns(out.columns.rows(), out.columns.cols() + move.columns.cols());
      columns << out.columns, move.columns;
      out.columns = std::move(columns);
      Eigen::VectorXd typical(out.typical.size() + move.typical.size());
      typical << out.typical, move.typical;
      out.typical = std::move(typical);
      out.members.insert(out.members.end(), move.members.begin(), move.members.end());
      out.positive.insert(out.positive.end(), move.positive.begin(), move.positive.end());
    }
    out.after_rows.resize(static_cast<std::size_t>(out.columns.cols()), row);
  }
  out.entry = step;
  return out;
}

RegressorScore score_moves(const Scorer& scorer, const Regressor& regressor, std::size_t moves) {
  RegressorScore out = scorer.score(regressor);
  if (moves > 1)
    out.evidence.ln_bayes -=
        static_cast<double>(moves - 1) * price_of_place(scorer.whitened().fit_poses());
  return out;
}

std::vector<Move> sized_moves(const WhitenedFit& s, const Regressor& regressor,
                              const Eigen::VectorXd& theta) {
  std::vector<Move> out;
  for (const double row : regressor.after_rows)
    if (out.empty() || out.back().after_row != row) out.push_back({row, 0.0});
  if (out.size() < 2) return {};
  for (Move& move : out) {
    Eigen::VectorXd sizes = theta;
    for (std::size_t c = 0; c < regressor.after_rows.size(); ++c)
      if (regressor.after_rows[c] != move.after_row) sizes(static_cast<Eigen::Index>(c)) = 0.0;
    Eigen::VectorXd moved = motion(s, regressor, sizes).head(s.fit_lines);
    double sum = 0.0;
    int behind = 0;
    for (Eigen::Index i = 0; i < s.fit_poses(); ++i) {
      if (!(s.context[static_cast<std::size_t>(i)].order > move.after_row - 0.5)) continue;
      unwhiten(s, i, moved.segment(s.table.begin(i), s.table.count(i)));
      sum += moved(s.point_lines(i)).squaredNorm();
      ++behind;
    }
    move.size_m = std::sqrt(sum / std::max(1, behind));
  }
  return out;
}

void sharpen(const WhitenedFit& s, Eigen::Index poses, ChangePoint& point) {
  for (const MovingPart& moving : moving_parts(s.joints())) {
    const EffectEntry one = step_of(moving);
    if (one.joints != point.entry.joints ||
        text_option(one, OptionKey::kOf, "") != text_option(point.entry, OptionKey::kOf, ""))
      continue;
    CutSearch part(s, moving);
    std::vector<int> cuts;
    for (const double row : point.after_rows) {
      const auto at = std::partition_point(
          part.order().begin(), part.order().end(),
          [&](Eigen::Index pose) { return s.context[static_cast<std::size_t>(pose)].order < row; });
      cuts.push_back(static_cast<int>(at - part.order().begin()));
    }
    settle_near(part, cuts, static_cast<int>(poses));
    point = at_cuts(s, part, cuts);
    return;
  }
}

}  // namespace plumb::offline
