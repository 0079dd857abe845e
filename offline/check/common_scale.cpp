// SPDX-License-Identifier: Apache-2.0
#include "check/common_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cell/units.hpp"
#include "check/constants.hpp"
#include "check/linear_placement.hpp"
#include "numbers/pivoted_qr.hpp"
#include "plumb/runtime/chain.hpp"
#include "solve/evaluation.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// How many standard deviations count as certain: more if few lengths tell the scatter, because
/// Student's t distribution then has long tails.
double sure(std::size_t freedom) {
  return check::kScaleDeviations * (1.0 + check::kScaleTails / static_cast<double>(freedom));
}

/// A fitted length [m]. `change`: fitted less nominal. `whole`: by how much it would change if all
/// measured distances doubled. That is its nominal value, unless a length that the fit holds fixed
/// is coupled to it.
struct Length {
  double whole, change, std;
};

/// Change of every parameter that doubles all measured coordinates: J d = p_M by least squares.
Eigen::VectorXd of_scale(const Measurements& measured, const std::vector<int>& rows,
                         const Calibration& fitted) {
  const Measurements some = pick(measured, thinned(measured, rows, check::kScaleRows));
  FitData data;
  data.measured = &some;
  data.sigma_m = Rows3::Ones(some.size(), 3);
  for (int i = 0; i < some.size(); ++i) data.rows.push_back(i);
  const Solution here = evaluate(data, fitted.state, fitted.parameters);
  Eigen::VectorXd points(here.jacobian.rows());
  Eigen::Index line = 0;
  for (int i = 0; i < some.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (some.has_axis[static_cast<std::size_t>(k)]) points(line++) = some.p_M(i, k);
  return PivotedQr(here.jacobian).solve(points);
}

/// The fitted lengths of the arm, those that a common factor changes most first.
std::vector<Length> fitted_lengths(const Eigen::VectorXd& whole, const Calibration& fitted) {
  std::vector<Length> out;
  for (std::size_t i = 0; i < fitted.estimates.size(); ++i) {
    const Estimate& e = fitted.estimates[i];
    if (e.of_robot && e.is_length && !fitted.parameters[i].of_effect())
      out.push_back({whole(static_cast<Eigen::Index>(i)), e.value - e.nominal, e.std});
  }
  std::sort(out.begin(), out.end(),
            [](const Length& a, const Length& b) { return std::abs(a.whole) > std::abs(b.whole); });
  return out;
}

struct Scale {
  double beyond = 0.0;  // of 1
  double sigma = 0.0;
};

/// Least-squares estimate of the factor `beyond` in change_i = beyond * whole_i.
Scale scale_of(const std::vector<Length>& lengths) {
  double nn = 0.0, nc = 0.0, squares = 0.0;
  for (const auto& l : lengths) {
    nn += l.whole * l.whole;
    nc += l.whole * l.change;
  }
  Scale out;
  if (!(nn > 0.0)) return out;
  out.beyond = nc / nn;
  for (const auto& l : lengths)
    squares += std::pow(l.change - out.beyond * l.whole, 2) + l.std * l.std;
  out.sigma = std::sqrt(squares / static_cast<double>(lengths.size() - 1) / nn);
  return out;
}

/// Whether all lengths ask for the same factor: each of the two longest by itself, since both might
/// be wrong by chance, and no other contradicts it.
bool all_agree(const std::vector<Length>& lengths, const Scale& scale) {
  double squares = 0.0;
  for (const auto& l : lengths) squares += std::pow(l.change - scale.beyond * l.whole, 2);
  const double scatter = std::sqrt(squares / static_cast<double>(lengths.size() - 1));
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double asked = scale.beyond * lengths[i].whole;
    const double off = std::abs(lengths[i].change - asked);
    if (i < 2 ? off > check::kLongestAgree * std::abs(asked)
              : off > check::kLengthContradicts * scatter)
      return false;
  }
  return true;
}

std::string cause_of(double beyond) {
  if (std::abs(beyond) < 1e-3)
    return "the tracker's scale, or its correction for the temperature of air or part? A warm arm "
           "grows by 12 to 24 ppm a kelvin. Else it is the arm, and the fit is right";
  return "a scale factor in the tracker's software, or a unit? Else the lengths of the DH table";
}

constexpr std::array<std::pair<const char*, double>, 7> kLengthUnits{{{"um", 1e-6},
                                                                      {"mm", 1e-3},
                                                                      {"cm", 1e-2},
                                                                      {"in", 25.4e-3},
                                                                      {"dm", 0.1},
                                                                      {"ft", 0.3048},
                                                                      {"m", 1.0}}};

/// "in ft, not mm" if such a unit makes a length of `labelled` longer by `factor`; else "".
std::string unit_instead(const std::string& labelled, double factor) {
  for (const auto& [name, metres] : kLengthUnits) {
    const double ratio = metres / unit_of(labelled)->to_si(1.0);
    if (std::abs(ratio / factor - 1.0) < check::kUnitOfFactor)
      return fmt::format("in {}, not {}", name, labelled);
  }
  return "";
}

/// Which unit explains the factor; "" if none does.
std::string unit_cause(const Cell& cell, const Convention& labels, double factor) {
  const std::string points = unit_instead(labels.point_unit, factor);
  const std::string table = unit_instead(cell.length_unit, 1.0 / factor);
  if (!points.empty() && !table.empty())
    return fmt::format("are the points {}, or the lengths of the DH table {}?", points, table);
  if (!points.empty()) return fmt::format("are the points {}?", points);
  if (!table.empty()) return fmt::format("are the lengths of the DH table {}?", table);
  return "";
}

}  // namespace

std::vector<Problem> scale_findings(const Measurements& measured, const std::vector<int>& rows,
                                    const Calibration& fitted) {
  const bool all_axes = measured.has_axis[0] && measured.has_axis[1] && measured.has_axis[2];
  if (!all_axes || static_cast<int>(rows.size()) < check::kFewestPoses || !measured.setup.empty() ||
      fitted.estimates.size() < check::kFewestLengths)
    return {};
  const auto lengths = fitted_lengths(of_scale(measured, rows, fitted), fitted);
  if (lengths.size() < check::kFewestLengths) return {};
  const Scale scale = scale_of(lengths);
  const double least = std::max(check::kLeastScale, sure(lengths.size() - 1) * scale.sigma);
  if (std::abs(scale.beyond) < least || !all_agree(lengths, scale)) return {};
  const double factor = 1.0 / (1.0 - scale.beyond);  // the points were measured with it
  return {{Severity::kWarning, "W-CHECK-SCALE",
           fmt::format("the fitted lengths are all {} than the nominal ones by one factor, {:.5f} "
                       "({:+.0f} ppm, 1 sigma {:.0f} ppm)",
                       factor > 1.0 ? "longer" : "shorter", factor, (factor - 1.0) * 1e6,
                       scale.sigma * 1e6),
           std::nullopt, cause_of(factor - 1.0)}};
}

std::optional<GrossScale> gross_scale(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows, const Detection& detection) {
  const bool all_axes = measured.has_axis[0] && measured.has_axis[1] && measured.has_axis[2];
  if (static_cast<int>(rows.size()) < check::kFewestPoses || !all_axes || !measured.setup.empty())
    return std::nullopt;
  const Measurements some = pick(measured, thinned(measured, rows, check::kScaleRows));
  const Chain chain(cell.nominal);
  std::vector<Transformd> X_BT;
  for (int i = 0; i < some.size(); ++i) {
    const auto q = some.q.row(i);
    X_BT.push_back(chain.forward({q.data(), static_cast<std::size_t>(q.cols())}));
  }
  LinearPlacer placer(some.p_M, some.has_axis);
  LinearPlacement loose = placer.place(X_BT);
  placer.tighten(loose);
  const double factor = loose.ratio;
  if (loose.left_handed || loose.misfit > check::kFits ||
      std::abs(factor - 1.0) < check::kLeastGross)
    return std::nullopt;
  const std::string unit = unit_cause(cell, detection.present.convention, factor);
  return GrossScale{
      {Severity::kWarning, "W-CHECK-SCALE",
       fmt::format("the arm fits all points if they are multiplied by one factor, {:.4g}", factor),
       std::nullopt,
       unit.empty() ? "find the factor between the tracker's coordinates and the DH table: no "
                      "unit of length explains it"
                    : unit},
      !unit.empty()};
}

}  // namespace plumb::offline
