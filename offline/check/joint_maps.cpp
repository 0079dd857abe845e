// SPDX-License-Identifier: Apache-2.0
#include "check/joint_maps.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "check/constants.hpp"
#include "check/linear_placement.hpp"
#include "numbers/cholesky.hpp"
#include "numbers/rotation_fit.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

/// Standard deviation of a number that the poses do not determine.
constexpr double kUnknown = 1e9;
/// Steps of a fit, which ends where one lowers the cost by less than this share.
constexpr int kMapSteps = 40;
constexpr double kMapFall = 1e-6;

double wrapped(double angle) { return std::remainder(angle, 2.0 * M_PI); }

/// A start for the nonlinear fit: joint zeros, and the joint whose factor is free.
struct MapLead {
  std::vector<double> zero, factor;
  int scaled = -1;
  LinearPlacement loose;
};

class JointMapSearch {
 public:
  JointMapSearch(const format::Chain& chain, const Measurements& few, long& tried)
      : rows_(chain), chain_(chain), few_(few), placer_(few.p_M, few.has_axis), tried_(tried) {
    const int n = joints();
    for (int j = 0; j < n; ++j) {
      const auto& row = chain.joints[static_cast<std::size_t>(j)];
      if (row.type != format::JointType::kRevolute || !(row.scale > 0.0)) continue;
      turning_.push_back(j);
      if (j > 0 && j + 1 < n) inner_.push_back(j);
    }
    X_BT_.resize(static_cast<std::size_t>(few.size()));
  }

  std::vector<JointMap> work() {
    look_at_zeros();
    finish();
    for (const int j : turning_) {
      look_at_factors(j);
      finish();
    }
    std::sort(out_.begin(), out_.end(),
              [](const JointMap& a, const JointMap& b) { return a.rms_m < b.rms_m; });
    if (out_.size() > check::kMapsKept) out_.resize(check::kMapsKept);
    return std::move(out_);
  }

 private:
  int joints() const { return static_cast<int>(rows_.joints.size()); }

  // ---- search on a grid, by linear placement

  void look_at_zeros() {
    MapLead lead = plain();
    for (std::size_t a = 0; a < inner_.size(); ++a)
      for (double first = -M_PI + check::kZeroStep; first < M_PI + 1e-9;
           first += check::kZeroStep) {
        lead.zero[static_cast<std::size_t>(inner_[a])] = first;
        offer(lead);
        for (std::size_t b = a + 1; b < inner_.size(); ++b) {
          double& second = lead.zero[static_cast<std::size_t>(inner_[b])];
          for (second = -M_PI + check::kZeroStep; second < M_PI + 1e-9; second += check::kZeroStep)
            offer(lead);
          second = 0.0;
        }
        lead.zero[static_cast<std::size_t>(inner_[a])] = 0.0;
      }
  }

  void look_at_factors(int j) {
    const auto q = few_.q.col(j);
    const double most = q.cwiseAbs().maxCoeff();
    const double spread = (q.array() - q.mean()).abs().maxCoeff();
    if (spread < check::kTellsFactor_rad) return;
    MapLead lead = plain();
    lead.scaled = j;
    const bool has_zero = std::find(inner_.begin(), inner_.end(), j) != inner_.end();
    const double step = check::kFactorStep_rad / spread, last = check::kMostAngle / most;
    for (double factor = -last; factor <= last; factor += step) {
      lead.factor[static_cast<std::size_t>(j)] = factor;
      double& zero = lead.zero[static_cast<std::size_t>(j)];
      for (zero = 0.0; zero < (has_zero ? 2.0 * M_PI - 1e-9 : 1e-9); zero += check::kZeroStep)
        offer(lead);
    }
  }

  MapLead plain() const {
    const auto n = static_cast<std::size_t>(joints());
    return {std::vector<double>(n, 0.0), std::vector<double>(n, 1.0), -1, {}};
  }

  void offer(MapLead& lead) {
    ++tried_;
    poses(lead.zero, lead.factor, X_BT_);
    lead.loose = placer_.place(X_BT_);
    const auto worse = [](const MapLead& a, const MapLead& b) {
      return a.loose.misfit < b.loose.misfit;
    };
    const auto hopeless = [&] {
      return leads_.size() == check::kMapLeads && lead.loose.misfit >= leads_.front().loose.misfit;
    };
    if (hopeless()) return;
    placer_.tighten(lead.loose);
    if (lead.loose.left_handed || hopeless()) return;
    leads_.push_back(lead);
    std::push_heap(leads_.begin(), leads_.end(), worse);
    if (leads_.size() <= check::kMapLeads) return;
    std::pop_heap(leads_.begin(), leads_.end(), worse);
    leads_.pop_back();
  }

  /// X_BT of every row.
  void poses(const std::vector<double>& zero, const std::vector<double>& factor,
             std::vector<Transformd>& out) {
    std::vector<double> q(static_cast<std::size_t>(joints()));
    for (int i = 0; i < few_.size(); ++i) {
      for (std::size_t j = 0; j < q.size(); ++j)
        q[j] =
            factor[j] * few_.q(i, static_cast<Eigen::Index>(j)) + zero[j] / rows_.joints[j].scale;
      out[static_cast<std::size_t>(i)] = chain_.forward(q);
    }
  }

  // ---- nonlinear fit

  /// The unknowns of a fit: frame, target, and the zeros and the factor that are free.
  struct Open {
    std::vector<int> zeros;
    int scaled = -1;
    Eigen::Index size() const {
      return 9 + static_cast<Eigen::Index>(zeros.size()) + (scaled >= 0 ? 1 : 0);
    }
  };

  struct State {
    std::vector<double> zero, factor;
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // of the base in the measurement frame
    Eigen::Vector3d b = Eigen::Vector3d::Zero(), t = Eigen::Vector3d::Zero();
  };

  Eigen::VectorXd residual(const State& s) {
    poses(s.zero, s.factor, X_BT_);
    Eigen::VectorXd out(3 * few_.size());
    for (int i = 0; i < few_.size(); ++i) {
      const Transformd& X = X_BT_[static_cast<std::size_t>(i)];
      const Eigen::Vector3d p = s.R * (X.p + X.R * s.t) + s.b;
      for (int k = 0; k < 3; ++k)
        out(3 * i + k) = few_.has_axis[static_cast<std::size_t>(k)] ? few_.p_M(i, k) - p(k) : 0.0;
    }
    return out;
  }

  static State moved(const State& s, const Open& open, const Eigen::VectorXd& step) {
    State out = s;
    const Eigen::Vector3d turn = step.head<3>();
    const double angle = turn.norm();
    if (angle > 0.0) out.R = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * s.R;
    out.b += step.segment<3>(3);
    out.t += step.segment<3>(6);
    Eigen::Index at = 9;
    for (const int j : open.zeros) out.zero[static_cast<std::size_t>(j)] += step(at++);
    if (open.scaled >= 0) out.factor[static_cast<std::size_t>(open.scaled)] += step(at);
    return out;
  }

  /// The derivative of the predicted points, which is that of the residual with the other sign, by
  /// central differences.
  Eigen::MatrixXd jacobian(const State& s, const Open& open) {
    Eigen::MatrixXd out(3 * few_.size(), open.size());
    for (Eigen::Index k = 0; k < open.size(); ++k) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(open.size());
      const bool is_factor = open.scaled >= 0 && k + 1 == open.size();
      step(k) = is_factor ? 1e-6 * std::abs(s.factor[static_cast<std::size_t>(open.scaled)]) : 1e-6;
      out.col(k) =
          (residual(moved(s, open, -step)) - residual(moved(s, open, step))) / (2.0 * step(k));
    }
    return out;
  }

  /// Result of a Levenberg-Marquardt fit: state, normal matrix and RMS error.
  struct Solved {
    State state;
    Eigen::MatrixXd normal;
    double rms_m = 0.0;
  };

  Solved solve(State state, const Open& open) {
    Eigen::VectorXd r = residual(state);
    double cost = r.squaredNorm(), damping = 1e-4;
    Eigen::MatrixXd N;
    for (int i = 0; i < kMapSteps; ++i) {
      const Eigen::MatrixXd J = jacobian(state, open);
      N = J.transpose() * J;
      const Eigen::VectorXd g = J.transpose() * r;
      bool worth = false;
      for (int attempt = 0; attempt < 8 && !worth; ++attempt, damping *= 10.0) {
        Eigen::MatrixXd damped = N;
        damped.diagonal() += damping * N.diagonal() +
                             Eigen::VectorXd::Constant(N.rows(), 1e-12 * N.diagonal().maxCoeff());
        const State next = moved(state, open, SymmetricSolver(damped).solve(g));
        const Eigen::VectorXd r_next = residual(next);
        const double cost_next = r_next.squaredNorm();
        if (!(cost_next < cost)) continue;
        worth = cost - cost_next > kMapFall * cost;
        state = next;
        r = r_next;
        cost = cost_next;
        damping *= 1e-2;
        if (!worth) break;
      }
      if (!worth) break;
    }
    return {state, N, std::sqrt(cost / static_cast<double>(few_.size()))};
  }

  /// Standard deviation of every zero, then of the factor (relative); huge if the poses do not
  /// determine it. The nominal arm's own errors count as noise.
  static std::vector<double> deviations(const Solved& solved, const Open& open) {
    const std::size_t count = open.zeros.size() + (open.scaled >= 0 ? 1 : 0);
    std::vector<double> out(count, kUnknown);
    if (solved.normal.rows() == 0) return out;
    const Eigen::VectorXd scale = solved.normal.diagonal().cwiseSqrt();
    if (!(scale.minCoeff() > 0.0)) return out;
    const Eigen::VectorXd by = scale.cwiseInverse();
    const Eigen::MatrixXd scaled = by.asDiagonal() * solved.normal * by.asDiagonal();
    const Cholesky unit(scaled);
    if (!unit.exists()) return out;
    const Eigen::MatrixXd inverse =
        unit.solve(Eigen::MatrixXd::Identity(scale.size(), scale.size()).eval());
    const double sigma = solved.rms_m / std::sqrt(3.0);
    for (std::size_t k = 0; k < count; ++k) {
      const auto at = static_cast<Eigen::Index>(9 + k);
      out[k] = sigma * std::sqrt(std::max(0.0, inverse(at, at))) / scale(at);
    }
    if (open.scaled >= 0)
      out.back() /= std::abs(solved.state.factor[static_cast<std::size_t>(open.scaled)]);
    return out;
  }

  static bool tells(const std::vector<double>& deviation, const Open& open) {
    for (std::size_t k = 0; k < deviation.size(); ++k)
      if (!(check::kMapDeviations * deviation[k] <
            (k < open.zeros.size() ? check::kSureZero : check::kSureFactor)))
        return false;
    return true;
  }

  State start_of(const MapLead& lead) {
    State out{lead.zero, lead.factor, {}, {}, lead.loose.target_T};
    out.R = nearest_rotation(lead.loose.M).transpose();
    out.b.setZero();
    const Eigen::VectorXd shift = residual(out);
    for (int k = 0; k < 3; ++k) {
      double sum = 0.0;
      for (int i = 0; i < few_.size(); ++i) sum += shift(3 * i + k);
      out.b(k) = sum / few_.size();
    }
    return out;
  }

  void finish() {
    std::sort_heap(leads_.begin(), leads_.end(), [](const MapLead& a, const MapLead& b) {
      return a.loose.misfit < b.loose.misfit;
    });
    for (const MapLead& lead : leads_) keep(lead);
    leads_.clear();
  }

  /// Fits with all zeros free first, then only with those that differ clearly from 0.
  void keep(const MapLead& lead) {
    Open open;
    open.scaled = lead.scaled;
    for (const int j : inner_)
      if (lead.scaled < 0 || lead.scaled == j) open.zeros.push_back(j);
    Solved solved = solve(start_of(lead), open);
    const std::vector<double> deviation = deviations(solved, open);
    if (!tells(deviation, open)) return;
    if (open.scaled >= 0 && std::abs(solved.state.factor[static_cast<std::size_t>(open.scaled)] -
                                     1.0) < check::kLeastFactor) {
      return;  // without a factor it is a zero alone, which look_at_zeros finds
    }
    std::erase_if(open.zeros, [&](int j) {
      double& zero = solved.state.zero[static_cast<std::size_t>(j)];
      zero = wrapped(zero);
      const bool none = std::abs(zero) < check::kLeastZero;
      if (none) zero = 0.0;
      return none;
    });
    if (open.zeros.empty() && open.scaled < 0) return;
    solved = solve(solved.state, open);
    JointMap map{
        solved.state.zero, solved.state.factor,        open.scaled < 0 ? 0.0 : deviation.back(),
        solved.rms_m,      solved.state.R.transpose(), solved.state.t};
    if (std::none_of(out_.begin(), out_.end(), [&](const JointMap& m) { return same(m, map); }))
      out_.push_back(std::move(map));
  }

  static bool same(const JointMap& a, const JointMap& b) {
    for (std::size_t j = 0; j < a.zero.size(); ++j)
      if (std::abs(wrapped(a.zero[j] - b.zero[j])) > check::kLeastZero ||
          std::abs(a.factor[j] - b.factor[j]) > check::kLeastFactor * std::abs(a.factor[j]))
        return false;
    return true;
  }

  const format::Chain& rows_;
  Chain chain_;
  const Measurements& few_;
  LinearPlacer placer_;
  long& tried_;
  std::vector<int> turning_, inner_;
  std::vector<Transformd> X_BT_;
  std::vector<MapLead> leads_;
  std::vector<JointMap> out_;
};

}  // namespace

std::vector<JointMap> joint_maps(const format::Chain& chain, const Measurements& few, long& tried) {
  return JointMapSearch(chain, few, tried).work();
}

}  // namespace plumb::offline
