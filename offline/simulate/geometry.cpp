// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>

#include "simulate/truth.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kNearParallel_rad = 0.05;
constexpr double kShared = 0.8, kOwn = 0.6;  // of arms of one batch: their squares add up to 1

// The index of the DH row whose alpha is between the axes i and i + 1.
int link_row(const format::Chain& chain, int i) {
  return chain.convention == format::Convention::kModified ? i + 1 : i;
}

bool near_parallel(const Cell& cell, int i) {
  if (i + 1 >= cell.joints()) return false;
  if (cell.mechanics[i].parallel_next) return true;
  const auto& row = cell.nominal.joints[link_row(cell.nominal, i)];
  return std::abs(std::sin(row.alpha)) < kNearParallel_rad;
}

}  // namespace

format::Chain draw_geometry(const Cell& cell, const HiddenTruth& truth, Random random) {
  format::Chain chain = cell.nominal;
  std::optional<Random> batch;
  if (truth.like) batch.emplace(*truth.like, "geometry");
  const auto normal = [&] {
    const double own = random.normal();
    return batch ? kShared * batch->normal() + kOwn * own : own;
  };
  for (int i = 0; i < cell.joints(); ++i) {
    auto& row = chain.joints[i];
    row.theta += truth.geometry_rad * normal();
    row.a += truth.geometry_m * normal();
    row.alpha += truth.geometry_rad * normal();
    if (near_parallel(cell, i)) {
      chain.joints[link_row(chain, i)].beta += truth.geometry_rad * normal();
    } else {
      row.d += truth.geometry_m * normal();
    }
  }
  return chain;
}

}  // namespace plumb::offline::sim
