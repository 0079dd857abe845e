// SPDX-License-Identifier: Apache-2.0
#include "check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "arm/predicted_points.hpp"
#include "cell/earlier_arm.hpp"
#include "cell/setups.hpp"
#include "check/common_scale.hpp"
#include "check/constants.hpp"
#include "check/contradiction.hpp"
#include "check/copies.hpp"
#include "check/data_findings.hpp"
#include "check/data_sense.hpp"
#include "check/effect_sense.hpp"
#include "check/given_frame.hpp"
#include "check/gravity_sense.hpp"
#include "check/moved_part.hpp"
#include "check/row_faults.hpp"
#include "check/row_pattern.hpp"
#include "check/setup_sharing.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "fit/few_poses.hpp"
#include "fit/orientation_words.hpp"
#include "noise/main_jump.hpp"
#include "program/counted_words.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// More warnings of one code than these are told in a single sentence.
constexpr std::size_t kMostSentences = 4;

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
    convention_findings();
    other_setups();
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
  void find(Severity severity, const char* code, std::string message, std::string help) {
    out_.findings.push_back({severity, code, std::move(message), std::nullopt, std::move(help)});
  }

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

  /// An exit code for wrong input is never replaced by one for poor results.
  void blame(Exit exit) {
    if (out_.exit != Exit::kInput) out_.exit = exit;
  }

  void convention_findings() {
    const Detection& d = out_.detection;
    if (!d.why_not.empty())
      return find(Severity::kNote, "N-CHECK-CONVENTION",
                  "conventions were not checked: " + d.why_not, "measure more poses");
    if (d.changed) blame(Exit::kInput);
    if (d.changed)
      return find(Severity::kError, "E-CHECK-CONVENTION",
                  fmt::format("{}: that leaves {:.3g} mm, as labelled it is {:.4g} mm",
                              fmt::join(out_.changes, "; "), d.best.fitted_m * 1e3,
                              d.present.fitted_m * 1e3),
                  "plumb check --fix");
    for (const auto& other : d.same)
      if (other.changes < check::kOneChange)
        find(Severity::kNote, "N-CHECK-UNDECIDED",
             fmt::format("these points cannot tell whether {}",
                         fmt::join(in_words(cell_, d.present.convention, other.convention), "; ")),
             "mount the reflector further from the axis, or trust the label");
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

  /// The convention was searched for in one set-up only; checks whether the files of the other
  /// set-ups need the same one.
  void other_setups() {
    if (measured_.setup.empty() || out_.detection.changed) return;
    const int seen = largest_setup(cell_, measured_);
    for (int k = 0; k < setup_count(cell_.measurement); ++k) {
      if (k == seen) continue;
      const OneSetup one = one_setup(cell_, measured_, k);
      const Detection found = detect_convention(one.cell, one.measured);
      if (!found.why_not.empty() || !found.changed) continue;
      const auto words = in_words(one.cell, found.present.convention, found.best.convention);
      blame(Exit::kInput);
      find(Severity::kError, "E-CHECK-CONVENTION",
           fmt::format("set-up '{}': {}: that leaves {:.3g} mm, as labelled it is {:.4g} mm",
                       setup_name(cell_.measurement, k), fmt::join(words, "; "),
                       found.best.fitted_m * 1e3, found.present.fitted_m * 1e3),
           "the other set-ups fit as labelled: put the files of this one right");
    }
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
    coverage_findings();
    rounding_findings(measured, rows, placed);
    reading_findings(cell, measured, rows, placed);
    if (out_.floor.source == NoiseFloor::Source::kNone)
      find(Severity::kNote, "N-CHECK-NOISE", "nothing says how large the noise is",
           "measure some poses twice, or state [measurement] sigma_um");
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
    separation_findings();
    poses_enough(measured);
    split_enough(measured);
    const auto& estimates = out_.parameters->calibration.estimates;
    const bool any =
        std::any_of(estimates.begin(), estimates.end(), [](const auto& e) { return e.of_robot; });
    if (any || cell.effects.empty() || !is_geometry(cell.effects.front().name)) return;
    find(Severity::kWarning, "W-CHECK-NOTHING",
         "these poses tell no number of the arm: where the tracker's frame and the reflector are "
         "explains all that they show",
         cell.joints() == 1
             ? "a single joint shows no more through one point; the points fit the nominal arm"
             : "if the arm's own numbers are wanted, move all joints: plumb plan --n 30");
  }

  void separation_findings() {
    std::vector<std::string> names, texts;
    for (const auto& s : out_.parameters->separations)
      if (s.cause == Separation::Cause::kPoses) {
        names.push_back(s.parameter);
        texts.push_back(s.text);
      }
    if (names.size() > kMostSentences)
      texts = {fmt::format("these poses tell too little of {}", fmt::join(names, ", "))};
    for (auto& text : texts)
      find(Severity::kWarning, "W-CHECK-SEPARATE", std::move(text),
           "plumb explain W-CHECK-SEPARATE");
  }

  /// Finds what `fit` would refuse: without the held-out poses too few may remain to be fitted.
  void split_enough(const MeasurementFiles& measured) {
    if (out_.exit != Exit::kDone) return;
    try {
      const Split split = split_poses(measured, cell_.measurement.held_out, cell_.measurement.seed);
      const std::size_t readings = fewest_fitted(split);
      const auto numbers = static_cast<std::size_t>(open_of(out_.parameters->rank));
      if (axes_of(measured) * readings > numbers) return;
      find(Severity::kError, "E-CHECK-FEW",
           fmt::format("{} too few to hold some of them out: {} left to fit and give {} "
                       "coordinates for {} numbers of arm, frame and target",
                       counted_words(measured.size(), "reading is", "readings are"),
                       counted_words(static_cast<long long>(readings), "of them is", "of them are"),
                       axes_of(measured) * readings, numbers),
           "measure at least 30 poses all over the joint limits");
    } catch (const Failure& failure) {
      for (const Problem& problem : failure.problems()) out_.findings.push_back(problem);
      return blame(failure.exit_code());
    }
    blame(Exit::kNumbersSayNo);
  }

  /// How many numbers one measurement gives: its measured coordinates, and three for an
  /// orientation.
  std::size_t axes_of(const MeasurementFiles& measured) const {
    std::size_t out = measured.has_orientation() && cell_.measurement.sigma_rad ? 3 : 0;
    for (const bool has : measured.has_axis) out += has ? 1 : 0;
    return out;
  }

  /// How many of `numbers` unknowns are not known from an earlier run. The six of the frame never
  /// are.
  int open_of(int numbers) const {
    if (!cell_.fit.earlier) return numbers;
    const int known = static_cast<int>(cell_.fit.earlier->numbers.size());
    return std::max(std::min(numbers, check::kFrameNumbers), numbers - known);
  }

  /// Each distinct pose gives its measured axes once; repeats give noise only.
  void poses_enough(const MeasurementFiles& measured) {
    const int axes = static_cast<int>(axes_of(measured));
    const std::set<int> groups(measured.replicate_group.begin(), measured.replicate_group.end());
    const int coordinates = axes * static_cast<int>(groups.size());
    int needed = out_.parameters->rank_anywhere;
    for (const auto& p : out_.parameters->calibration.parameters) needed += p.of_effect() ? 1 : 0;
    needed = open_of(needed);
    if (coordinates > check::kCoordinatesEach * needed) return;
    const bool too_few = coordinates <= needed;
    find(too_few ? Severity::kError : Severity::kWarning, too_few ? "E-CHECK-FEW" : "W-CHECK-FEW",
         fmt::format(
             "{} {} coordinates for {} numbers of arm, frame and target{}",
             counted_words(static_cast<long long>(groups.size()), "pose gives", "poses give"),
             coordinates, needed, needed > out_.parameters->rank_anywhere ? " and effects" : ""),
         fmt::format(
             "measure at least {} poses all over the joint limits",
             std::max(check::kAdvisedPoses, check::kAdvisedTimes * needed / std::max(1, axes))));
    if (too_few) blame(Exit::kNumbersSayNo);
  }

  void coverage_findings() {
    std::vector<std::string> narrow;
    for (const auto& joint : out_.coverage->joints)
      if (joint.share < check::kLittleOfLimits)
        narrow.push_back(fmt::format("{} ({:.0f} %)", joint.joint, 100.0 * joint.share));
    if (!narrow.empty())
      find(Severity::kWarning, "W-CHECK-COVERAGE",
           fmt::format("the poses use little of the limits of {}: predictions beyond are guesses",
                       fmt::join(narrow, ", ")),
           "measure where the arm will work, or narrow q = [min, max] in cell.toml");
  }

  /// Rounded joint readings leave at least about their own error. If less is left, the arm was
  /// commanded to round values. If the noise is unknown, the two must be of similar size.
  void rounding_findings(const MeasurementFiles& measured, const std::vector<int>& rows,
                         const ArmState& placed) {
    if (!out_.rounding) return;
    const bool known = out_.floor.source != NoiseFloor::Source::kNone;
    const double rounded = out_.rounding->at_tool_m, left = left_by_fit(measured, rows, placed);
    if (known ? rounded < check::kRoundingSeen * out_.floor.rms_m
              : rounded < check::kCoarseRounding_m)
      return;
    if (out_.parameters && left < check::kRoundingLeft * rounded) return;
    if (!known && (!out_.parameters || left > rounded / check::kRoundingLeft)) return;
    find(Severity::kWarning, "W-CHECK-ROUNDED",
         fmt::format("the joint readings are rounded to {:g} {}: that is {:.3g} mm at the tool, {} "
                     "{:.3g} mm",
                     out_.rounding->step_in_unit, out_.rounding->unit, rounded * 1e3,
                     known ? "the noise is" : "and the fit leaves",
                     (known ? out_.floor.rms_m : left) * 1e3),
         "record more digits; exact commanded values are no harm");
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

  /// Checks of the readings themselves, and of the direction of gravity.
  void reading_findings(const Cell& cell, const MeasurementFiles& measured,
                        const std::vector<int>& rows, const ArmState& placed) {
    add(sharing_findings(cell, measured, rows));
    repeat_findings(cell);
    add(option_findings(cell));
    std::string cause = row_findings(cell, measured, rows, placed);
    if (cause.empty()) cause = gross_findings();
    if (cause.empty()) cause = moved_findings(cell, measured, rows, placed);
    auto pattern = out_.parameters && cause.empty() ? pattern_findings(measured, rows, placed)
                                                    : std::vector<Problem>{};
    // A repeating pattern of wrong rows also is a part that contradicts the rest; the pattern says
    // more about its cause.
    if (cause.empty() && pattern.empty())
      cause = contradiction_findings(cell, measured, rows, placed);
    add(std::move(pattern));
    if (!cause.empty())
      for (Problem& problem : out_.findings) name_cause(problem, cause);
    if (!out_.parameters) return;
    if (cause.empty()) add(scale_findings(measured, rows, out_.parameters->calibration));
    add(gravity_findings(cell, measured, rows, out_.parameters->calibration));
    add(effect_size_findings(cell, measured, rows, placed));
  }

  /// Reports repeats that scatter by far more or far less than the stated noise.
  void repeat_findings(const Cell& cell) {
    const auto& stated = cell.measurement.sigma_m;
    if (out_.floor.source != NoiseFloor::Source::kRepeats || !stated) return;
    const bool more = out_.floor.sigma_m >= check::kNoiseOtherwise * *stated;
    const bool less = out_.floor.sigma_m * check::kNoiseOtherwise <= *stated;
    if (!more && !less) return;
    find(Severity::kWarning, "W-CHECK-REPEATS",
         fmt::format("repeats of a pose scatter by {:.3g} mm an axis (1 sigma), but sigma_um says "
                     "{:.3g} mm",
                     out_.floor.sigma_m * 1e3, *stated * 1e3),
         more ? "are rows of one name the same pose, reached alike? else correct sigma_um"
              : "correct sigma_um: with one that is too large effects go unseen");
  }

  /// Finds rows with one common fault, such as another unit. They replace the outliers, of which
  /// they are a part or all. Returns the cause in words; empty if there is none.
  std::string row_findings(const Cell& cell, const MeasurementFiles& measured,
                           const std::vector<int>& rows, const ArmState& placed) {
    if (out_.detection.changed) return "";
    auto found = row_fault_findings(cell, measured, rows, placed);
    if (found.empty()) return "";
    std::erase_if(out_.findings, [](const Problem& p) { return p.code == "W-CHECK-OUTLIER"; });
    add(std::move(found));
    return "some rows were written otherwise than the rest, see W-CHECK-ROWS";
  }

  /// Finds the moment at which tracker, base or tool moved, unless W-CHECK-SAME has said that they
  /// did. Returns the cause in words; empty if nothing moved.
  std::string moved_findings(const Cell& cell, const MeasurementFiles& measured,
                             const std::vector<int>& rows, const ArmState& placed) {
    if (out_.detection.changed ||
        std::any_of(out_.findings.begin(), out_.findings.end(),
                    [](const Problem& p) { return p.code == "W-CHECK-SAME"; }))
      return "";
    auto found = moved_part(cell, measured,
                            not_outliers(thinned(measured, rows, kRowsSearchedForJump)), placed);
    if (!found) return "";
    out_.moved = std::move(found->words);
    add({std::move(found->finding)});
    return out_.moved + ", see W-CHECK-MOVED";
  }

  /// Returns in words what explains that no interpretation fits; empty if nothing does.
  std::string gross_findings() {
    if (!gross_scale_) return "";
    add({gross_scale_->finding});
    return "one common factor on all points would, see W-CHECK-SCALE";
  }

  std::string contradiction_findings(const Cell& cell, const MeasurementFiles& measured,
                                     const std::vector<int>& rows, const ArmState& placed) {
    auto found = contradiction(cell, measured, not_outliers(rows), placed);
    if (!found) return "";
    std::erase_if(out_.findings, [](const Problem& p) { return p.code == "W-CHECK-OUTLIER"; });
    add({std::move(*found)});
    return "a part of the readings contradicts the rest, see W-CHECK-CONTRADICT";
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

int count(const Check& check, Severity severity) {
  return static_cast<int>(
      std::count_if(check.findings.begin(), check.findings.end(),
                    [&](const Problem& problem) { return problem.severity == severity; }));
}

}  // namespace

Check check_cell(const Cell& cell, const MeasurementFiles& measured) {
  return Checker(cell, measured).check();
}

bool can_be_fixed(const Check& check) {
  return check.detection.changed || !check.orientations.edit.empty();
}

std::string verdict(const Check& check) {
  const int warnings = count(check, Severity::kWarning);
  if (check.detection.changed || check.orientations.stops()) {
    std::vector<std::string> wrong = check.changes;
    if (check.orientations.stops())
      wrong.push_back(in_words(check.orientations.judged, check.orientations.meant));
    return fmt::format("Not usable as labelled: {} (plumb check --fix puts it right).",
                       fmt::join(wrong, "; "));
  }
  if (check.exit != Exit::kDone)
    return fmt::format("Not usable: {}.", check.findings.front().message);
  const int poses = check.coverage ? check.coverage->poses : 0;
  const int rank = check.parameters ? check.parameters->rank : 0;
  const bool has_effects =
      check.parameters && !check.parameters->calibration.state.arm.effects.empty();
  const std::string fit =
      check.detection.why_not.empty()
          ? fmt::format("fit the labels to {:.3g} mm{} and", check.detection.best.fitted_m * 1e3,
                        has_effects ? " with geometry alone" : "")
          : "cannot show whether the labels are right, but";
  const std::string numbers = fmt::format(
      "the {} {} tell {} of arm, frame and target{}.", counted_words(poses, "pose", "poses"), fit,
      counted_words(rank, "number", "numbers"),
      warnings == 0 ? "" : ", with " + counted_words(warnings, "warning", "warnings"));
  if (check.moved.empty() && !check.orientations.judged.fit_to_use())
    return fmt::format("Usable for positions alone: {}. Without the orientations {}",
                       in_words(check.orientations.judged, check.orientations.meant), numbers);
  if (check.moved.empty()) return "Usable: " + numbers;
  return fmt::format("Usable only with the effect '{}', because {}. Without that effect {}",
                     change_point_effect(), check.moved, numbers);
}

}  // namespace plumb::offline
