// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <string>

#include "plumb/format/model.hpp"

/// SI inside, mm and deg on screen.
namespace plumb::offline::show {

inline constexpr double kRadian_deg = 180.0 / std::numbers::pi;

inline double to_mm(double metres) { return metres * 1e3; }
inline double to_deg(double radians) { return radians * kRadian_deg; }
inline double from_deg(double degrees) { return degrees / kRadian_deg; }

/// A length in mm or an angle in deg, whichever the quantity is.
inline double shown(double si, bool is_length) { return is_length ? to_mm(si) : to_deg(si); }
inline const char* unit(bool is_length) { return is_length ? "mm" : "deg"; }

inline bool slides(const format::JointRow& row) {
  return row.type == format::JointType::kPrismatic;
}

/// Metres as mm for people: three decimals, or three digits if it is small.
std::string mm(double metres);

/// Radians as degrees for people, of an error of orientation: four decimals.
std::string deg(double radians);

/// The shortest text that reads back to the same bits.
std::string shortest(double value);

}  // namespace plumb::offline::show
