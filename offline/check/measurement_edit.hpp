// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>

namespace plumb::offline {

/// Changes to a measurement file; columns go by their name without the unit.
struct MeasurementEdit {
  std::map<std::string, std::string> units;  // the unit a column really has: its label changes
  std::map<std::string, std::string> names;  // "x" becomes "y": columns in another order
  std::set<std::string> negated;             // columns whose numbers change sign
  std::map<std::string, double> factors;     // columns whose numbers are multiplied
  std::string rotation = {};                 // what the line "# rot:" is to say; empty: it stays
  bool empty() const {
    return units.empty() && names.empty() && negated.empty() && factors.empty() && rotation.empty();
  }
  /// Adds the changes of `other`, which must concern other columns.
  void add(const MeasurementEdit& other);
};

/// The text with headings renamed and signs changed, which keeps every digit, and the numbers of
/// columns with a factor to nine digits. Comments, other columns, separators and line ends stay.
/// `header_line` counts from 1.
std::string edited(const std::string& text, int header_line, const MeasurementEdit& edit);

}  // namespace plumb::offline
