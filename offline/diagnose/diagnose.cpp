// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "check/data_sense.hpp"
#include "diagnose/candidates.hpp"
#include "diagnose/confounding.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/forward.hpp"
#include "diagnose/model_parts.hpp"
#include "diagnose/refit.hpp"
#include "diagnose/verdict.hpp"
#include "fit/split.hpp"

namespace plumb::offline {
namespace {

constexpr double kFewestFreeLines = 20.0;
constexpr double kGross = 6.0;  // times the median error: no reading of this tracker

/// The cell without what is learnt: the tree comes after the physics.
Cell physics_of(Cell cell) {
  std::erase_if(cell.effects, [](const EffectEntry& e) { return e.name == "local_tree"; });
  return cell;
}

/// Predictions of poses that had no say.
class HeldOut {
 public:
  HeldOut(const Measurements& measured, const Split& split)
      : measured_(&measured), rows_(held_rows(split)), predicted_(measured.p_M) {}

  void put(const Calibration& calibration, const std::vector<int>& rows) {
    const Rows3 points = predict_points(calibration.state, pick(*measured_, rows));
    for (std::size_t i = 0; i < rows.size(); ++i)
      predicted_.row(rows[i]) = points.row(static_cast<Eigen::Index>(i));
  }
  std::vector<double> norms() const {
    const Rows3 error = residuals(*measured_, predicted_);
    std::vector<double> norms;
    for (int row : rows_) norms.push_back(error.row(row).norm());
    return norms;
  }
  ErrorStats stats() const { return summarise(norms()); }

  /// Mean without gross errors, which are the reading's and not the model's.
  double usual_mean() const {
    std::vector<double> all = norms();
    if (all.empty()) return 0.0;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    const double limit = kGross * *middle;
    std::erase_if(all, [limit](double norm) { return norm > limit; });
    return summarise(std::move(all)).mean;
  }

 private:
  const Measurements* measured_;
  std::vector<int> rows_;
  Rows3 predicted_;
};

/// All that a diagnosis works with.
struct Work {
  Cell cell;
  const Measurements& measured;
  Split split;
  std::vector<int> fit, held;  // held: for good, none with folds
  std::vector<Testable> testable;
  std::vector<std::string> not_testable;
  const DiagnosisRequest& request;

  ForwardStart start(const std::vector<int>& rows, bool quiet) const {
    return {cell, measured, rows, not_testable,
            quiet ? std::function<void(const std::string&)>() : request.tell};
  }
};

/// A list of effects, chosen beforehand, on poses that had no say.
HeldOut held_out_of(const Work& w, const std::vector<EffectEntry>& effects,
                    const Calibration& fitted) {
  HeldOut out(w.measured, w.split);
  if (w.split.folds == 0) out.put(fitted, w.held);
  for (int k = 0; k < w.split.folds; ++k)
    out.put(refitted(w.cell, w.measured, fit_rows(w.split, k), effects, fitted),
            held_rows(w.split, k));
  return out;
}

/// The whole selection once more around every fold.
HeldOut nested_held_out(const Work& w) {
  HeldOut out(w.measured, w.split);
  for (int k = 0; k < w.split.folds; ++k) {
    const auto inside = fit_rows(w.split, k);
    const Calibration base = calibrate(w.cell, w.measured, inside);
    const Stage stage =
        make_stage(w.cell, w.measured, base, without_outliers(inside, base.outliers), {});
    const Forward found =
        forward(w.start(inside, true), base, stage, scan(stage, w.not_testable, {}));
    out.put(found.steps.empty() ? base : found.steps.back().calibration, held_rows(w.split, k));
  }
  return out;
}

/// Against what a model with these many parameters cannot avoid.
std::optional<LeftOver> left_over_of(const Work& w, const HeldOut& held, const Calibration& fitted,
                                     const NoiseFloor& floor) {
  const double inside = w.split.folds > 0 ? 1.0 - 1.0 / w.split.folds : 1.0;
  const auto axes =
      static_cast<double>(std::count(w.measured.has_axis.begin(), w.measured.has_axis.end(), true));
  return left_over(held.usual_mean(), floor, inside * axes * static_cast<double>(w.fit.size()),
                   static_cast<double>(fitted.parameters.size()));
}

bool judgeable(const Stage& stage) {
  return static_cast<double>(stage.fit_lines - stage.rank) >= kFewestFreeLines;
}

Finding finding_of(const Scan& look, const Stage& stage, const Calibration& calibration) {
  if (!judgeable(stage)) return Finding::kUndecidable;
  const auto is_one = [&](const Found& f) {
    return !is_remainder(*stage.cell, stage, calibration, f);
  };
  if (look.unknown() && is_one(*look.pattern)) return Finding::kUnknown;
  if (look.supported(is_one) != nullptr) return Finding::kMissing;
  return stage.noise.known ? Finding::kComplete : Finding::kUndecidable;
}

void go_all_the_way(const Work& w, const Calibration& base, const Stage& stage, const Scan& first,
                    Diagnosis& out) {
  const Forward found = forward(w.start(w.fit, false), base, stage, first);
  std::optional<HeldOut> held;
  for (const auto& step : found.steps) {
    held = held_out_of(w, step.effects, step.calibration);
    out.added.push_back({step.entry, step.cycles, step.ln_bayes, held->stats()});
  }
  out.full = found.full;
  out.unlikely = found.unlikely;
  if (!found.steps.empty()) {
    out.effects = found.steps.back().effects;
    out.floor = noise_floor(w.cell, w.measured, found.steps.back().calibration.state);
  }
  if (w.split.folds > 0) {
    out.nested = true;
    held = nested_held_out(w);
  }
  if (held) {
    out.after = held->stats();
    out.left_over = left_over_of(
        w, *held, found.steps.empty() ? base : found.steps.back().calibration, out.floor);
  }
  out.finding_after = Finding::kComplete;
  if (found.unknown) {
    out.finding_after = Finding::kUnknown;
    out.unknown_after = found.unknown;
  } else if (!stage.noise.known || !judgeable(stage) || out.tied) {
    out.finding_after = Finding::kUndecidable;
  }
}

}  // namespace

Diagnosis diagnose(const Cell& cell, const Measurements& measured,
                   const DiagnosisRequest& request) {
  Work w{physics_of(cell),
         measured,
         split_poses(measured, cell.measurement.held_out, cell.measurement.seed),
         {},
         {},
         {},
         {},
         request};
  w.fit = fit_rows(w.split);
  if (w.split.folds == 0) w.held = held_rows(w.split);
  w.testable = testable_effects(w.cell, data_sense(w.cell, measured, w.fit));
  Diagnosis out;
  for (const auto& answer : w.testable)
    if (answer.answer == Testable::Answer::kNo) {
      out.not_testable.push_back(answer);
      w.not_testable.push_back(answer.effect);
    }
  const Calibration base = calibrate(w.cell, measured, w.fit);
  const auto rows = without_outliers(w.fit, base.outliers);
  const Stage stage = make_stage(w.cell, measured, base, rows, w.held);
  const Scan first = scan(stage, w.not_testable, {});
  out.floor = noise_floor(w.cell, measured, base.state);
  out.poses_fit = static_cast<int>(w.fit.size());
  out.poses_held = static_cast<int>(held_rows(w.split).size());
  out.blocks = first.blocks;
  for (const auto& outlier : base.outliers) out.outliers.push_back(measured.pose[outlier.row]);
  out.finding = finding_of(first, stage, base);
  out.candidates = candidates_of(stage, first);
  if (const Found* other =
          out.finding == Finding::kMissing ? tied_with_first(stage, first) : nullptr) {
    out.finding = Finding::kUndecidable;
    out.tied = other->entry;
  }
  if (out.finding == Finding::kUnknown) out.unknown = unknown_structure(stage, *first.pattern);
  const HeldOut held = held_out_of(w, w.cell.effects, base);
  out.before = out.after = held.stats();
  out.left_over = left_over_of(w, held, base, out.floor);
  out.effects = w.cell.effects;
  if (request.apply) go_all_the_way(w, base, stage, first, out);
  out.text = verdict_text(w.cell, out);
  out.text_after = verdict_after_text(w.cell, out);
  return out;
}

}  // namespace plumb::offline
