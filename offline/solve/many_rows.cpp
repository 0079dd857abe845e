// SPDX-License-Identifier: Apache-2.0
#include "solve/many_rows.hpp"

namespace plumb::offline {
namespace {

constexpr double kManyNumbers = 1.5e6;  // in a Jacobian: beyond it only sums are kept

}  // namespace

bool is_many(const FitData& data, const std::vector<Parameter>& parameters) {
  return static_cast<double>(data.residual_count()) * static_cast<double>(parameters.size()) >
         kManyNumbers;
}

}  // namespace plumb::offline
