// SPDX-License-Identifier: Apache-2.0
#include "solve/many_rows.hpp"

#include "solve/constants.hpp"

namespace plumb::offline {
bool is_many(const FitData& data, const std::vector<Parameter>& parameters) {
  return static_cast<double>(data.residual_count()) * static_cast<double>(parameters.size()) >
         kManyNumbers;
}

}  // namespace plumb::offline
