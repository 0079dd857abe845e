// SPDX-License-Identifier: Apache-2.0
#include "check/convention_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "arm/parameter.hpp"
#include "cell/random.hpp"
#include "cell/setups.hpp"
#include "cell/units.hpp"
#include "check/arm_sweep.hpp"
#include "check/constants.hpp"
#include "check/coupling_guess.hpp"
#include "check/given_frame.hpp"
#include "check/joint_maps.hpp"
#include "check/linear_placement.hpp"
#include "check/regularised_fit.hpp"
#include "check/unit_guess.hpp"
#include "fit/calibrate.hpp"
#include "plumb/runtime/chain.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline {
namespace {

/// Misfits that differ by less are equal: the quick misfit is exact to 1e-6.
constexpr double kNoBetter = 1e-5;

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

struct Lead {
  Convention convention;  // its lengths as labelled
  double slide_ratio = 1.0;
  LinearPlacement loose;
};

class ConventionSearch {
 public:
  ConventionSearch(const Cell& cell, const MeasurementFiles& measured)
      : cell_(cell),
        measured_(measured),
        labels_(labelled_convention(cell, measured)),
        few_(random_rows(measured, check::kSweepPoses)),
        some_(random_rows(measured, check::kPlacedPoses)) {}

  Detection work() {
    if (!can_work()) return std::move(out_);
    judge_all_of([this] { sweep(0); });
    if (nothing_fits()) judge_all_of([this] { sweep(2); });
    if (nothing_fits() && enough_poses()) judge_all_of([this] { sweep_orders(); });
    seek_coupling();
    if (nothing_fits() && enough_poses()) judge_joint_maps();
    conclude();
    return std::move(out_);
  }

 private:
  static double relative(double rms, double size) { return size > 0.0 ? rms / size : 1e300; }
  static double left(const Interpretation& interpretation) {
    return relative(interpretation.fitted_m, interpretation.size_m);
  }
  bool nothing_fits() const { return left(out_.best) > check::kFits; }
  /// Whether there are enough poses for searches with hundreds of alternatives, such as joints in
  /// another order or a factor for each joint.
  bool enough_poses() const { return static_cast<int>(few_.size()) >= check::kFewestForMany; }

  /// Fits the best candidates that a sweep finds.
  template <class Sweep>
  void judge_all_of(const Sweep& sweep_all) {
    leads_.clear();
    sweep_all();
    judge();
  }

  bool can_work() {
    out_.present.convention = out_.best.convention = labels_;
    int axes = 0;
    for (const bool has : measured_.has_axis) axes += has ? 1 : 0;
    const auto spread = [&](const auto& columns) {
      return (columns.rowwise() - columns.colwise().mean().eval()).norm();
    };
    if (static_cast<int>(few_.size()) < check::kFewestPoses)
      out_.why_not =
          fmt::format("{} too few to tell conventions apart: {} are needed",
                      counted_words(static_cast<long long>(few_.size()), "pose is", "poses are"),
                      check::kFewestPoses);
    else if (axes < 2)
      out_.why_not = "one measured axis is too little to tell conventions apart";
    else if (!(spread(measured_.q) > 0.0))
      out_.why_not = "every row has the same joint positions";
    else if (!(spread(measured_.p_M) > 0.0))
      out_.why_not = "every row has the same measured point";
    return out_.why_not.empty();
  }

  const Cell& cell_as(Convention c) {
    c.reversed = labels_.reversed;
    c.mirror = Mirror::kNone;
    c.turn_unit = labels_.turn_unit;
    c.coupling = labels_.coupling;
    const auto key = fmt::format("{} {} {} {} {}", static_cast<int>(c.dh), c.length_unit,
                                 c.angle_unit, fmt::join(c.quarter_turns, ","), c.frame_inverted) +
                     fmt::format(" {}", fmt::join(c.zero, ","));
    auto found = cells_.find(key);
    if (found == cells_.end()) found = cells_.emplace(key, read_as(cell_, labels_, c)).first;
    return found->second;
  }

  // ---- the loose look at everything

  void sweep(int most_turned) {
    const Measurements few = pick(measured_, few_);
    LinearPlacer placer(few.p_M, few.has_axis);
    double largest = 0.0;
    bool any_slides = false;
    for (int j = 0; j < cell_.joints(); ++j) {
      const bool turns = cell_.nominal.joints[j].type == format::JointType::kRevolute;
      if (turns) largest = std::max(largest, few.q.col(j).cwiseAbs().maxCoeff());
      any_slides = any_slides || !turns;
    }
    const std::vector<double> none{0.0};
    Convention c = labels_;
    for (const auto dh : {format::Convention::kStandard, format::Convention::kModified})
      for (const auto& table : plausible_table_units(cell_.nominal, labels_.angle_unit))
        for (const auto& turn : plausible_turn_units(largest, labels_.turn_unit))
          for (const double slide : any_slides ? length_ratios() : none) {
            c.dh = dh;
            c.angle_unit = table;
            c.turn_unit = turn;
            sweep_directions(c, slide, few, placer, most_turned);
          }
  }

  void sweep_orders() {
    const Measurements few = pick(measured_, few_);
    LinearPlacer placer(few.p_M, few.has_axis);
    for_each_order({labels_.coupling}, [&](const Convention& c, double slide) {
      sweep_directions(c, slide, few, placer, 0);
    });
  }

  void sweep_coupled_orders() {
    const Measurements few = pick(measured_, few_);
    LinearPlacer placer(few.p_M, few.has_axis);
    std::vector<int> rows = few_;
    rows.resize(std::min<std::size_t>(rows.size(), check::kGlancePoses));
    const Measurements fewer = pick(measured_, rows);
    const LinearPlacer glance(fewer.p_M, fewer.has_axis);
    for_each_order(neighbour_couplings(cell_.nominal), [&](const Convention& c, double slide) {
      sweep_directions_that_fit(c, slide, few, placer, fewer, glance);
    });
  }

  /// The columns of the joints in another order: sorted by name, say, or two of them swapped.
  /// Joints that turn stay among themselves.
  template <class Sweep>
  void for_each_order(const std::vector<Couplings>& couplings, const Sweep& sweep_all) {
    std::vector<int> turning;
    for (int j = 0; j < cell_.joints(); ++j)
      if (cell_.nominal.joints[j].type == format::JointType::kRevolute) turning.push_back(j);
    const double slide = static_cast<int>(turning.size()) < cell_.joints() ? 1.0 : 0.0;
    for (const auto dh : {format::Convention::kStandard, format::Convention::kModified})
      for (const auto& order : orders_of(turning)) {
        Convention c = labels_;
        c.dh = dh;
        for (std::size_t k = 0; k < turning.size(); ++k)
          c.column[static_cast<std::size_t>(turning[k])] = order[k];
        for (const auto& coupling : couplings) {
          c.coupling = coupling;
          sweep_all(c, slide);
        }
      }
  }

  /// Tries the couplings of joints that controllers have. If nothing fits, also together with one
  /// zero changed by a quarter turn, and the couplings of neighbours with the columns in another
  /// order. A wrist whose reflector is near its axis fits within a hundredth of the cloud even
  /// without its coupling; therefore couplings are tried whenever more is left than a fitted arm
  /// leaves.
  void seek_coupling() {
    if (out_.best.fitted_m <= reasonable()) return;
    seek_coupling([this] { sweep_couplings(0); });
    if (nothing_fits()) seek_coupling([this] { sweep_couplings(1); });
    if (nothing_fits() && enough_poses()) seek_coupling([this] { sweep_coupled_orders(); });
  }

  /// Keeps what was found before unless a coupling leaves much less.
  template <class Sweep>
  void seek_coupling(const Sweep& sweep_all) {
    const Detection before = out_;
    judge_all_of(sweep_all);
    const bool clearly = out_.best.convention.coupling != labels_.coupling &&
                         check::kClearly * left(out_.best) < left(before.best);
    if (clearly) return;
    const auto tried = out_.tried;
    out_ = before;
    out_.tried = tried;
  }

  void sweep_couplings(int most_turned) {
    const Measurements few = pick(measured_, few_);
    LinearPlacer placer(few.p_M, few.has_axis);
    const bool all_turn =
        std::all_of(cell_.nominal.joints.begin(), cell_.nominal.joints.end(),
                    [](const auto& row) { return row.type == format::JointType::kRevolute; });
    Convention c = labels_;
    auto couplings = plausible_couplings(cell_.nominal);
    couplings.emplace_back();
    for (auto& one : couplings) {
      c.coupling = std::move(one);
      sweep_directions(c, all_turn ? 0.0 : 1.0, few, placer, most_turned);
    }
  }

  static std::vector<std::vector<int>> orders_of(const std::vector<int>& joints) {
    std::vector<std::vector<int>> out;
    std::vector<int> order = joints;
    if (joints.size() <= check::kAllOrders) {
      while (std::next_permutation(order.begin(), order.end())) out.push_back(order);
      return out;
    }
    for (std::size_t from = 0; from < joints.size(); ++from)
      for (std::size_t to = from + 1; to < joints.size(); ++to) {
        const auto begin = static_cast<std::ptrdiff_t>(from), end = static_cast<std::ptrdiff_t>(to);
        order = joints;
        std::swap(order[from], order[to]);
        out.push_back(order);
        if (to == from + 1) continue;
        order = joints;
        std::rotate(order.begin() + begin, order.begin() + begin + 1, order.begin() + end + 1);
        out.push_back(order);
        order = joints;
        std::rotate(order.begin() + begin, order.begin() + end, order.begin() + end + 1);
        out.push_back(order);
        order = joints;
        std::reverse(order.begin() + begin, order.begin() + end + 1);
        out.push_back(order);
      }
    return out;
  }

  RowsN joints_of(const Measurements& rows, const Convention& c, double slide) {
    RowsN q = read_as(rows, cell_, labels_, c).q;
    for (int j = 0; j < cell_.joints(); ++j)
      if (cell_.nominal.joints[j].type == format::JointType::kPrismatic) q.col(j) *= slide;
    return q;
  }

  void sweep_directions(const Convention& c, double slide, const Measurements& few,
                        LinearPlacer& placer, int most_turned) {
    ArmSweep(cell_as(c).nominal, joints_of(few, c, slide), most_turned)
        .run([&](const std::vector<bool>& reversed, const std::vector<int>& turns,
                 const std::vector<Transformd>& X_BT) {
          ++out_.tried;
          offer(c, slide, reversed, turns, X_BT, placer);
        });
  }

  /// The same for candidates that are of use only if they fit: those with a large misfit in a few
  /// rows are dropped early.
  void sweep_directions_that_fit(const Convention& c, double slide, const Measurements& few,
                                 LinearPlacer& placer, const Measurements& fewer,
                                 const LinearPlacer& glance) {
    std::vector<std::vector<bool>> near;
    std::vector<int> unturned;
    ArmSweep(cell_as(c).nominal, joints_of(fewer, c, slide), 0)
        .run([&](const std::vector<bool>& reversed, const std::vector<int>& turns,
                 const std::vector<Transformd>& X_BT) {
          ++out_.tried;
          unturned = turns;
          if (glance.quick_misfit(X_BT) < check::kHopeless) near.push_back(reversed);
        });
    if (near.empty()) return;
    const ArmSweep sweep(cell_as(c).nominal, joints_of(few, c, slide), 0);
    for (const auto& reversed : near)
      offer(c, slide, reversed, unturned, sweep.poses(reversed), placer);
  }

  void offer(Convention c, double slide, const std::vector<bool>& reversed,
             const std::vector<int>& turns, const std::vector<Transformd>& X_BT,
             LinearPlacer& placer) {
    if (leads_.size() == check::kPlacedLeads &&
        placer.quick_misfit(X_BT) > kNoBetter + leads_.front().loose.misfit)
      return;
    c.reversed = reversed;
    c.coupling = reversed_couplings(c.coupling, reversed);
    c.quarter_turns = turns;
    offer({std::move(c), slide, placer.place(X_BT)}, placer);
  }

  /// Keeps the leads with the least misfit.
  void offer(Lead lead, const LinearPlacer& placer) {
    const auto worse = [](const Lead& a, const Lead& b) { return a.loose.misfit < b.loose.misfit; };
    const auto hopeless = [&] {
      return leads_.size() == check::kPlacedLeads &&
             lead.loose.misfit >= leads_.front().loose.misfit;
    };
    if (hopeless()) return;
    placer.tighten(lead.loose);
    if (hopeless()) return;
    leads_.push_back(std::move(lead));
    std::push_heap(leads_.begin(), leads_.end(), worse);
    if (leads_.size() <= check::kPlacedLeads) return;
    std::pop_heap(leads_.begin(), leads_.end(), worse);
    leads_.pop_back();
  }

  // ---- the close look at some

  struct Candidate {
    Interpretation interpretation;
    RegularisedFit placed;
  };

  Candidate placed(const Convention& c, Eigen::Matrix3d M, const Eigen::Vector3d& target_T) {
    const Cell& cell = cell_as(c);
    const Measurements some = read_as(pick(measured_, some_), cell_, labels_, c);
    if (c.mirror != Mirror::kNone) M.col(1) *= -1.0;  // as kNegateY does to the points
    std::vector<int> rows(some_.size());
    std::iota(rows.begin(), rows.end(), 0);
    Candidate out;
    out.placed = robust_placement(cell, some, rows, state_near(cell, some, rows, M, target_T));
    auto& r = out.interpretation;
    r.convention = c;
    r.changes = changes(labels_, c);
    r.placed_m = r.fitted_m = out.placed.rms_m;
    r.size_m = std::sqrt((some.p_M.rowwise() - some.p_M.colwise().mean().eval()).squaredNorm() /
                         static_cast<double>(some.size()));
    return out;
  }

  void fit(Candidate& candidate) {
    const auto& c = candidate.interpretation.convention;
    const Measurements some = read_as(pick(measured_, some_), cell_, labels_, c);
    std::vector<int> rows(some_.size());
    std::iota(rows.begin(), rows.end(), 0);
    candidate.interpretation.fitted_m =
        regularised_fit(cell_as(c), some, rows, candidate.placed.state).rms_m;
  }

  /// The interpretation of a lead, with its length units resolved.
  Candidate look_closely(const Lead& lead, bool mirrored) {
    Convention c = lead.convention;
    const auto units = explain_ratios({labels_.length_unit, labels_.slide_unit, labels_.point_unit},
                                      lead.loose.ratio, lead.slide_ratio, reach(cell_.nominal));
    c.length_unit = units.table;
    c.slide_unit = units.slide;
    c.point_unit = units.point;
    if (mirrored) c.mirror = Mirror::kNegateY;
    const double shorter = unit_ratio(units.table, labels_.length_unit);
    return placed(c, lead.loose.M, lead.loose.target_T * shorter);
  }

  static double unit_ratio(const std::string& meant, const std::string& labelled) {
    return unit_of(meant)->to_si(1.0) / unit_of(labelled)->to_si(1.0);
  }

  Candidate as_labelled() {
    LinearPlacement loose;
    for (const Lead& lead : leads_)
      if (lead.convention == labels_ && (lead.slide_ratio == 1.0 || lead.slide_ratio == 0.0))
        loose = lead.loose;
    if (loose.ratio == 0.0) {
      const Measurements few = pick(measured_, few_);
      LinearPlacer placer(few.p_M, few.has_axis);
      const Chain chain(cell_.nominal);
      std::vector<Transformd> X_BT;
      for (int i = 0; i < few.size(); ++i)
        X_BT.push_back(
            chain.forward({few.q.row(i).data(), static_cast<std::size_t>(few.q.cols())}));
      loose = placer.place(X_BT);
      placer.tighten(loose);
    }
    Candidate out = placed(labels_, loose.M, loose.target_T);
    if (relative(out.interpretation.placed_m, out.interpretation.size_m) > check::kFits)
      place_as_fit_does(out);
    return out;
  }

  /// Points on one circle or in one plane leave the linear placement undetermined, and so the start
  /// of frame and target. For the files as labelled, the start that `fit` itself would use is taken
  /// if it is better.
  void place_as_fit_does(Candidate& candidate) {
    const Measurements some = pick(measured_, some_);
    std::vector<int> rows(static_cast<std::size_t>(some.size()));
    std::iota(rows.begin(), rows.end(), 0);
    RegularisedFit other = placed_from_the_labels(cell_, some, rows);
    if (!(other.rms_m < candidate.placed.rms_m)) return;
    candidate.interpretation.placed_m = candidate.interpretation.fitted_m = other.rms_m;
    candidate.placed = std::move(other);
  }

  void judge() {
    std::vector<Candidate> all{as_labelled()};
    std::sort(leads_.begin(), leads_.end(),
              [](const Lead& a, const Lead& b) { return a.loose.misfit < b.loose.misfit; });
    const bool flat = std::count(measured_.has_axis.begin(), measured_.has_axis.end(), true) < 3;
    for (const Lead& lead : leads_) {
      const bool mirrored = lead.loose.left_handed && !flat;
      Candidate candidate = look_closely(lead, mirrored);
      if (candidate.interpretation.convention != labels_) all.push_back(std::move(candidate));
    }
    const auto misfit = [](const Candidate& c) {
      return relative(c.interpretation.placed_m, c.interpretation.size_m);
    };
    std::stable_sort(all.begin() + 1, all.end(),
                     [&](const Candidate& a, const Candidate& b) { return misfit(a) < misfit(b); });
    if (all.size() > check::kFittedLeads + 1) all.resize(check::kFittedLeads + 1);
    for (auto& candidate : all) fit(candidate);
    out_.present = all.front().interpretation;
    out_.table.clear();
    for (const auto& candidate : all) out_.table.push_back(candidate.interpretation);
    choose();
  }

  /// The largest RMS error [m] that a correctly interpreted and fitted arm may leave.
  double reasonable() const {
    return check::kReasonable_m + check::kReasonableShare * out_.present.size_m;
  }

  static void sort_by_left(std::vector<Interpretation>& interpretations) {
    std::stable_sort(
        interpretations.begin(), interpretations.end(),
        [](const Interpretation& a, const Interpretation& b) { return left(a) < left(b); });
  }

  /// The candidate nearest to the labels among those that fit about as well as the best.
  static const Interpretation& simplest_of_best(const std::vector<Interpretation>& sorted) {
    const Interpretation* out = &sorted.front();
    for (const Interpretation& r : sorted)
      if (left(r) <= check::kAlike * left(sorted.front()) && r.changes < out->changes - 1e-9)
        out = &r;
    return *out;
  }

  void choose() {
    sort_by_left(out_.table);
    out_.best = simplest_of_best(out_.table);
    const bool clearly = check::kClearly * left(out_.best) < left(out_.present) &&
                         out_.present.fitted_m > reasonable();
    const bool odd = oddity(reach(cell_.nominal)) > check::kOddArm;
    if (!(clearly || odd) || left(out_.best) > check::kFits) out_.best = out_.present;
    out_.same.clear();
    for (const auto& r : out_.table)
      if (r.convention != out_.best.convention && left(r) <= check::kAlike * left(out_.best))
        out_.same.push_back(r);
  }

  // ---- zeros that are no quarter turns, and a joint that counts otherwise

  /// Rounds the factors and zeros of a joint map to what a person would write.
  Convention convention_of(const JointMap& map) const {
    Convention c = labels_;
    const double within = std::max(check::kSameFactor, check::kFactorDeviations * map.factor_std);
    for (std::size_t j = 0; j < map.zero.size(); ++j) {
      c.zero[j] = round_angle(map.zero[j]);
      if (map.factor[j] == 1.0) continue;
      for (const char* unit : {"rad", "deg", "mrad"})
        if (near(map.factor[j], unit_ratio(unit, labels_.turn_unit), within)) c.own_unit[j] = unit;
      if (c.own_unit[j].empty()) c.factor[j] = round_factor(map.factor[j], within);
    }
    return c;
  }

  static bool near(double factor, double expected, double within) {
    return std::abs(factor / expected - 1.0) < within;
  }

  /// Rounds to a multiple of 5, 1 or 0.5 deg within an arm's usual errors, else to 0.1 deg.
  static double round_angle(double angle) {
    const double degrees = angle * 180.0 / M_PI;
    for (const double step : {5.0, 1.0, 0.5})
      if (std::abs(degrees - step * std::round(degrees / step)) < check::kNearRound_deg)
        return step * std::round(degrees / step) * M_PI / 180.0;
    return 0.1 * std::round(degrees / 0.1) * M_PI / 180.0;
  }

  /// Rounds to a whole number or its reciprocal if that is near and unambiguous; keeps the sign.
  static double round_factor(double factor, double within) {
    const double size = std::abs(factor), sign = factor < 0.0 ? -1.0 : 1.0;
    const double whole = std::round(std::max(size, 1.0 / size));
    const double snapped = size < 1.0 ? 1.0 / whole : whole;
    if (within * whole > check::kOneWhole) within = check::kSameFactor;
    return near(size, snapped, within) ? sign * snapped : factor;
  }

  /// Accepts a joint map only if it explains nearly everything, `fit` could not find it by itself,
  /// and no other map with as few changes fits as well.
  void judge_joint_maps() {
    const Measurements few = pick(measured_, few_);
    std::vector<Interpretation> found;
    for (const JointMap& map : joint_maps(cell_.nominal, few, out_.tried)) {
      const Convention c = convention_of(map);
      if (c == labels_) continue;
      Candidate candidate = placed(c, map.M, map.target_T);
      fit(candidate);
      found.push_back(candidate.interpretation);
    }
    sort_by_left(found);
    std::erase_if(found, [&](const Interpretation& r) {
      return left(r) > check::kMapFits || check::kClearly * left(r) > left(out_.present) ||
             !is_large(r.convention);
    });
    if (found.empty()) return;
    const Interpretation& best = simplest_of_best(found);
    for (const Interpretation& r : found)
      if (&r != &best && left(r) <= check::kAlike * left(best) &&
          r.changes < best.changes + check::kEquallySimple)
        return;
    out_.best = best;
    out_.table.insert(out_.table.begin(), best);
    out_.same.clear();
  }

  /// Whether it changes more than `fit` can find by itself, such as a large joint zero or a factor.
  bool is_large(const Convention& c) const {
    for (std::size_t j = 0; j < c.zero.size(); ++j)
      if (std::abs(c.zero[j]) > check::kFitFindsZero || c.factor[j] != 1.0 ||
          !c.own_unit[j].empty())
        return true;
    return false;
  }

  /// A frame given in the cell file shows which axes of the tracker are swapped; it may itself have
  /// been written as its inverse.
  void conclude() {
    if (!cell_.measurement.fit_frame)
      out_.best.convention = with_given_frame(cell_, measured_, some_, labels_, out_.best);
    out_.best.changes = changes(labels_, out_.best.convention);
    out_.changed = out_.best.convention != labels_;
  }

  const Cell& cell_;
  const Measurements& measured_;  // the search reads numbers only
  Convention labels_;
  std::vector<int> few_, some_;
  std::vector<Lead> leads_;
  std::map<std::string, Cell> cells_;
  Detection out_;
};

}  // namespace

Detection detect_convention(const Cell& cell, const MeasurementFiles& measured) {
  if (cell.measurement.setups.empty() || measured.setup.empty())
    return ConventionSearch(cell, measured).work();
  const OneSetup one = one_setup(cell, measured, largest_setup(cell, measured));
  return ConventionSearch(one.cell, one.measured).work();
}

}  // namespace plumb::offline
