// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>

#include "cell/measurements.hpp"
#include "plumb/runtime/corrector.hpp"

namespace plumb::offline::cli {

/// Why targets were refused, in words, and what the likely mistake is: each refused target is also
/// read as if it had been written in other units or in another order, and compared with the nominal
/// pose at its seed. A mistake is named only if it explains nearly all of them.
class Refusals {
 public:
  /// `arm`: that of the corrector, with the names of its joints; both must outlive this object.
  Refusals(const Corrector& corrector, const format::Chain& arm);

  /// Takes the names of the file's columns, "x_m" and "qc1_rad", for the messages.
  void name_columns(const Table& targets);

  /// has_orientation: the target's orientation is the user's, not that of the seed. Cost: some
  /// forward transforms, and a small decomposition near a singular pose.
  void add(const Transformd& X_BD, std::span<const double> seed, Status status,
           bool has_orientation);
  void add(const Refusals& more);

  std::size_t rows() const { return rows_; }

  /// "16 lie farther than 0.2 rad from their seed, 4 lie near a singular pose (where motions
  /// cancel: 4 of J4, J6)"
  std::string words() const;

  /// Why most of them were refused; kOk if none was.
  Status commonest() const;

  /// "no target is farther than 1.7 mm from the base: metres in x_mm?"; empty if no mistake
  /// explains them.
  std::string likely_mistake() const;

 private:
  enum Mistake { kScalarLast, kInverse, kRadians, kMistakes };
  static constexpr std::array kFactors{1e3,  1e-3,       1e6,    1e-6,
                                       25.4, 1.0 / 25.4, 0.0254, 1.0 / 0.0254};
  std::string wrong_unit(double factor) const;
  std::string singular_joints(std::span<const double> seed) const;
  void compare(const Transformd& X_BD, std::span<const double> seed, bool has_orientation);
  std::string phrase(Status status, std::size_t rows) const;

  const Corrector* corrector_;
  const format::Chain* arm_;
  double reach_m_ = 0.0;
  std::size_t rows_ = 0;
  std::map<Status, std::size_t> by_status_;
  std::map<std::string, std::size_t> by_joints_;  // near-singular rows, by joints that cancel
  std::array<std::size_t, kMistakes> explained_{};
  std::array<std::size_t, kFactors.size()> scaled_{};  // rows that fit their seeds times a factor
  std::string position_ = "x_mm", joint_ = "q1_deg";
  double position_unit_m_ = 1e-3;
  double farthest_m_ = 0.0;  // largest distance from the base
  std::size_t beyond_reach_ = 0;
  Vector3 offset_sum_ = Vector3::Zero();  // from the nominal pose at the seed to the target
  double offset_squares_ = 0.0;
};

}  // namespace plumb::offline::cli
