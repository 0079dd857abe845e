// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/QR>
#include <cmath>

#include "simulate/planar.hpp"
#include "tree/samples.hpp"

/// The published planar study as training data, for us and for the peers.
namespace plumb::offline::bench {

/// Inputs normalised to the training grid, and what is to be learnt [m], x then y.
struct Data {
  Samples u, y;
};

struct Study {
  Data train, test;
};

/// Steps of the study's grids [rad]: 1536, 5985 and 148,680 poses.
inline constexpr double kCoarseStep = 0.1;
inline constexpr double kTestStep = 0.05;
inline constexpr double kFineStep = 0.01;

inline Samples normalised_to(const RowsN& box, const RowsN& q) {
  Samples u(q.rows(), q.cols());
  for (Eigen::Index k = 0; k < q.cols(); ++k) {
    const double low = box.col(k).minCoeff(), high = box.col(k).maxCoeff();
    u.col(k) = (2.0 * q.col(k).array() - low - high) / (high - low);
  }
  return u;
}

/// Length and lateral offset of both links: X = L2 c2 + v2 s2 + L3 c3 + v3 s3, Y likewise.
inline Eigen::MatrixXd link_columns(const RowsN& q) {
  Eigen::MatrixXd A(2 * q.rows(), 4);
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    const double p2 = q(i, 0), p3 = q(i, 0) + q(i, 1);
    A.row(2 * i) << std::cos(p2), std::cos(p3), std::sin(p2), std::sin(p3);
    A.row(2 * i + 1) << std::sin(p2), std::sin(p3), -std::cos(p2), -std::cos(p3);
  }
  return A;
}

inline Eigen::VectorXd deflections(const RowsN& q) {
  Eigen::VectorXd out(2 * q.rows());
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    out.segment<2>(2 * i) = planar_deflection(PlanarVariant::kPublished, q(i, 0), q(i, 1));
  return out;
}

inline Samples by_axis(const Eigen::VectorXd& stacked) {
  Samples out(stacked.size() / 2, 2);
  for (Eigen::Index i = 0; i < out.rows(); ++i) out.row(i) << stacked[2 * i], stacked[2 * i + 1];
  return out;
}

/// What four link parameters leave unexplained.
inline Study calibrated_arm() {
  const RowsN train = planar_grid(kCoarseStep), test = planar_grid(kTestStep);
  const Eigen::VectorXd d = deflections(train);
  const Eigen::Vector4d links = link_columns(train).colPivHouseholderQr().solve(d);
  return {.train = {normalised_to(train, train), by_axis(d - link_columns(train) * links)},
          .test = {normalised_to(train, test),
                   by_axis(deflections(test) - link_columns(test) * links)}};
}

/// The position itself, nothing known of the arm.
inline Data positions(const RowsN& box, const RowsN& q) {
  return {normalised_to(box, q),
          by_axis(deflections(q) + link_columns(q) * Eigen::Vector4d(1, 1, 0, 0))};
}

inline Study positions(double step) {
  const RowsN train = planar_grid(step), test = planar_grid(kTestStep);
  return {.train = positions(train, train), .test = positions(train, test)};
}

}  // namespace plumb::offline::bench
