// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "fit/error_stats.hpp"
#include "program/json.hpp"

/// What the kept files of fits and fleets have in common. SI; reading throws
/// nlohmann::json::exception on other content.
namespace plumb::offline {

inline Json to_json(const ErrorStats& s) {
  return {{"n", s.n}, {"mean_m", s.mean}, {"rms_m", s.rms}, {"p95_m", s.p95}, {"max_m", s.max}};
}
inline ErrorStats stats_from(const Json& j) {
  return {.n = j.at("n"),
          .mean = j.at("mean_m"),
          .rms = j.at("rms_m"),
          .p95 = j.at("p95_m"),
          .max = j.at("max_m")};
}

/// The lower triangle of a symmetric matrix, row by row.
inline Json packed(const Eigen::MatrixXd& m) {
  Json out = Json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index k = 0; k <= i; ++k) out.push_back(m(i, k));
  return out;
}
inline Eigen::MatrixXd unpacked(const Json& j, Eigen::Index size) {
  Eigen::MatrixXd m(size, size);
  std::size_t next = 0;
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index k = 0; k <= i; ++k) m(i, k) = m(k, i) = j.at(next++).get<double>();
  return m;
}

}  // namespace plumb::offline
