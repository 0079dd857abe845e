// SPDX-License-Identifier: Apache-2.0
#include "check/convention_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "arm/parameter.hpp"
#include "cell/random.hpp"
#include "cell/setups.hpp"
#include "check/constants.hpp"
#include "check/convention_candidate.hpp"
#include "check/convention_sweep.hpp"
#include "check/given_frame.hpp"
#include "check/interpreted_cells.hpp"
#include "check/map_convention.hpp"
#include "check/unit_guess.hpp"
#include "plumb/runtime/chain.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline {
namespace {

std::vector<int> random_rows(const Measurements& measured, int most) {
  std::vector<int> rows;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.set[i] != SetMark::kIgnore) rows.push_back(i);
  Random random(1);
  for (int i = 0; i + 1 < static_cast<int>(rows.size()) && i < most; ++i)
    std::swap(rows[i], rows[i + random.below(static_cast<int>(rows.size()) - i)]);
  if (static_cast<int>(rows.size()) > most) rows.resize(most);
  return rows;
}

/// Why no convention can be told from these measurements; empty if one can. few: rows to look at.
std::string why_none_can_be_told(const Measurements& measured, std::size_t few) {
  const auto axes = std::count(measured.has_axis.begin(), measured.has_axis.end(), true);
  const auto spread = [](const auto& columns) {
    return (columns.rowwise() - columns.colwise().mean().eval()).norm();
  };
  if (static_cast<int>(few) < check::kFewestPoses)
    return fmt::format("{} too few to tell conventions apart: {} are needed",
                       counted_words(static_cast<long long>(few), "pose is", "poses are"),
                       check::kFewestPoses);
  if (axes < 2) return "one measured axis is too little to tell conventions apart";
  if (!(spread(measured.q) > 0.0)) return "every row has the same joint positions";
  if (!(spread(measured.p_M) > 0.0)) return "every row has the same measured point";
  return "";
}

void sort_by_fit(std::vector<Interpretation>& all) {
  std::stable_sort(all.begin(), all.end(), [](const Interpretation& a, const Interpretation& b) {
    return a.fitted_share() < b.fitted_share();
  });
}

/// The one nearest to the labels among those that fit about as well as the best.
const Interpretation& simplest_of_best(const std::vector<Interpretation>& sorted) {
  const double most = check::kAlike * sorted.front().fitted_share();
  const Interpretation* out = &sorted.front();
  for (const Interpretation& one : sorted)
    if (one.fitted_share() <= most && one.changes < out->changes - 1e-9) out = &one;
  return *out;
}

class ConventionSearch {
 public:
  /// few, some: rows for the sweeps, and for the fits of what these leave.
  ConventionSearch(const Cell& cell, const Measurements& measured, Convention labels,
                   const std::vector<int>& few, std::vector<int> some)
      : cell_(cell),
        measured_(measured),
        labels_(std::move(labels)),
        some_rows_(std::move(some)),
        few_(pick(measured, few)),
        some_(pick(measured, some_rows_)),
        cells_(cell, labels_),
        sweep_(cell, few_, labels_, cells_, out_.tried),
        fitter_(cell, some_, labels_, cells_) {}

  Detection work() {
    judge(sweep_.units(0));
    if (nothing_fits()) judge(sweep_.units(2));
    if (nothing_fits() && enough_poses()) judge(sweep_.orders());
    seek_coupling();
    if (nothing_fits() && enough_poses()) judge_joint_maps();
    conclude();
    return std::move(out_);
  }

 private:
  bool nothing_fits() const { return out_.best.fitted_share() > check::kFits; }
  /// Whether there are enough poses for searches with hundreds of alternatives, such as joints in
  /// another order or a factor for each joint.
  bool enough_poses() const { return few_.size() >= check::kFewestForMany; }

  /// The largest RMS error [m] that a correctly interpreted and fitted arm may leave.
  double reasonable() const {
    return check::kReasonable_m + check::kReasonableShare * out_.present.size_m;
  }

  /// Tries the couplings of joints that controllers have. If nothing fits, also together with one
  /// zero changed by a quarter turn, and the couplings of neighbours with the columns in another
  /// order. A wrist whose reflector is near its axis fits within a hundredth of the cloud even
  /// without its coupling; therefore couplings are tried whenever more is left than a fitted arm
  /// leaves.
  void seek_coupling() {
    if (out_.best.fitted_m <= reasonable()) return;
    judge_couplings(sweep_.couplings(0));
    if (nothing_fits()) judge_couplings(sweep_.couplings(1));
    if (nothing_fits() && enough_poses()) judge_couplings(sweep_.coupled_orders());
  }

  /// Keeps what was found before unless a coupling leaves much less.
  void judge_couplings(std::vector<ConventionLead> leads) {
    const Detection before = out_;
    judge(std::move(leads));
    const bool clearly = out_.best.convention.coupling != labels_.coupling &&
                         check::kClearly * out_.best.fitted_share() < before.best.fitted_share();
    if (!clearly) out_ = before;
  }

  /// Fits the best of the leads and the files as labelled, and chooses among them.
  void judge(std::vector<ConventionLead> leads) {
    std::vector<ConventionCandidate> all{fitter_.as_labelled(placement_as_labelled(leads))};
    std::sort(leads.begin(), leads.end(), [](const ConventionLead& a, const ConventionLead& b) {
      return a.loose.misfit < b.loose.misfit;
    });
    const bool flat = std::count(measured_.has_axis.begin(), measured_.has_axis.end(), true) < 3;
    for (const ConventionLead& lead : leads) {
      ConventionCandidate candidate = fitter_.placed(lead, lead.loose.left_handed && !flat);
      if (candidate.interpretation.convention != labels_) all.push_back(std::move(candidate));
    }
    std::stable_sort(all.begin() + 1, all.end(),
                     [](const ConventionCandidate& a, const ConventionCandidate& b) {
                       return a.interpretation.placed_share() < b.interpretation.placed_share();
                     });
    if (all.size() > check::kFittedLeads + 1) all.resize(check::kFittedLeads + 1);
    for (auto& candidate : all) fitter_.fit(candidate);
    out_.present = all.front().interpretation;
    out_.table.clear();
    for (const auto& candidate : all) out_.table.push_back(candidate.interpretation);
    choose();
  }

  /// That of the lead with the labels, if the sweep kept it.
  LinearPlacement placement_as_labelled(const std::vector<ConventionLead>& leads) const {
    LinearPlacement out;
    for (const ConventionLead& lead : leads)
      if (lead.convention == labels_ && (lead.slide_ratio == 1.0 || lead.slide_ratio == 0.0))
        out = lead.loose;
    if (out.ratio != 0.0) return out;
    LinearPlacer placer(few_.p_M, few_.has_axis);
    const Chain chain(cell_.nominal);
    std::vector<Transformd> X_BT;
    for (int i = 0; i < few_.size(); ++i)
      X_BT.push_back(
          chain.forward({few_.q.row(i).data(), static_cast<std::size_t>(few_.q.cols())}));
    out = placer.place(X_BT);
    placer.tighten(out);
    return out;
  }

  void choose() {
    sort_by_fit(out_.table);
    out_.best = simplest_of_best(out_.table);
    const bool clearly = check::kClearly * out_.best.fitted_share() < out_.present.fitted_share() &&
                         out_.present.fitted_m > reasonable();
    const bool odd = oddity(reach(cell_.nominal)) > check::kOddArm;
    if (!(clearly || odd) || nothing_fits()) out_.best = out_.present;
    out_.same.clear();
    for (const auto& one : out_.table)
      if (one.convention != out_.best.convention &&
          one.fitted_share() <= check::kAlike * out_.best.fitted_share())
        out_.same.push_back(one);
  }

  /// Accepts a joint map only if it explains nearly everything, `fit` could not find it by itself,
  /// and no other map with as few changes fits as well.
  void judge_joint_maps() {
    std::vector<Interpretation> found;
    for (const JointMap& map : joint_maps(cell_.nominal, few_, out_.tried)) {
      const Convention c = convention_of(map, labels_);
      if (c == labels_) continue;
      ConventionCandidate candidate = fitter_.placed(c, map.M, map.target_T);
      fitter_.fit(candidate);
      found.push_back(candidate.interpretation);
    }
    sort_by_fit(found);
    std::erase_if(found, [&](const Interpretation& one) {
      return one.fitted_share() > check::kMapFits ||
             check::kClearly * one.fitted_share() > out_.present.fitted_share() ||
             !is_beyond_fit(one.convention);
    });
    if (found.empty()) return;
    const Interpretation& best = simplest_of_best(found);
    for (const Interpretation& one : found)
      if (&one != &best && one.fitted_share() <= check::kAlike * best.fitted_share() &&
          one.changes < best.changes + check::kEquallySimple)
        return;
    out_.best = best;
    out_.table.insert(out_.table.begin(), best);
    out_.same.clear();
  }

  /// A frame given in the cell file shows which axes of the tracker are swapped; it may itself have
  /// been written as its inverse.
  void conclude() {
    if (!cell_.measurement.fit_frame)
      out_.best.convention = with_given_frame(cell_, measured_, some_rows_, labels_, out_.best);
    out_.best.changes = changes(labels_, out_.best.convention);
    out_.changed = out_.best.convention != labels_;
  }

  const Cell& cell_;
  const Measurements& measured_;
  Convention labels_;
  std::vector<int> some_rows_;
  Measurements few_, some_;
  Detection out_;
  InterpretedCells cells_;
  ConventionSweep sweep_;
  CandidateFitter fitter_;
};

Detection detect_in_one_setup(const Cell& cell, const MeasurementFiles& measured) {
  Detection out;
  const Convention labels = labelled_convention(cell, measured);
  const std::vector<int> few = random_rows(measured, check::kSweepPoses);
  out.why_not = why_none_can_be_told(measured, few.size());
  if (out.why_not.empty())
    return ConventionSearch(cell, measured, labels, few, random_rows(measured, check::kPlacedPoses))
        .work();
  out.present.convention = out.best.convention = labels;
  return out;
}

}  // namespace

Detection detect_convention(const Cell& cell, const MeasurementFiles& measured) {
  if (!measured.placement.empty()) {
    // Distances between points that are measured tell units and conventions. Here they are fitted.
    Detection out;
    out.why_not =
        "readings about points, planes or anchors that are fitted as well do not tell "
        "units and conventions";
    out.help = "if the fit is far from nominal: look at units, joint signs and the DH convention";
    out.present.convention = out.best.convention = labelled_convention(cell, measured);
    return out;
  }
  if (cell.measurement.setups.empty() || measured.setup.empty())
    return detect_in_one_setup(cell, measured);
  const OneSetup one = one_setup(cell, measured, largest_setup(cell, measured));
  return detect_in_one_setup(one.cell, one.measured);
}

}  // namespace plumb::offline
