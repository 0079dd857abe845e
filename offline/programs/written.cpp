// SPDX-License-Identifier: Apache-2.0
#include "programs/written.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace plumb::offline::programs {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kUnitWithin = 0.01;  // quaternions of three digits are this far from length 1
constexpr int kMostDecimals = 12;

Matrix3 of_turns(const std::array<double, 3>& wpr) {
  return product(product(rot_z(wpr[2] * kDegree).R, rot_y(wpr[1] * kDegree).R),
                 rot_x(wpr[0] * kDegree).R);
}

/// The angle that differs from `angle` by whole turns and lies nearest to `like` [deg].
double near_turn(double angle, double like) {
  return angle + 360.0 * std::round((like - angle) / 360.0);
}

/// W, P, R [deg] of R = Rz(R) Ry(P) Rx(W), nearest to `like`.
std::array<double, 3> turns_like(const Matrix3& R, const std::array<double, 3>& like) {
  const double cosine = std::hypot(R(0, 0), R(1, 0));
  std::array<double, 3> best{};
  double nearest = std::numeric_limits<double>::infinity();
  for (const double sign : {1.0, -1.0}) {
    const std::array<double, 3> angles{std::atan2(sign * R(2, 1), sign * R(2, 2)),
                                       std::atan2(-R(2, 0), sign * cosine),
                                       std::atan2(sign * R(1, 0), sign * R(0, 0))};
    std::array<double, 3> way{};
    double far = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      way[i] = near_turn(angles[i] / kDegree, like[i]);
      far += std::abs(way[i] - like[i]);
    }
    if (far < nearest) {
      nearest = far;
      best = way;
    }
  }
  return best;
}

/// The rotation vector of R, or another one of the same rotation that is nearer to `like`.
Vector3 vector_like(const Matrix3& R, const Vector3& like) {
  const Vector3 r = rotation_vector(R);
  const double angle = r.norm();
  if (angle < 1e-9) return like.norm() < 1.0 ? r : like;
  const Vector3 axis = r / angle;
  const double along = axis.dot(like);
  const double turn = 2.0 * std::numbers::pi;
  return axis * (angle + turn * std::round((along - angle) / turn));
}

}  // namespace

std::optional<Transformd> pose_of(Notation notation, std::span<const double> v) {
  if (of_joints(notation) || v.size() != (notation == Notation::kQuaternion ? 7U : 6U))
    return std::nullopt;
  const double unit = notation == Notation::kVector ? 1.0 : 1e-3;
  Transformd X;
  X.p = Vector3(v[0], v[1], v[2]) * unit;
  if (notation == Notation::kQuaternion) {
    const double norm = std::sqrt(v[3] * v[3] + v[4] * v[4] + v[5] * v[5] + v[6] * v[6]);
    if (!(std::abs(norm - 1.0) < kUnitWithin)) return std::nullopt;
    X.R = from_pose({{}, {v[3] / norm, v[4] / norm, v[5] / norm, v[6] / norm}}).R;
  } else if (notation == Notation::kVector) {
    X.R = rotation_of({v[3], v[4], v[5]});
  } else {
    X.R = notation == Notation::kXyz ? of_turns({v[3], v[4], v[5]}) : of_turns({v[5], v[4], v[3]});
  }
  return X;
}

std::optional<Transformd> pose_of(const Written& written) {
  return pose_of(written.notation, values_of(written));
}

std::vector<double> values_of(const Written& written) {
  std::vector<double> out;
  for (const Number& number : written.numbers) out.push_back(number.value);
  return out;
}

std::vector<double> numbers_like(const Transformd& X, Notation notation,
                                 std::span<const double> like) {
  const double unit = notation == Notation::kVector ? 1.0 : 1e3;
  std::vector<double> out{X.p(0) * unit, X.p(1) * unit, X.p(2) * unit};
  if (notation == Notation::kQuaternion) {
    const auto q = to_pose(X).q;
    double along = 0.0;
    for (std::size_t i = 0; i < 4; ++i) along += q[i] * like[3 + i];
    for (const double part : q) out.push_back(along < 0.0 ? -part : part);
  } else if (notation == Notation::kVector) {
    const Vector3 r = vector_like(X.R, {like[3], like[4], like[5]});
    out.insert(out.end(), {r(0), r(1), r(2)});
  } else if (notation == Notation::kXyz) {
    const auto t = turns_like(X.R, {like[3], like[4], like[5]});
    out.insert(out.end(), {t[0], t[1], t[2]});
  } else {
    const auto t = turns_like(X.R, {like[5], like[4], like[3]});
    out.insert(out.end(), {t[2], t[1], t[0]});
  }
  return out;
}

int decimals_of(std::string_view text) {
  const std::size_t power = std::min(text.find_first_of("eE"), text.size());
  const std::size_t point = std::min(text.find('.'), power);
  int out = point < power ? static_cast<int>(std::min<std::size_t>(power - point - 1, 99)) : 0;
  if (power < text.size()) {
    const std::size_t begin = power + (text.substr(power + 1, 1) == "+" ? 2U : 1U);
    int exponent = 0;
    std::from_chars(text.data() + std::min(begin, text.size()), text.data() + text.size(),
                    exponent);
    out -= std::clamp(exponent, -99, 99);
  }
  return std::clamp(out, 0, kMostDecimals);
}

std::string written_like(double value, int decimals, std::string_view like) {
  std::string out = fmt::format("{:.{}f}", value, decimals);
  if (out.find_first_of("123456789") == std::string::npos && out[0] == '-') out.erase(0, 1);
  const std::size_t digits = like.find_first_not_of("+-");
  const std::size_t zero = out.find("0.");
  if (digits < like.size() && like[digits] == '.' && zero <= 1 && (zero == 0 || out[0] == '-'))
    out.erase(zero, 1);
  return out;
}

}  // namespace plumb::offline::programs
