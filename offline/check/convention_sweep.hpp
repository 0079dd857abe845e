// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "check/convention.hpp"
#include "check/coupling_guess.hpp"
#include "check/interpreted_cells.hpp"
#include "check/linear_placement.hpp"

namespace plumb::offline {

/// A convention and how well the arm can be placed by it. Its lengths are in the units of the
/// labels; the ratios of the lengths show later which units they are.
struct ConventionLead {
  Convention convention;
  double slide_ratio = 1.0;  // of sliding joints to the table, beside the labels; 0: none slides
  LinearPlacement loose;
};

/// Tries thousands of conventions on a few poses by linear placement and keeps the leads with the
/// least misfit, in no order. Every sweep tries all directions of the joints; `most_turned`: at how
/// many joints zeros are also turned by quarter turns.
class ConventionSweep {
 public:
  /// few: the poses, at least 8. All references must outlive the sweep; `tried` counts.
  ConventionSweep(const Cell& cell, const Measurements& few, const Convention& labels,
                  InterpretedCells& cells, long& tried);

  /// DH convention, and units of the table and of the columns.
  std::vector<ConventionLead> units(int most_turned);
  /// Columns in another order: sorted by name, say, or two of them swapped.
  std::vector<ConventionLead> orders();
  /// Couplings of joints that controllers have.
  std::vector<ConventionLead> couplings(int most_turned);
  /// Couplings of neighbours with the columns in another order.
  std::vector<ConventionLead> coupled_orders();

 private:
  template <class Sweep>
  void for_each_order(const std::vector<Couplings>& couplings, const Sweep& sweep_all);
  RowsN joints_of(const Measurements& rows, const Convention& c, double slide) const;
  void sweep_directions(const Convention& c, double slide, int most_turned);
  void sweep_directions_that_fit(const Convention& c, double slide, const Measurements& fewer,
                                 const LinearPlacer& glance);
  void offer(Convention c, double slide, const std::vector<bool>& reversed,
             const std::vector<int>& turns, const std::vector<Transformd>& X_BT);
  void offer(ConventionLead lead);
  std::vector<ConventionLead> take();

  const Cell& cell_;
  const Measurements& few_;
  const Convention& labels_;
  InterpretedCells& cells_;
  long& tried_;
  LinearPlacer placer_;
  std::vector<ConventionLead> leads_;  // a heap, the worst one first
};

}  // namespace plumb::offline
