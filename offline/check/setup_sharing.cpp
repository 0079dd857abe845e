// SPDX-License-Identifier: Apache-2.0
#include "check/setup_sharing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "arm/predicted_points.hpp"
#include "check/constants.hpp"
#include "fit/calibrate.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

double rms_error(const Measurements& measured, const std::vector<int>& rows,
                 const ArmState& state) {
  const Measurements some = pick(measured, rows);
  return std::sqrt(residuals(some, predict_points(state, some)).squaredNorm() /
                   static_cast<double>(some.size()));
}

/// The calibration of a cell that may be wrong; nothing if it does not succeed.
std::optional<ArmState> fitted(const Cell& cell, const Measurements& measured,
                               const std::vector<int>& rows) {
  try {
    return calibrate(cell, measured, rows).state;
  } catch (const Failure&) {
    return std::nullopt;
  }
}

double distance(const format::Pose& a, const format::Pose& b) {
  return std::hypot(a.p[0] - b.p[0], a.p[1] - b.p[1], a.p[2] - b.p[2]);
}

class Sharing {
 public:
  Sharing(const Cell& cell, const Measurements& measured, const std::vector<int>& rows)
      : cell_(cell), measured_(measured), rows_(thinned(measured, rows, check::kSharingRows)) {}

  std::vector<Problem> findings() {
    const auto& setups = cell_.measurement.setups;
    for (std::size_t k = 0; k < setups.size(); ++k) {
      if (setups[k].frame_of) try_own_frame(k, static_cast<std::size_t>(*setups[k].frame_of));
      if (setups[k].target_of) try_own_target(k, static_cast<std::size_t>(*setups[k].target_of));
    }
    return std::move(out_);
  }

 private:
  void try_own_frame(std::size_t k, std::size_t other) {
    Cell own = cell_;
    own.measurement.setups[k].frame_of.reset();
    own.measurement.setups[k].fit_frame = true;
    const auto apart = [&](const ArmState& state) {
      return distance(state.frame(static_cast<int>(k)), state.frame(static_cast<int>(other)));
    };
    compare(own, k, other, "does not stand where", "stands", "frame", apart);
  }

  void try_own_target(std::size_t k, std::size_t other) {
    Cell own = cell_;
    own.measurement.setups[k].target_of.reset();
    own.measurement.setups[k].fit_target = true;
    const auto apart = [&](const ArmState& state) {
      return distance(state.target(static_cast<int>(k)), state.target(static_cast<int>(other)));
    };
    compare(own, k, other, "does not carry the reflector that", "carries", "target", apart);
  }

  void compare(const Cell& own, std::size_t k, std::size_t other, const char* says,
               const char* verb, const char* key,
               const std::function<double(const ArmState&)>& apart) {
    const auto of_setup = std::count_if(rows_.begin(), rows_.end(), [&](int row) {
      return measured_.setup[static_cast<std::size_t>(row)] == static_cast<int>(k);
    });
    if (of_setup < check::kFewestOfSetup) return;
    const auto alone = fitted(own, measured_, rows_);
    if (!alone) return;
    const double left = rms_error(measured_, rows_, *alone);
    if (left > check::kSharingExplains * shared_error()) return;
    const std::string& name = cell_.measurement.setups[k].name;
    const std::string& first = cell_.measurement.setups[other].name;
    out_.push_back(
        {Severity::kWarning, "W-CHECK-SAME",
         fmt::format(
             "set-up '{}' {} '{}' {}, as its {} says: with its own it is {:.3g} mm away, "
             "and the fit leaves {:.3g} mm{}",
             name, says, first, verb, key, apart(*alone) * 1e3, left * 1e3,
             shared_error() < 1e299 ? fmt::format(", not {:.3g} mm", shared_error() * 1e3) : ""),
         cell_.measurement.setups[k].place,
         fmt::format("if so, in the set-up '{}': {} = \"fit\"", name, key)});
  }

  /// As the cell says; computed once.
  double shared_error() {
    if (!shared_) {
      const auto state = fitted(cell_, measured_, rows_);
      shared_ = state ? rms_error(measured_, rows_, *state) : 1e300;
    }
    return *shared_;
  }

  const Cell& cell_;
  const Measurements& measured_;
  std::vector<int> rows_;
  std::optional<double> shared_;
  std::vector<Problem> out_;
};

}  // namespace

std::vector<Problem> sharing_findings(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows) {
  if (measured.setup.empty()) return {};
  return Sharing(cell, measured, rows).findings();
}

}  // namespace plumb::offline
