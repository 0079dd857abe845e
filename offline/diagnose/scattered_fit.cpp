// SPDX-License-Identifier: Apache-2.0
#include "diagnose/scattered_fit.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "noise/repeatability.hpp"

namespace plumb::offline {
namespace {

/// Poses first to last - 1 of the whitened fit, read at one stop.
struct Stop {
  Eigen::Index first, last;
};

std::vector<Stop> stops_of(const WhitenedFit& s, const Segment& at) {
  const std::vector<int> stop =
      stops(*s.measured, {s.row.begin() + at.begin, s.row.begin() + at.end});
  std::vector<Stop> out;
  for (Eigen::Index i = 0; i < at.size(); ++i)
    if (i > 0 && stop[i] == stop[i - 1])
      out.back().last = at.begin + i + 1;
    else
      out.push_back({at.begin + i, at.begin + i + 1});
  return out;
}

std::vector<Stop> stops_of_fit(const WhitenedFit& s) {
  std::vector<Stop> out;
  for (const Segment& fold : s.folds) {
    const auto some = stops_of(s, fold);
    out.insert(out.end(), some.begin(), some.end());
  }
  return out;
}

LineTable table_of(const WhitenedFit& s, const std::vector<Stop>& stops) {
  std::vector<Eigen::Index> first;
  for (const Stop& stop : stops) first.push_back(stop.first);
  return s.table.picked(first);
}

Eigen::MatrixXd merged(const Eigen::MatrixXd& lines, const std::vector<Stop>& stops,
                       const LineTable& from, const LineTable& to) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(to.lines(), lines.cols());
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const auto stop = static_cast<Eigen::Index>(i);
    auto block = out.middleRows(to.begin(stop), to.count(stop));
    for (Eigen::Index k = stops[i].first; k < stops[i].last; ++k)
      block += lines.middleRows(from.begin(k), from.count(k));
    block /= std::sqrt(static_cast<double>(stops[i].last - stops[i].first));
  }
  return out;
}

ScatterLines lines_of_stops(const WhitenedFit& s, const std::vector<Stop>& stops) {
  const LineTable table = table_of(s, stops);
  ScatterLines out{merged(s.y, stops, s.table, table),
                   merged(s.U, stops, s.table, table),
                   {},
                   table,
                   s.noise.variance,
                   s.noise.known ? s.noise.dof : 0.0};
  for (const auto& motion : s.joint) out.joint.emplace_back(merged(motion, stops, s.table, table));
  return out;
}

/// What is known of each stop, pose by pose.
void keep_first_of(const std::vector<Stop>& stops, const WhitenedFit& s, WhitenedFit& out) {
  for (const Stop& stop : stops) {
    const auto at = static_cast<std::size_t>(stop.first);
    const double root = std::sqrt(static_cast<double>(stop.last - stop.first));
    out.row.push_back(s.row[at]);
    out.frames.push_back(s.frames[at]);
    out.loads.push_back(s.loads[at]);
    out.context.push_back(s.context[at]);
    out.X_MB.push_back(s.X_MB[at]);
    out.reading.push_back(s.reading[at]);
    out.arm_B.push_back(s.arm_B[at]);
    for (Eigen::Index k = s.table.begin(stop.first); k < s.table.begin(stop.first + 1); ++k)
      out.sigma.push_back(s.sigma[static_cast<std::size_t>(k)] / root);
  }
}

PoseRoot root_of(const ScatterLines& lines, const JointScatter& scatter, Eigen::Index pose) {
  PoseRoot V =
      scatter.noise_variance * PoseRoot::Identity(lines.table.count(pose), lines.table.count(pose));
  for (std::size_t j = 0; j < lines.joint.size(); ++j) {
    const auto g = lines.joint[j].segment(lines.table.begin(pose), lines.table.count(pose));
    V += scatter.variance(static_cast<Eigen::Index>(j)) * g * g.transpose();
  }
  return V.llt().matrixL();
}

template <class Lines>
void divide(const std::vector<PoseRoot>& root, const LineTable& table, Lines& lines) {
  for (std::size_t i = 0; i < root.size(); ++i) {
    const auto pose = static_cast<Eigen::Index>(i);
    auto block = lines.middleRows(table.begin(pose), table.count(pose));
    root[i].triangularView<Eigen::Lower>().solveInPlace(block);
  }
}

double typical_sigma(const WhitenedFit& s) {
  double squares = 0.0;
  Eigen::Index lines = 0;
  for (Eigen::Index i = 0; i < s.poses(); ++i) {
    const Eigen::Index points = s.reading[static_cast<std::size_t>(i)].point_lines();
    lines += points;
    for (Eigen::Index k = 0; k < points; ++k)
      squares += std::pow(s.sigma[s.table.begin(i) + k], 2) * s.root[i].row(k).squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(std::max<Eigen::Index>(1, lines)));
}

}  // namespace

ScatterLines scatter_lines(const WhitenedFit& whitened) {
  return lines_of_stops(whitened, stops_of_fit(whitened));
}

ScatterLines scatter_lines(const WhitenedFit& s, const Eigen::MatrixXd& columns) {
  const auto stops = stops_of_fit(s);
  ScatterLines out = lines_of_stops(s, stops);
  Eigen::MatrixXd J(out.U.rows(), out.U.cols() + columns.cols());
  J << out.U, merged(columns, stops, s.table, out.table);
  out.U = orthonormal(J, J.rows()).U;
  return out;
}

Repeatability repeatability_of(const WhitenedFit& s, const JointScatter& scatter) {
  std::vector<Eigen::Index> of_points;
  std::vector<double> sigma_m;
  for (Eigen::Index i = 0; i < s.fit_poses(); ++i)
    for (Eigen::Index k = 0; k < s.reading[static_cast<std::size_t>(i)].point_lines(); ++k) {
      of_points.push_back(s.table.begin(i) + k);
      sigma_m.push_back(s.sigma[static_cast<std::size_t>(of_points.back())]);
    }
  ScatterLines lines;
  for (const auto& motion : s.joint) lines.joint.emplace_back(motion(of_points));
  SquaredMotions motions;
  motions.add(lines, sigma_m);
  return motions.with(scatter);
}

WhitenedFit with_scatter(const WhitenedFit& s, const JointScatter& scatter) {
  WhitenedFit out;
  out.cell = s.cell;
  out.measured = s.measured;
  out.chain = s.chain;
  out.sensors = s.sensors;
  out.noise = s.noise;
  out.noise.variance = 1.0;
  std::vector<Stop> stops;
  for (const Segment& fold : s.folds) {
    const auto begin = static_cast<Eigen::Index>(stops.size());
    const auto some = stops_of(s, fold);
    stops.insert(stops.end(), some.begin(), some.end());
    out.folds.push_back({begin, static_cast<Eigen::Index>(stops.size())});
  }
  out.held.begin = static_cast<Eigen::Index>(stops.size());
  for (Eigen::Index i = s.held.begin; i < s.held.end; ++i) stops.push_back({i, i + 1});
  out.held.end = static_cast<Eigen::Index>(stops.size());
  out.table = table_of(s, stops);
  out.fit_lines = out.table.begin(out.held.begin);
  keep_first_of(stops, s, out);
  ScatterLines lines = lines_of_stops(s, stops);
  for (Eigen::Index i = 0; i < out.held.end; ++i) out.root.push_back(root_of(lines, scatter, i));
  out.base = merged(s.base, stops, s.table, out.table);
  out.tool = merged(s.tool, stops, s.table, out.table);
  divide(out.root, out.table, lines.y);
  divide(out.root, out.table, lines.U);
  divide(out.root, out.table, out.base);
  divide(out.root, out.table, out.tool);
  for (auto& motion : lines.joint) divide(out.root, out.table, motion);
  out.joint = std::move(lines.joint);
  out.y = std::move(lines.y);
  auto [U, half] = orthonormal(lines.U, out.fit_lines);
  out.rank = U.cols();
  out.U = std::move(U);
  out.half_information = s.half_information * half;
  out.correction = s.correction + out.half_information * clear_residual(out);
  out.sigma_m = typical_sigma(out);
  fold_joints(out);
  return out;
}

}  // namespace plumb::offline
