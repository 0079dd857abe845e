// SPDX-License-Identifier: Apache-2.0
#include "check/convention_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "check/arm_sweep.hpp"
#include "check/constants.hpp"
#include "check/joint_orders.hpp"
#include "check/unit_guess.hpp"

namespace plumb::offline {
namespace {

/// Misfits that differ by less are equal: the quick misfit is exact to 1e-6.
constexpr double kNoBetter = 1e-5;

}  // namespace

ConventionSweep::ConventionSweep(const Cell& cell, const Measurements& few,
                                 const Convention& labels, InterpretedCells& cells, long& tried)
    : cell_(cell),
      few_(few),
      labels_(labels),
      cells_(cells),
      tried_(tried),
      placer_(few.p_M, few.has_axis) {}

std::vector<ConventionLead> ConventionSweep::units(int most_turned) {
  double largest = 0.0;
  bool any_slides = false;
  for (int j = 0; j < cell_.joints(); ++j) {
    const bool turns = cell_.nominal.joints[j].type == format::JointType::kRevolute;
    if (turns) largest = std::max(largest, few_.q.col(j).cwiseAbs().maxCoeff());
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
          sweep_directions(c, slide, most_turned);
        }
  return take();
}

std::vector<ConventionLead> ConventionSweep::orders() {
  for_each_order({labels_.coupling},
                 [&](const Convention& c, double slide) { sweep_directions(c, slide, 0); });
  return take();
}

std::vector<ConventionLead> ConventionSweep::couplings(int most_turned) {
  const bool all_turn =
      std::all_of(cell_.nominal.joints.begin(), cell_.nominal.joints.end(),
                  [](const auto& row) { return row.type == format::JointType::kRevolute; });
  Convention c = labels_;
  auto all = plausible_couplings(cell_.nominal);
  all.emplace_back();
  for (auto& one : all) {
    c.coupling = std::move(one);
    sweep_directions(c, all_turn ? 0.0 : 1.0, most_turned);
  }
  return take();
}

std::vector<ConventionLead> ConventionSweep::coupled_orders() {
  std::vector<int> rows(static_cast<std::size_t>(std::min(few_.size(), check::kGlancePoses)));
  std::iota(rows.begin(), rows.end(), 0);
  const Measurements fewer = pick(few_, rows);
  const LinearPlacer glance(fewer.p_M, fewer.has_axis);
  for_each_order(neighbour_couplings(cell_.nominal), [&](const Convention& c, double slide) {
    sweep_directions_that_fit(c, slide, fewer, glance);
  });
  return take();
}

/// Joints that turn stay among themselves.
template <class Sweep>
void ConventionSweep::for_each_order(const std::vector<Couplings>& couplings,
                                     const Sweep& sweep_all) {
  std::vector<int> turning;
  for (int j = 0; j < cell_.joints(); ++j)
    if (cell_.nominal.joints[j].type == format::JointType::kRevolute) turning.push_back(j);
  const double slide = static_cast<int>(turning.size()) < cell_.joints() ? 1.0 : 0.0;
  for (const auto dh : {format::Convention::kStandard, format::Convention::kModified})
    for (const auto& order : joint_orders(turning)) {
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

RowsN ConventionSweep::joints_of(const Measurements& rows, const Convention& c,
                                 double slide) const {
  RowsN q = read_as(rows, cell_, labels_, c).q;
  for (int j = 0; j < cell_.joints(); ++j)
    if (cell_.nominal.joints[j].type == format::JointType::kPrismatic) q.col(j) *= slide;
  return q;
}

void ConventionSweep::sweep_directions(const Convention& c, double slide, int most_turned) {
  ArmSweep(cells_.as(c).nominal, joints_of(few_, c, slide), most_turned)
      .run([&](const std::vector<bool>& reversed, const std::vector<int>& turns,
               const std::vector<Transformd>& X_BT) {
        ++tried_;
        offer(c, slide, reversed, turns, X_BT);
      });
}

/// The same for candidates that are of use only if they fit: those with a large misfit in a few
/// rows are dropped early.
void ConventionSweep::sweep_directions_that_fit(const Convention& c, double slide,
                                                const Measurements& fewer,
                                                const LinearPlacer& glance) {
  std::vector<std::vector<bool>> near;
  std::vector<int> unturned;
  ArmSweep(cells_.as(c).nominal, joints_of(fewer, c, slide), 0)
      .run([&](const std::vector<bool>& reversed, const std::vector<int>& turns,
               const std::vector<Transformd>& X_BT) {
        ++tried_;
        unturned = turns;
        if (glance.quick_misfit(X_BT) < check::kHopeless) near.push_back(reversed);
      });
  if (near.empty()) return;
  const ArmSweep sweep(cells_.as(c).nominal, joints_of(few_, c, slide), 0);
  for (const auto& reversed : near) offer(c, slide, reversed, unturned, sweep.poses(reversed));
}

void ConventionSweep::offer(Convention c, double slide, const std::vector<bool>& reversed,
                            const std::vector<int>& turns, const std::vector<Transformd>& X_BT) {
  if (leads_.size() == check::kPlacedLeads &&
      placer_.quick_misfit(X_BT) > kNoBetter + leads_.front().loose.misfit)
    return;
  c.reversed = reversed;
  c.coupling = reversed_couplings(c.coupling, reversed);
  c.quarter_turns = turns;
  offer({std::move(c), slide, placer_.place(X_BT)});
}

/// Keeps the leads with the least misfit.
void ConventionSweep::offer(ConventionLead lead) {
  const auto worse = [](const ConventionLead& a, const ConventionLead& b) {
    return a.loose.misfit < b.loose.misfit;
  };
  const auto hopeless = [&] {
    return leads_.size() == check::kPlacedLeads && lead.loose.misfit >= leads_.front().loose.misfit;
  };
  if (hopeless()) return;
  placer_.tighten(lead.loose);
  if (hopeless()) return;
  leads_.push_back(std::move(lead));
  std::push_heap(leads_.begin(), leads_.end(), worse);
  if (leads_.size() <= check::kPlacedLeads) return;
  std::pop_heap(leads_.begin(), leads_.end(), worse);
  leads_.pop_back();
}

std::vector<ConventionLead> ConventionSweep::take() { return std::exchange(leads_, {}); }

}  // namespace plumb::offline
