// SPDX-License-Identifier: Apache-2.0
#include "check/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "check/data_findings.hpp"
#include "check/data_sense.hpp"
#include "fit/calibrate.hpp"
#include "fit/parameter_subset.hpp"

namespace plumb::offline {
namespace {

constexpr double kFits = 0.01;         // of the cloud's size: no sensible arm leaves more
constexpr double kSmallShare = 0.5;    // of the joint limits: predictions beyond are guesses
constexpr double kFineRounding = 0.5;  // of the noise: no more than that goes unseen
constexpr double kEnough = 1.5;        // coordinates for each number
constexpr std::size_t kMostSentences = 4;
constexpr double kOneChange = 1.05;  // of the labels
constexpr int kPlacedRows = 300;

std::vector<int> used_rows(const Measurements& measured) {
  std::vector<int> rows;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.set[i] != SetMark::kIgnore) rows.push_back(i);
  return rows;
}

class Checker {
 public:
  Checker(const Cell& cell, const Measurements& measured) : cell_(cell), measured_(measured) {}

  Check check() {
    out_.detection = detect_convention(cell_, measured_);
    const Convention& labels = out_.detection.present.convention;
    const Convention& best = out_.detection.best.convention;
    out_.changes = in_words(cell_, labels, best);
    convention_findings();
    if (out_.detection.changed) {
      const Cell meant = read_as(cell_, labels, best);
      look(meant, read_as(measured_, cell_, labels, best));
    } else {
      look(cell_, measured_);
    }
    conclude();
    return std::move(out_);
  }

 private:
  void find(Severity severity, const char* code, std::string message, std::string help) {
    out_.findings.push_back({severity, code, std::move(message), std::nullopt, std::move(help)});
  }

  /// Problems of cell or data.
  void add(std::vector<Problem> more) {
    for (auto& problem : more) {
      if (problem.severity == Severity::kError) blame(Exit::kInput);
      out_.findings.push_back(std::move(problem));
    }
  }

  /// Wrong files weigh more than numbers that say no.
  void blame(Exit exit) {
    if (out_.exit != Exit::kInput) out_.exit = exit;
  }

  void convention_findings() {
    const Detection& d = out_.detection;
    if (!d.why_not.empty())
      return find(Severity::kNote, "N-CHECK-CONVENTION",
                  "conventions were not checked: " + d.why_not, "measure more poses");
    const bool fits = d.best.fitted_m <= kFits * d.best.size_m;
    if (d.changed || !fits) blame(Exit::kInput);
    if (d.changed)
      return find(Severity::kError, "E-CHECK-CONVENTION",
                  fmt::format("{}: that leaves {:.3g} mm, as labelled it is {:.4g} mm",
                              fmt::join(out_.changes, "; "), d.best.fitted_m * 1e3,
                              d.present.fitted_m * 1e3),
                  "plumb check --fix");
    for (const auto& other : d.same)
      if (other.changes < kOneChange)
        find(Severity::kNote, "N-CHECK-UNDECIDED",
             fmt::format("these points cannot tell whether {}",
                         fmt::join(in_words(cell_, d.present.convention, other.convention), "; ")),
             "mount the reflector further from the axis, or trust the label");
    if (!fits)
      find(
          Severity::kError, "E-CHECK-NOFIT",
          fmt::format("no reading of these files fits: as labelled {:.4g} mm are left, and none of "
                      "{} others explains the points",
                      d.best.fitted_m * 1e3, d.tried),
          "look for joints in another order, coupled joints, or rows of another arm");
  }

  /// Everything else, on the files as they are meant.
  void look(const Cell& cell, const Measurements& measured) {
    const std::vector<int> rows = used_rows(measured);
    add(copy_findings(measured));
    add(limit_findings(cell, measured));
    add(constant_findings(cell, measured));
    out_.floor = noise_floor(cell, measured);
    if (rows.empty()) return;
    out_.effects = testable_effects(cell, data_sense(cell, measured, rows));
    look_at_parameters(cell, measured, rows);
    const ArmState placed = out_.parameters
                                ? out_.parameters->calibration.state
                                : place_nominal(cell, measured, thinned(rows, kPlacedRows));
    out_.coverage = coverage(cell, measured, rows, placed);
    out_.rounding = joint_rounding(cell, measured, rows, placed);
    coverage_findings();
    rounding_findings();
    if (out_.floor.source == NoiseFloor::Source::kNone)
      find(Severity::kNote, "N-CHECK-NOISE", "nothing says how large the noise is",
           "measure some poses twice, or state [measurement] sigma_um");
  }

  void look_at_parameters(const Cell& cell, const Measurements& measured,
                          const std::vector<int>& rows) {
    try {
      out_.parameters = identifiability(cell, measured, rows);
    } catch (const Failure& failure) {
      out_.why_no_parameters = failure.problems().front().message;
      out_.findings.insert(out_.findings.end(), failure.problems().begin(),
                           failure.problems().end());
      blame(failure.exit_code());
      return;
    }
    add(outlier_findings(measured, out_.parameters->calibration.outliers));
    add(out_.parameters->calibration.remarks);
    separation_findings();
    poses_enough(measured);
    const auto& estimates = out_.parameters->calibration.estimates;
    const bool any =
        std::any_of(estimates.begin(), estimates.end(), [](const auto& e) { return e.of_robot; });
    if (any || cell.effects.empty() || cell.effects.front().name != "geometry") return;
    find(Severity::kError, "E-CHECK-NOTHING", "these poses tell nothing about the arm",
         "measure at least 30 poses all over the joint limits");
    blame(Exit::kNumbersSayNo);
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

  /// Each distinct pose gives its measured axes once; repeats give noise only.
  void poses_enough(const Measurements& measured) {
    int axes = measured.has_orientation() && cell_.measurement.sigma_rad ? 3 : 0;
    for (const bool has : measured.has_axis) axes += has ? 1 : 0;
    const std::set<int> groups(measured.replicate_group.begin(), measured.replicate_group.end());
    const int coordinates = axes * static_cast<int>(groups.size());
    const int needed = out_.parameters->rank_anywhere;
    if (coordinates > kEnough * needed) return;
    const bool too_few = coordinates <= needed;
    find(too_few ? Severity::kError : Severity::kWarning, too_few ? "E-CHECK-FEW" : "W-CHECK-FEW",
         fmt::format("{} poses give {} coordinates for {} numbers of arm, frame and target",
                     groups.size(), coordinates, needed),
         fmt::format("measure at least {} poses all over the joint limits",
                     std::max(30, 2 * needed / std::max(1, axes))));
    if (too_few) blame(Exit::kNumbersSayNo);
  }

  void coverage_findings() {
    std::vector<std::string> narrow;
    for (const auto& joint : out_.coverage->joints)
      if (joint.share < kSmallShare)
        narrow.push_back(fmt::format("{} ({:.0f} %)", joint.joint, 100.0 * joint.share));
    if (!narrow.empty())
      find(Severity::kWarning, "W-CHECK-COVERAGE",
           fmt::format("the poses use little of the limits of {}: predictions beyond are guesses",
                       fmt::join(narrow, ", ")),
           "measure where the arm will work, or narrow q = [min, max] in cell.toml");
  }

  void rounding_findings() {
    if (!out_.rounding || out_.floor.source == NoiseFloor::Source::kNone) return;
    if (out_.rounding->at_tool_m < kFineRounding * out_.floor.rms_m) return;
    find(
        Severity::kWarning, "W-CHECK-ROUNDED",
        fmt::format("the joint readings are rounded to {:g} {}: that is {:.3g} mm at the tool, the "
                    "noise is {:.3g} mm",
                    out_.rounding->step_in_unit, out_.rounding->unit,
                    out_.rounding->at_tool_m * 1e3, out_.floor.rms_m * 1e3),
        "record more digits; exact commanded values are no harm");
  }

  void conclude() {
    std::stable_sort(out_.findings.begin(), out_.findings.end(),
                     [](const Problem& a, const Problem& b) { return a.severity < b.severity; });
  }

  const Cell& cell_;
  const Measurements& measured_;
  Check out_;
};

int count(const Check& check, Severity severity) {
  return static_cast<int>(
      std::count_if(check.findings.begin(), check.findings.end(),
                    [&](const Problem& problem) { return problem.severity == severity; }));
}

}  // namespace

Check check_cell(const Cell& cell, const Measurements& measured) {
  return Checker(cell, measured).check();
}

std::string verdict(const Check& check) {
  const int warnings = count(check, Severity::kWarning);
  if (check.detection.changed)
    return fmt::format("Not usable as labelled: {} (plumb check --fix puts it right).",
                       fmt::join(check.changes, "; "));
  if (check.exit != Exit::kDone)
    return fmt::format("Not usable: {}.", check.findings.front().message);
  const int poses = check.coverage ? check.coverage->poses : 0;
  const int rank = check.parameters ? check.parameters->rank : 0;
  return fmt::format("Usable: the {} poses fit the labels to {:.3g} mm and tell {} numbers{}.",
                     poses, check.detection.best.fitted_m * 1e3, rank,
                     warnings == 0   ? ""
                     : warnings == 1 ? ", with one warning"
                                     : fmt::format(", with {} warnings", warnings));
}

}  // namespace plumb::offline
