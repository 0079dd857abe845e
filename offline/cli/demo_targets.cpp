// SPDX-License-Identifier: Apache-2.0
#include "cli/demo_targets.hpp"

#include <fmt/format.h>

#include "arm/parameter.hpp"
#include "cell/joint_columns.hpp"
#include "cell/random.hpp"
#include "numbers/spectrum.hpp"
#include "plumb/runtime/chain.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

constexpr double kMargin = 0.15;         // of the joint range, kept free at each end
constexpr double kSmallestValue = 0.08;  // of the scaled Jacobian
constexpr int kMostTries = 2000;         // poses, most of which are refused

std::vector<double> somewhere(const format::Chain& chain, Random& random) {
  std::vector<double> q;
  for (const auto& row : chain.joints) {
    const double share = kMargin + (1.0 - 2.0 * kMargin) * random.unit();
    q.push_back(row.q_min + share * (row.q_max - row.q_min));
  }
  return q;
}

/// Smallest singular value of the Jacobian, lengths divided by the reach.
double dexterity(const Chain& arm, const std::vector<double>& q, double reach_m) {
  ChainFrames frames;
  arm.frames(q, frames);
  Jacobian J;
  jacobian(arm, frames, J);
  Eigen::MatrixXd scaled = J.leftCols(arm.joints());
  scaled.topRows<3>() /= reach_m;
  return jacobi_singular_values(scaled)(std::min(6, arm.joints()) - 1);
}

std::string header(const Cell& cell) {
  std::string out = "pose,x_mm,y_mm,z_mm,qw,qx,qy,qz";
  for (int i = 0; i < cell.joints(); ++i)
    out += fmt::format(",{}{}_{}", cell.joints() > 6 ? "qc" : "q", i + 1,
                       show::unit(show::slides(cell.nominal.joints[i])));
  return out + "\n";
}

std::string line(const Cell& cell, int number, const Chain& arm, const std::vector<double>& q) {
  const format::Pose pose = to_pose(arm.forward(q));
  std::string out = fmt::format("T{:02}", number);
  for (double p : pose.p) out += fmt::format(",{:.6f}", show::to_mm(p));
  for (double e : pose.q) out += fmt::format(",{:.12f}", e);
  const auto values = values_at(q, cell.nominal);
  for (std::size_t i = 0; i < q.size(); ++i)
    out += fmt::format(",{:.6f}", show::shown(values[i], show::slides(cell.nominal.joints[i])));
  return out + "\n";
}

}  // namespace

std::string demo_targets(const Cell& cell, int count) {
  const Chain arm(cell.nominal);
  const double reach_m = reach(cell.nominal);
  Random random(cell.measurement.seed);
  std::string out = header(cell);
  int found = 0;
  for (int i = 0; i < kMostTries && found < count; ++i) {
    const auto q = somewhere(cell.nominal, random);
    if (dexterity(arm, q, reach_m) > kSmallestValue) out += line(cell, ++found, arm, q);
  }
  return out;
}

}  // namespace plumb::offline::cli
