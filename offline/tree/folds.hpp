// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tree/samples.hpp"

namespace plumb::offline {

/// Fold 0 .. folds - 1 of every row. Rows of one group share a fold; the groups are dealt in the
/// lexicographic order of (q, residual), so neither the order of the rows nor the group numbers
/// matter. Deterministic in the seed. q, residual: shape (n, .); group: (n,).
std::vector<int> deal_folds(const Samples& q, const Samples& residual, std::span<const int> group,
                            int folds, std::uint64_t seed);

/// The number of different groups.
int count_groups(std::span<const int> group);

/// The rows listed, shape (which, columns).
Samples rows_of(const Samples& all, const std::vector<int>& which);

}  // namespace plumb::offline
