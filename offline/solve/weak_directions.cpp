// SPDX-License-Identifier: Apache-2.0
#include "solve/weak_directions.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "cell/artefacts.hpp"
#include "solve/constants.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kDirectionsListed = 6;

}  // namespace

std::vector<std::string> names_of(const WeakDirections& weak) {
  std::vector<std::string> out;
  if (weak.weights.rows() == 0) return out;
  // A direction made of many numbers has a small share of each; the largest is named at least.
  const double least = std::min(kNamedShare, weak.share.maxCoeff());
  for (std::size_t i = 0; i < weak.parameters.size(); ++i)
    if (weak.share(static_cast<Eigen::Index>(i)) >= least) out.push_back(weak.parameters[i].name);
  return out;
}

Problem held_near_nominal(const WeakDirections& weak, const Cell& cell) {
  const FitSettings& settings = cell.fit;
  auto names = names_of(weak);
  std::string more;
  if (names.size() > kDirectionsListed) {
    more = fmt::format(" and {} more", names.size() - kDirectionsListed);
    names.resize(kDirectionsListed);
  }
  return {
      .severity = Severity::kNote,
      .code = "N-FIT-PRIOR",
      .message =
          fmt::format("these poses say little of {}{}: they are held near nominal, give "
                      "or take {:g} mm and {:g} mrad",
                      fmt::join(names, ", "), more, settings.prior_m * weak.built.lengths * 1e3,
                      settings.prior_rad * weak.built.angles * 1e3),
      .help = lacks_length(cell)
                  ? "nothing tells the size of the arm: state the distance of two touched points "
                    "in columns to_point and distance_mm"
                  : "to know them, measure poses all over the joint limits: plumb plan --n 30"};
}

}  // namespace plumb::offline
