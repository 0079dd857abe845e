// SPDX-License-Identifier: Apache-2.0
#include "check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "arm/predicted_points.hpp"
#include "check/common_scale.hpp"
#include "check/constants.hpp"
#include "check/convention_findings.hpp"
#include "check/copies.hpp"
#include "check/data_findings.hpp"
#include "check/data_sense.hpp"
#include "check/effect_sense.hpp"
#include "check/error_cause.hpp"
#include "check/given_frame.hpp"
#include "check/gravity_sense.hpp"
#include "check/identifiability_findings.hpp"
#include "check/setup_sharing.hpp"
#include "fit/calibrate.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

std::vector<int> used_rows(const MeasurementFiles& measured) {
  std::vector<int> rows;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.set[i] != SetMark::kIgnore) rows.push_back(i);
  return rows;
}

class Checker {
 public:
  Checker(const Cell& cell, const MeasurementFiles& measured)
      : given_(cell), cell_(cell), measured_(measured) {
    judge_orientations_of(cell, measured);
  }

  Check check() {
    out_.detection = detect_convention(cell_, measured_);
    const Convention& labels = out_.detection.present.convention;
    const Convention& best = out_.detection.best.convention;
    out_.changes = in_words(cell_, labels, best);
    add(convention_findings(cell_, out_.detection));
    if (!out_.detection.changed) add(other_setup_findings(cell_, measured_));
    if (out_.detection.changed) {
      const MeasurementFiles files = read_as(measured_, cell_, labels, best);
      judge_orientations_of(read_as(given_, labels, best), files);
      orientation_findings();
      look(cell_, files);
    } else {
      orientation_findings();
      look(cell_, measured_);
    }
    conclude();
    return std::move(out_);
  }

 private:
  /// Judges the orientations first: whatever follows uses only those that were found sound.
  void judge_orientations_of(const Cell& cell, const MeasurementFiles& measured) {
    out_.orientations = check_orientations(cell, measured);
    cell_ = with_orientations_as_judged(cell, out_.orientations.judged);
  }

  void orientation_findings() {
    if (auto finding = orientation_finding(out_.orientations)) add({*std::move(finding)});
  }

  /// Adds problems of the cell file or the data to the findings; an error decides the exit code.
  void add(std::vector<Problem> more) {
    for (auto& problem : more) {
      if (problem.severity == Severity::kError) blame(Exit::kInput);
      out_.findings.push_back(std::move(problem));
    }
  }

  void add(std::optional<Problem> one, Exit if_error) {
    if (!one) return;
    if (one->severity == Severity::kError) blame(if_error);
    out_.findings.push_back(std::move(*one));
  }

  /// An exit code for wrong input is never replaced by one for poor results.
  void blame(Exit exit) {
    if (out_.exit != Exit::kInput) out_.exit = exit;
  }

  /// Reports an error if no interpretation of the files fits. The convention search keeps the arm
  /// near nominal and the full fit does not: if the full fit succeeds with the lengths as labelled,
  /// the interpretation is right, and W-FIT-FAR says how far from nominal the arm is.
  void interpretation_fits(const Cell& cell, const MeasurementFiles& measured,
                           const std::vector<int>& rows) {
    Detection& d = out_.detection;
    const double most = check::kFits * d.best.size_m;
    if (!d.why_not.empty() || d.changed || d.best.fitted_m <= most) return;
    gross_scale_ = gross_scale(cell, measured, rows, d);
    // A full fit of all lengths can absorb a wrong unit, which must still be reported. Any other
    // common factor explains less than lengths that change one by one.
    if (out_.parameters && !(gross_scale_ && gross_scale_->is_unit)) {
      const double left = left_by_fit(measured, rows, out_.parameters->calibration.state);
      if (left <= most) {
        gross_scale_.reset();
        return fits_by(left);
      }
    }
    blame(Exit::kInput);
    out_.findings.insert(
        out_.findings.begin(),
        {Severity::kError, "E-CHECK-NOFIT",
         fmt::format("no reading of these files fits: as labelled {:.4g} mm are left, and none of "
                     "{} others explains the points",
                     d.best.fitted_m * 1e3, d.tried),
         std::nullopt, "look for joints in another order, coupled joints, or rows of another arm"});
  }

  /// Notes the RMS error [m] that a full fit leaves with the files read as labelled.
  void fits_by(double left_m) {
    Detection& d = out_.detection;
    for (Interpretation& one : d.table)
      if (one.convention == d.best.convention) one.fitted_m = left_m;
    d.best.fitted_m = d.present.fitted_m = left_m;
  }

  /// All further checks, on the files in the convention that was found.
  void look(const Cell& given, const MeasurementFiles& measured) {
    const std::vector<int> rows = used_rows(measured);
    Cell cell = given;
    if (auto fault = frame_fault(given, measured, rows)) {
      blame(Exit::kInput);
      out_.findings.push_back(std::move(*fault));
      cell.measurement.fit_frame = true;  // so that the arm is not blamed for it
    }
    out_.floor = noise_floor(cell, measured);
    add(equal_pose_findings(measured));
    add(copy_findings(measured, out_.floor));
    add(limit_findings(cell, measured));
    add(constant_findings(cell, measured));
    if (rows.empty()) return;
    out_.effects = testable_effects(data_sense(cell, measured, rows));
    look_at_parameters(cell, measured, rows);
    interpretation_fits(cell, measured, rows);
    const ArmState placed =
        out_.parameters
            ? out_.parameters->calibration.state
            : place_nominal(cell, measured, thinned(measured, rows, check::kPredictedRows));
    out_.coverage = coverage(cell, measured, rows, placed);
    out_.rounding = joint_rounding(cell, measured, rows, placed);
    add(coarse_points(measured, out_.floor));
    add(coverage_findings(*out_.coverage));
    if (out_.rounding)
      add(rounding_findings(*out_.rounding, out_.floor, left_if_fitted(measured, rows, placed)));
    reading_findings(cell, measured, rows, placed);
    if (out_.floor.source == NoiseFloor::Source::kNone)
      add({{Severity::kNote, "N-CHECK-NOISE", "nothing says how large the noise is", std::nullopt,
            "measure some poses twice, or state [measurement] sigma_um"}});
  }

  std::optional<Problem> frame_fault(const Cell& cell, const MeasurementFiles& measured,
                                     const std::vector<int>& rows) const {
    if (!out_.detection.why_not.empty() || out_.detection.changed) return std::nullopt;
    return given_frame_fault(cell, measured, thinned(measured, rows, check::kPredictedRows));
  }

  void look_at_parameters(const Cell& cell, const MeasurementFiles& measured,
                          const std::vector<int>& rows) {
    try {
      out_.parameters = identifiability(cell, measured, rows);
    } catch (const Failure& failure) {
      out_.why_no_parameters = failure.problems().front().message;
      for (Problem problem : failure.problems()) {
        // The user has just run `plumb check`: advice to run it would not help.
        if (problem.help.find("plumb check") != std::string::npos)
          problem.help =
              out_.detection.changed || problem.code != "E-FIT-CONVERGE"
                  ? "look for joints in another order, coupled joints, a wrong DH table, "
                    "or rows of another arm"
                  : "measure poses all over the joint limits: plumb plan --n 30";
        out_.findings.push_back(std::move(problem));
      }
      blame(failure.exit_code());
      return;
    }
    add(outlier_findings(measured, out_.parameters->calibration));
    add(out_.parameters->calibration.remarks);
    const IdentifiabilityReport& report = *out_.parameters;
    add(separation_findings(report));
    add(few_poses(cell_, measured, report), Exit::kNumbersSayNo);
    if (out_.exit == Exit::kDone) split_enough(measured);
    add(nothing_told(cell, report), Exit::kDone);
  }

  /// Finds what `fit` would refuse, a wrong rule of what is held out included.
  void split_enough(const MeasurementFiles& measured) {
    try {
      add(few_left_to_fit(cell_, measured, *out_.parameters), Exit::kNumbersSayNo);
    } catch (const Failure& failure) {
      for (const Problem& problem : failure.problems()) out_.findings.push_back(problem);
      blame(failure.exit_code());
    }
  }

  /// `rows` without the outliers of the fit, if there was one.
  std::vector<int> not_outliers(const std::vector<int>& rows) const {
    return out_.parameters ? without_outliers(rows, out_.parameters->calibration.outliers) : rows;
  }

  /// RMS 3-D error [m] of the rows that are no outliers.
  double left_by_fit(const MeasurementFiles& measured, const std::vector<int>& rows,
                     const ArmState& placed) const {
    const Measurements some =
        pick(measured, thinned(measured, not_outliers(rows), check::kPredictedRows));
    return std::sqrt(residuals(some, predict_points(placed, some)).squaredNorm() /
                     static_cast<double>(some.size()));
  }

  std::optional<double> left_if_fitted(const MeasurementFiles& measured,
                                       const std::vector<int>& rows, const ArmState& placed) const {
    if (!out_.parameters) return std::nullopt;
    return left_by_fit(measured, rows, placed);
  }

  /// Checks of the readings themselves, and of the direction of gravity.
  void reading_findings(const Cell& cell, const MeasurementFiles& measured,
                        const std::vector<int>& rows, const ArmState& placed) {
    add(sharing_findings(cell, measured, rows));
    add(repeat_findings(cell, out_.floor));
    add(option_findings(cell));
    const ErrorCause cause = error_cause(
        cell, measured, rows,
        {.placed = placed,
         .fit = out_.parameters ? &out_.parameters->calibration : nullptr,
         .scale = gross_scale_,
         .otherwise_meant = out_.detection.changed,
         .setups_moved = std::any_of(out_.findings.begin(), out_.findings.end(),
                                     [](const Problem& p) { return p.code == "W-CHECK-SAME"; })});
    if (cause.explains_outliers)
      std::erase_if(out_.findings, [](const Problem& p) { return p.code == "W-CHECK-OUTLIER"; });
    add(cause.findings);
    out_.moved = cause.moved;
    if (!cause.words.empty())
      for (Problem& problem : out_.findings) name_cause(problem, cause.words);
    if (!out_.parameters) return;
    if (cause.words.empty()) add(scale_findings(measured, rows, out_.parameters->calibration));
    add(gravity_findings(cell, measured, rows, out_.parameters->calibration));
    add(effect_size_findings(cell, measured, rows, placed));
  }

  /// Adds the cause that was found to the messages about large errors of the fit.
  void name_cause(Problem& problem, const std::string& cause) const {
    if (problem.code == "E-CHECK-NOFIT")
      problem.message =
          fmt::format("no reading of these files fits: as labelled {:.4g} mm are left; {}",
                      out_.detection.best.fitted_m * 1e3, cause);
    else if (problem.code != "E-FIT-MISS" && problem.code != "E-FIT-FAR")
      return;
    problem.help = "correct what the warning names, and run plumb check again";
  }

  void conclude() {
    std::stable_sort(out_.findings.begin(), out_.findings.end(),
                     [](const Problem& a, const Problem& b) { return a.severity < b.severity; });
  }

  const Cell& given_;
  Cell cell_;  // with orientations as judged
  const MeasurementFiles& measured_;
  std::optional<GrossScale> gross_scale_;
  Check out_;
};

}  // namespace

Check check_cell(const Cell& cell, const MeasurementFiles& measured) {
  return Checker(cell, measured).check();
}

}  // namespace plumb::offline
