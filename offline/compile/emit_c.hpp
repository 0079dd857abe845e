// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// The trees of a model as one header in plain C99, that C++ takes as well: tables, and a function
///
///     int NAME_tree_error(const double q[NAME_joints], double error_m[3]);
///
/// It says what ForwardModel::tree_error says, to the bit where double arithmetic is IEEE's and
/// products are not contracted into sums, else to rounding. It includes nothing, calls nothing,
/// allocates nothing and has no state. NAME is made of the name of the file, so that one
/// program can include several such headers.
///
/// file: the name under which the text will be saved. The model is sound. Throws Failure (kInput,
/// E-EMIT-NO-TREE).
std::string emit_c(const format::Model& model, const std::string& file);

}  // namespace plumb::offline
