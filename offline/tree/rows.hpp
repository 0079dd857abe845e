// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tree/samples.hpp"
#include "tree/training_rows.hpp"

namespace plumb::offline {

/// Row numbers of a matrix in the lexicographic order of its columns.
std::vector<int> lexicographic(const Samples& table);

/// The training rows without the terms that depend linearly on earlier ones in all samples. It is
/// possible that none remain.
/// u: (n, p), y: (n, outputs), degree: that of the leaves.
TrainingRows training_rows(const Samples& u, const Samples& y, int degree);

}  // namespace plumb::offline
