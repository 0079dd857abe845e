// SPDX-License-Identifier: Apache-2.0
#include "cell/reading_digest.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "program/file.hpp"

namespace plumb::offline {

std::string reading_digest(const Measurements& measured, int row) {
  constexpr std::size_t kDigits = 16;
  constexpr double kPerUnit = 1e5;
  std::vector<std::int64_t> values;
  const auto add = [&](double value) { values.push_back(std::llround(value * kPerUnit)); };
  for (Eigen::Index k = 0; k < measured.q.cols(); ++k) add(measured.q(row, k));
  for (int k = 0; k < 3; ++k)
    if (measured.has_axis[static_cast<std::size_t>(k)]) add(measured.p_M(row, k));
  const auto* bytes = reinterpret_cast<const char*>(values.data());
  return sha256({bytes, values.size() * sizeof(std::int64_t)}).substr(0, kDigits);
}

std::unordered_set<std::string> reading_digests(const Measurements& measured) {
  std::unordered_set<std::string> out;
  for (int i = 0; i < measured.size(); ++i) out.insert(reading_digest(measured, i));
  return out;
}

int count_known(const Measurements& measured, const std::unordered_set<std::string>& known) {
  int out = 0;
  for (int i = 0; i < measured.size(); ++i)
    out += known.contains(reading_digest(measured, i)) ? 1 : 0;
  return out;
}

}  // namespace plumb::offline
