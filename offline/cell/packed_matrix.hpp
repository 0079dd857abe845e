// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "program/json.hpp"

/// Symmetric matrices in kept files. Reading throws nlohmann::json::exception on other content.
namespace plumb::offline {

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
