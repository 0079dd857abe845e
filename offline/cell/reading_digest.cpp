// SPDX-License-Identifier: Apache-2.0
#include "cell/reading_digest.hpp"

#include <vector>

#include "program/file.hpp"

namespace plumb::offline {

std::string reading_digest(const Measurements& measured, int row) {
  constexpr std::size_t kDigits = 16;
  std::vector<double> values;
  for (Eigen::Index k = 0; k < measured.q.cols(); ++k) values.push_back(measured.q(row, k));
  for (int k = 0; k < 3; ++k)
    if (measured.has_axis[static_cast<std::size_t>(k)]) values.push_back(measured.p_M(row, k));
  const auto* bytes = reinterpret_cast<const char*>(values.data());
  return sha256({bytes, values.size() * sizeof(double)}).substr(0, kDigits);
}

}  // namespace plumb::offline
