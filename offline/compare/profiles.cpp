// SPDX-License-Identifier: Apache-2.0
#include "compare/profiles.hpp"

#include <algorithm>
#include <cmath>

#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "cell/setups.hpp"
#include "compare/constants.hpp"
#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/detail/loads.hpp"

namespace plumb::offline::compare {
namespace {

using Kind = ErrorProfile::Kind;
using Unit = ErrorProfile::Unit;

class Profiler {
 public:
  Profiler(const Cell& cell, const Measurements& measured, const ArmState& state,
           const SamplesOf& samples)
      : cell_(cell), measured_(measured), state_(state), samples_(samples) {}

  std::vector<ErrorProfile> all() {
    joints();
    regions();
    payload();
    torques();
    directions();
    temperatures();
    order();
    setups();
    return std::move(out_);
  }

 private:
  void add(Kind kind, std::string name, Unit unit, const std::function<double(int)>& value,
           const std::vector<double>& labels = {}) {
    ErrorProfile empty;
    empty.kind = kind;
    empty.name = std::move(name);
    empty.unit = unit;
    out_.push_back(profile(std::move(empty), samples_(value), labels));
  }

  void add_if_it_varies(Kind kind, std::string name, Unit unit, const Eigen::VectorXd& value) {
    double low = INFINITY, high = -INFINITY;
    for (const double v : value)
      if (!std::isnan(v)) low = std::min(low, v), high = std::max(high, v);
    if (!(high - low > kVaries * std::max(std::abs(low), std::abs(high)))) return;
    add(kind, std::move(name), unit, [&](int row) { return value(row); });
  }

  void joints() {
    for (int j = 0; j < cell_.joints(); ++j) {
      const auto& joint = cell_.nominal.joints[j];
      const bool slides = joint.type == format::JointType::kPrismatic;
      add(Kind::kJoint, joint.name, slides ? Unit::kLength : Unit::kAngle,
          [&, j](int row) { return measured_.q(row, j); });
    }
  }

  void regions() {
    const Rows3 places = places_B(state_, measured_);
    const auto point = [&](int row) -> Vector3 { return places.row(row).transpose(); };
    add(Kind::kRegion, "reach", Unit::kLength, [&](int row) {
      const Vector3 p = point(row);
      return std::hypot(p(0), p(1));
    });
    add(Kind::kRegion, "height", Unit::kLength, [&](int row) { return point(row)(2); });
    add(Kind::kRegion, "azimuth", Unit::kAngle, [&](int row) {
      const Vector3 p = point(row);
      return std::atan2(p(1), p(0));
    });
  }

  void payload() {
    if (measured_.context.payload.rows() > 0)
      add_if_it_varies(Kind::kLoad, "payload", Unit::kMass, measured_.context.payload.col(0));
  }

  void torques() {
    format::Mechanics mechanics = mechanics_of(cell_);
    const bool known = mechanics.payload_kg > 0.0 || !mechanics.links.empty();
    if (!known && measured_.context.payload.rows() == 0) mechanics.payload_kg = 1.0;
    const RowsN torque = torques_of(mechanics);
    for (int j = 0; j < cell_.joints(); ++j) {
      if (cell_.nominal.joints[j].type == format::JointType::kPrismatic) continue;
      if (torque.col(j).maxCoeff() - torque.col(j).minCoeff() <
          kTorqueVaries * torque.cwiseAbs().maxCoeff())
        continue;
      add_if_it_varies(
          Kind::kLoad,
          cell_.nominal.joints[j].name + (known ? " torque" : " torque of 1 kg at the flange"),
          Unit::kTorque, torque.col(j));
    }
  }

  RowsN torques_of(const format::Mechanics& mechanics) const {
    const Chain chain(state_.arm.calibrated);
    const Transformd X_TF = from_pose(cell_.nominal.tool).inverse();
    RowsN out(measured_.q.rows(), measured_.q.cols());
    ChainFrames frames;
    Loads loads;
    for (Eigen::Index i = 0; i < out.rows(); ++i) {
      chain.frames({measured_.q.row(i).data(), static_cast<std::size_t>(out.cols())}, frames);
      weigh(chain, frames, mechanics, cell_.gravity, X_TF,
            context_at(measured_.context, i, {}).known, loads);
      for (int j = 0; j < cell_.joints(); ++j) out(i, j) = loads.torque(j, chain, frames);
    }
    return out;
  }

  void directions() {
    const auto& direction = measured_.context.direction;
    for (Eigen::Index j = 0; j < direction.cols(); ++j) {
      std::vector<double> labels;
      for (const double sign : {-1.0, 0.0, 1.0})
        if ((direction.col(j).array() == sign).any()) labels.push_back(sign);
      if (labels.size() < 2) continue;
      add(
          Kind::kContext, cell_.nominal.joints[static_cast<std::size_t>(j)].name + " direction",
          Unit::kSign, [&](int row) { return direction(row, j); }, labels);
    }
  }

  void temperatures() {
    const auto& c = measured_.context;
    for (std::size_t k = 0; k < c.sensors.size(); ++k)
      add_if_it_varies(Kind::kContext, c.sensors[k], Unit::kTemperature,
                       c.temperature.col(static_cast<Eigen::Index>(k)));
  }

  void order() {
    const auto& time = measured_.context.time_s;
    if (time.size() > 0)
      add_if_it_varies(Kind::kContext, "time", Unit::kTime, (time.array() - time(0)).matrix());
    add(Kind::kOrder, "order", Unit::kRow, [](int row) { return row + 1.0; });
  }

  /// By set-up: a day on which something went wrong then stands out.
  void setups() {
    const MeasurementSettings& m = cell_.measurement;
    if (measured_.setup.empty() || setup_count(m) < 2) return;
    std::vector<double> labels;
    std::vector<std::string> names;
    for (int k = 0; k < setup_count(m); ++k) {
      labels.push_back(k);
      names.push_back(setup_name(m, k));
    }
    add(
        Kind::kSetup, "set-up", Unit::kName,
        [&](int row) { return static_cast<double>(setup_of(measured_, row)); }, labels);
    out_.back().names = std::move(names);
    // An error of three coordinates is larger than one of a single one, and that is no pattern.
    if (differ_in_axes()) out_.back().ln_p = 0.0;
  }

  bool differ_in_axes() const {
    for (int i = 1; i < measured_.size(); ++i)
      if (measured_.axes(i) != measured_.axes(0)) return true;
    return false;
  }

  const Cell& cell_;
  const Measurements& measured_;
  const ArmState& state_;
  const SamplesOf& samples_;
  std::vector<ErrorProfile> out_;
};

}  // namespace

std::vector<ErrorProfile> profiles(const Cell& cell, const Measurements& measured,
                                   const ArmState& state, const SamplesOf& samples) {
  auto out = Profiler(cell, measured, state, samples).all();
  set_matters(out);
  return out;
}

}  // namespace plumb::offline::compare
