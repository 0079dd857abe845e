// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "cell/packed_matrix.hpp"
#include "noise/error_stats.hpp"
#include "noise/noise_floor.hpp"
#include "noise/orientation_floor.hpp"
#include "program/json.hpp"

/// A struct in a kept file is described once, and both written and read by that description:
///
///   template <class Fields>
///   void describe(Fields& fields, typename Fields::template Of<Outlier>& outlier) {
///     fields("row", outlier.row);
///     fields.later("pose", outlier.pose);
///   }
///
/// It stands in the namespace of the struct and not in an anonymous one, where it would not be
/// found. SI; reading throws nlohmann::json::exception on other content.
namespace plumb::offline {

template <class T>
Json kept_json(const T& value);
template <class T>
void read_kept(const Json& j, T& value);

class FieldWriter {
 public:
  template <class T>
  using Of = const T;

  explicit FieldWriter(Json& out) : out_(out) {}

  template <class T>
  void operator()(const char* key, const T& value) {
    out_[key] = kept_json(value);
  }
  /// Of a field that earlier files lack: reading leaves it as it is.
  template <class T>
  void later(const char* key, const T& value) {
    out_[key] = kept_json(value);
  }
  /// The same, and written only where it has a meaning.
  template <class T>
  void where(bool has_meaning, const char* key, const T& value) {
    if (has_meaning) out_[key] = kept_json(value);
  }
  /// One of several, by its name; earlier files may lack it.
  template <class T>
  void named(const char* key, T value, T) {
    out_[key] = name_of(value);
  }
  /// Written only if there is a value.
  template <class T>
  void if_any(const char* key, const std::optional<T>& value) {
    if (value) out_[key] = kept_json(*value);
  }
  void symmetric(const char* key, const Eigen::MatrixXd& value, std::size_t) {
    out_[key] = packed(value);
  }

 private:
  Json& out_;
};

class FieldReader {
 public:
  template <class T>
  using Of = T;

  explicit FieldReader(const Json& in) : in_(in) {}

  template <class T>
  void operator()(const char* key, T& value) {
    read_kept(in_.at(key), value);
  }
  template <class T>
  void later(const char* key, T& value) {
    if (in_.contains(key)) read_kept(in_.at(key), value);
  }
  template <class T>
  void where(bool, const char* key, T& value) {
    later(key, value);
  }
  template <class T>
  void named(const char* key, T& value, T last) {
    if (!in_.contains(key)) return;
    const std::string name = in_.at(key);
    for (int i = 0; i <= static_cast<int>(last); ++i)
      if (name == name_of(static_cast<T>(i))) return void(value = static_cast<T>(i));
    in_.at(key).at(name);  // throws: it names none of them
  }
  template <class T>
  void if_any(const char* key, std::optional<T>& value) {
    if (in_.contains(key)) read_kept(in_.at(key), value.emplace());
  }
  void symmetric(const char* key, Eigen::MatrixXd& value, std::size_t size) {
    value = unpacked(in_.at(key), static_cast<Eigen::Index>(size));
  }

 private:
  const Json& in_;
};

template <class T>
concept Described = requires(FieldWriter& fields, const T& value) {
  describe(fields, value);
};

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::bool_constant<Described<T>> {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

template <class T>
Json kept_json(const T& value) {
  if constexpr (Described<T>) {
    Json out = Json::object();
    FieldWriter fields(out);
    describe(fields, value);
    return out;
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<int>(value);
  } else if constexpr (IsOptional<T>::value) {
    return value ? kept_json(*value) : Json(nullptr);
  } else if constexpr (IsVector<T>::value) {
    Json out = Json::array();
    for (const auto& one : value) out.push_back(kept_json(one));
    return out;
  } else {
    return value;
  }
}

template <class T>
void read_kept(const Json& j, T& value) {
  if constexpr (Described<T>) {
    FieldReader fields(j);
    describe(fields, value);
  } else if constexpr (std::is_enum_v<T>) {
    value = static_cast<T>(j.get<int>());
  } else if constexpr (IsOptional<T>::value) {
    value.reset();
    if (!j.is_null()) read_kept(j, value.emplace());
  } else if constexpr (IsVector<T>::value) {
    value.clear();
    for (const Json& one : j) read_kept(one, value.emplace_back());
  } else {
    j.get_to(value);
  }
}

template <class T>
T from_kept(const Json& j) {
  T out{};
  read_kept(j, out);
  return out;
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<ErrorStats>& stats) {
  fields("n", stats.n);
  fields("mean_m", stats.mean);
  fields("rms_m", stats.rms);
  fields("p95_m", stats.p95);
  fields("max_m", stats.max);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<NoiseFloor>& floor) {
  fields("sigma_m", floor.sigma_m);
  fields("mean_m", floor.mean_m);
  fields("rms_m", floor.rms_m);
  fields.later("dof", floor.dof);
  fields("source", floor.source);
  fields.later("inferred_m", floor.inferred_m);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<OrientationFloor>& floor) {
  fields("sigma_rad", floor.sigma_rad);
  fields("mean_rad", floor.mean_rad);
  fields("source", floor.source);
}

}  // namespace plumb::offline
