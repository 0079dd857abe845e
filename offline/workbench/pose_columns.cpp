// SPDX-License-Identifier: Apache-2.0
#include "workbench/pose_columns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "arm/predicted_points.hpp"
#include "compare/worst_band.hpp"
#include "plumb/runtime/chain.hpp"
#include "program/problem.hpp"
#include "show/verdict_json.hpp"

namespace plumb::offline::workbench {
namespace {

using figures::RunResults;

constexpr double kMm = 1e3, kDeg = 180.0 / std::numbers::pi;

/// To a millionth, which keeps the text short; null if there is no number.
Json shown(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(1e6 * value) / 1e6 + 0.0;
}

template <class Column>
Json column(const Column& values, double scale) {
  Json out = Json::array();
  for (Eigen::Index i = 0; i < values.size(); ++i) out.push_back(shown(scale * values(i)));
  return out;
}

Json axes_mm(const Rows3& rows) {
  Json out = Json::array();
  for (int k = 0; k < 3; ++k) out.push_back(column(rows.col(k), kMm));
  return out;
}

Json norms_mm(const Rows3& rows) { return column(rows.rowwise().norm(), kMm); }

Rows3 points_B(const RunResults& results) {
  return places_B(results.run.fit.calibration.state, results.measured);
}

/// Names with their columns, all of as many rows as there are poses.
std::vector<std::pair<std::string, Eigen::VectorXd>> contexts_of(const ContextRows& rows) {
  std::vector<std::pair<std::string, Eigen::VectorXd>> out;
  for (Eigen::Index k = 0; k < rows.temperature.cols(); ++k)
    out.emplace_back(rows.sensors[static_cast<std::size_t>(k)] + "_degC", rows.temperature.col(k));
  if (rows.payload.rows() > 0) out.emplace_back("payload_kg", rows.payload.col(0));
  if (rows.time_s.size() > 0) out.emplace_back("time_s", rows.time_s);
  for (Eigen::Index j = 0; j < rows.direction.cols() && rows.has_direction(); ++j)
    out.emplace_back(fmt::format("dir_j{}", j + 1), rows.direction.col(j));
  return out;
}

/// Where the run fails, and the rows that lie there; no rows where no range of a joint stands out.
Json worst_region(const RunResults& results, const std::string& where) {
  const auto band = compare::worst_band(results.cell, results.measured, results.run.fit);
  return {{"sentence", where}, {"rows", band ? band->rows : std::vector<int>()}};
}

Json sets_of(const RunResults& results) {
  std::vector<const char*> out(static_cast<std::size_t>(results.measured.size()), "out");
  for (const int row : results.held) out[static_cast<std::size_t>(row)] = "held";
  for (const int row : results.fit) out[static_cast<std::size_t>(row)] = "fit";
  return out;
}

Json joints_of(const RunResults& results, Json& units) {
  Json out = Json::array();
  const auto& joints = results.cell.nominal.joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const bool turns = joints[j].type == format::JointType::kRevolute;
    units.push_back(turns ? "deg" : "mm");
    out.push_back(column(results.measured.q.col(static_cast<Eigen::Index>(j)), turns ? kDeg : kMm));
  }
  return out;
}

}  // namespace

std::vector<std::string> context_names(const ContextRows& rows) {
  std::vector<std::string> out;
  for (const auto& [name, values] : contexts_of(rows)) out.push_back(name);
  return out;
}

Json pose_columns(const RunResults& results, const Answers& answers) {
  const ArmState& state = results.run.fit.calibration.state;
  const Measurements& measured = results.measured;
  Json units = Json::array(), rows = Json::array(), context = Json::object();
  for (int i = 0; i < measured.size(); ++i) rows.push_back(i);
  Json q = joints_of(results, units);
  for (const auto& [name, values] : contexts_of(measured.context))
    context[name] = column(values, 1.0);
  Json out{{"run", results.run.number},
           {"e", "measured - predicted, base frame [mm]"},
           {"row", std::move(rows)},
           {"pose", measured.pose},
           {"set", sets_of(results)},
           {"q", std::move(q)},
           {"q_units", std::move(units)},
           {"point_mm", axes_mm(points_B(results))},
           {"before_mm", axes_mm(to_base(state, measured, results.before_M))},
           {"after_mm", axes_mm(to_base(state, measured, results.after_M))},
           {"before_norm_mm", norms_mm(results.before_M)},
           {"after_norm_mm", norms_mm(results.after_M)},
           {"context", std::move(context)},
           {"worst_region", worst_region(results, answers.where)},
           {"reach_mm", shown(kMm * reach(state.arm.calibrated))}};
  show::add_verdict(results.cell, results.run.fit, answers, out);
  return out;
}

Json arm_frames(const RunResults& results, int row) {
  if (row < 0 || row >= results.measured.size())
    throw Failure(Exit::kUsage, {.code = "E-SERVE-REQUEST",
                                 .message = fmt::format("there is no row {}", row),
                                 .help = "rows count from 0, as /api/runs/N/poses lists them"});
  const Chain chain(results.run.fit.calibration.state.arm.calibrated);
  std::vector<double> q(static_cast<std::size_t>(chain.joints()));
  for (std::size_t j = 0; j < q.size(); ++j)
    q[j] = results.measured.q(row, static_cast<Eigen::Index>(j));
  ChainFrames found;
  chain.frames(q, found);
  Json origins = Json::array(), axes = Json::array();
  const auto add = [&](const Eigen::Vector3d& p, const Matrix3& R) {
    origins.push_back({shown(kMm * p(0)), shown(kMm * p(1)), shown(kMm * p(2))});
    Json of = Json::array();
    for (int k = 0; k < 3; ++k) of.push_back({shown(R(0, k)), shown(R(1, k)), shown(R(2, k))});
    axes.push_back(std::move(of));
  };
  const auto add_frame = [&](const Transformd& X) { add({X.p(0), X.p(1), X.p(2)}, X.R); };
  add(Eigen::Vector3d::Zero(), Matrix3::Identity());
  for (std::size_t j = 0; j < q.size(); ++j) add_frame(found.joint[j]);
  add_frame(found.tip);
  add(points_B(results).row(row).transpose(), found.tip.R);
  return {{"row", row}, {"origins_mm", std::move(origins)}, {"axes", std::move(axes)}};
}

}  // namespace plumb::offline::workbench
