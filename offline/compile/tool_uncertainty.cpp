// SPDX-License-Identifier: Apache-2.0
#include "compile/tool_uncertainty.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "arm/geometry_derivative.hpp"
#include "cell/random.hpp"
#include "compile/trained_poses.hpp"

namespace plumb::offline {
namespace {

std::optional<Parameter> parameter_named(const format::Model& arm, const std::string& name) {
  if (auto found = robot_parameter(arm.calibrated, name)) return found;
  for (auto& parameter : effect_parameters(arm))
    if (parameter.name == name) return std::move(parameter);
  return std::nullopt;
}

Eigen::MatrixXd covariance_of(const format::Provenance& p) {
  const auto n = static_cast<Eigen::Index>(p.parameter_names.size());
  Eigen::MatrixXd out(n, n);
  std::size_t next = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k <= i; ++k)
      out(i, k) = out(k, i) = static_cast<double>(p.covariance[next++]);
  return out;
}

/// 1 sigma to which the angles of a link are built where nothing more is known of it [rad]: the
/// default of [fit] prior_rad.
constexpr double kBuilt_rad = 0.5e-3;

/// Adds the angles of the last link that were not fitted, with what arms are built to. Positions do
/// not show them: the target is fitted, and moves as they do. Returns how many there are.
int add_last_link(const format::Chain& chain, std::vector<Parameter>& parameters,
                  Eigen::MatrixXd& covariance) {
  const auto fitted = [&](const auto& is_it) {
    return std::any_of(parameters.begin(), parameters.end(), is_it);
  };
  const bool complete =
      fitted([](const Parameter& p) { return p.kind == Parameter::Kind::kLinkTwist; });
  const std::string last = chain.joints.back().name;
  const std::vector<std::string> angles =
      complete ? std::vector<std::string>{".post.ex", ".post.ey", ".post.ez"}
               : std::vector<std::string>{".theta", ".alpha"};
  int added = 0;
  for (const auto& angle : angles)
    if (const auto p = robot_parameter(chain, last + angle);
        p && !fitted([&](const Parameter& known) { return known.name == p->name; })) {
      parameters.push_back(*p);
      ++added;
    }
  const Eigen::Index known = covariance.rows();
  covariance.conservativeResizeLike(Eigen::MatrixXd::Zero(known + added, known + added));
  covariance.diagonal().tail(added).setConstant(kBuilt_rad * kBuilt_rad);
  return added;
}

}  // namespace

ToolUncertainty tool_uncertainty(const format::Model& model) {
  ToolUncertainty out;
  if (model.provenance.covariance.empty()) return out;
  ArmState state;
  state.arm.calibrated = model.calibrated;
  state.arm.effects = model.effects;
  state.arm.mechanics = model.mechanics;
  state.arm.gravity = model.gravity;
  std::vector<Parameter> parameters;
  for (const auto& name : model.provenance.parameter_names) {
    const auto parameter = parameter_named(state.arm, name);
    if (!parameter) return out;
    parameters.push_back(*parameter);
  }
  const auto fitted = static_cast<Eigen::Index>(parameters.size());
  Eigen::MatrixXd covariance = covariance_of(model.provenance);
  out.turn_unmeasured = add_last_link(model.calibrated, parameters, covariance) > 0;
  const GeometryDerivative geometry(
      state, parameters, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size())));
  const JointRanges box = trained_box(model);
  Random random(1);
  GeometryDerivative::Point point;
  for (int i = 0; i < kAuditPoses; ++i) {
    const auto q = somewhere_in(box, random);
    geometry.evaluate(q, {}, point);
    const auto trace = [&](const auto& J) {
      return std::max(0.0,
                      (J * covariance.topLeftCorner(J.cols(), J.cols()) * J.transpose()).trace());
    };
    const double sigma = std::sqrt(trace(point.columns.topRows<3>().leftCols(fitted)));
    out.mean_m += sigma / kAuditPoses;
    out.max_m = std::max(out.max_m, sigma);
    // A turn moves a point in a random direction from its axis by sqrt(2/3) of the lever.
    out.beside_m +=
        kBeside_m * std::sqrt(2.0 / 3.0 * trace(point.columns.bottomRows<3>())) / kAuditPoses;
  }
  return out;
}

}  // namespace plumb::offline
