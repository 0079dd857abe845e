// SPDX-License-Identifier: Apache-2.0
#include "cell/measurement_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cell/column_names.hpp"
#include "cell/table_place.hpp"

namespace plumb::offline {
namespace {

/// Rows of one name whose joints differ by more [rad] or [m] are different poses.
constexpr double kSamePose = 0.02;

std::string count_of(int doubles) {
  return doubles == 1 ? "a row is" : fmt::format("{} rows are", doubles);
}

void warn_of_name(Table& table, int row, const std::string& pose) {
  const Column* column = table.find("pose");
  if (column == nullptr) return;
  table.remarks.push_back({Severity::kWarning, "W-CSV-POSE",
                           fmt::format("pose '{}' names different joint positions", pose),
                           place_in_row(table, row, *column, "not where it was before"),
                           "give every pose its own name; rows of one name count as repeats"});
}

/// The smallest value above zero; 0 if there is none.
double smallest_positive(const auto& values) {
  double out = 0.0;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (const double v = values(i); v > 0.0 && (out == 0.0 || v < out)) out = v;
  return out;
}

/// The first zero of the table's columns sx, sy, sz.
void warn_of_zero_sigma(Table& table, bool all) {
  const Column* where = nullptr;
  int first = table.rows(), count = 0;
  for (const char* name : {"sx", "sy", "sz"}) {
    const Column* column = table.find(name);
    for (int row = 0; column != nullptr && row < table.rows(); ++row) {
      if (column->values[row] != 0.0) continue;
      ++count;
      if (row >= first) continue;
      first = row;
      where = column;
    }
  }
  if (where == nullptr) return;
  table.remarks.push_back(
      {Severity::kWarning, "W-CSV-SIGMA",
       all ? std::string("every standard deviation is zero: none is used")
           : fmt::format(
                 "{} of zero: the smallest one above zero is taken in {} place",
                 count == 1 ? "a standard deviation" : fmt::format("{} standard deviations", count),
                 count == 1 ? "its" : "their"),
       place_in_row(table, first, *where, "no reading is exact"),
       "give the reading's 1 sigma, or delete the columns and set sigma_um in cell.toml"});
}

struct Sizes {
  double low = 0.0, middle = 0.0, high = 0.0;
};

Sizes sizes_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *middle, *high};
}

constexpr double kHeaviestPayload_kg = 3000.0;
/// No machine works at lower or higher temperatures.
constexpr double kColdestMachine_degC = -60.0, kHottest_degC = 150.0;
constexpr double kLongest_rad = 20.0 * M_PI;
constexpr double kLongest_m = 30.0;

bool may_be_odd(const Column& column) {
  return column.quantity == Quantity::kMass || column.quantity == Quantity::kTemperature ||
         column.name.starts_with("travel_j");
}

/// What the numbers of a column cannot be, and the unit they may be in; nothing if they are sound.
std::optional<std::pair<std::string, std::string>> oddity_of(const Column& column) {
  const Sizes at = sizes_of(column.values);
  switch (column.quantity) {
    case Quantity::kMass:
      if (at.high > kHeaviestPayload_kg && column.unit == "kg")
        return {{fmt::format("a load of {:.4g} tonnes", at.high * 1e-3), "_g"}};
      break;
    case Quantity::kTemperature:
      if (column.unit == "degC" && at.middle > 230.0 && at.middle < 400.0)
        return {{fmt::format("{:.4g} degC: in kelvin they would be {:.4g} degC", at.middle,
                             at.middle - 273.15),
                 "_K"}};
      if (column.unit == "degC" && column.name == "temp" && at.low > 55.0 &&
          at.high < kHottest_degC)
        return {{fmt::format("{:.4g} degC: in Fahrenheit they would be {:.4g} degC", at.middle,
                             (at.middle - 32.0) / 1.8),
                 "_degC, with the numbers converted, (F - 32) / 1.8"}};
      if (column.unit == "K" && at.middle < kColdestMachine_degC)
        return {{fmt::format("{:.4g} degC: they look like degrees Celsius", at.middle), "_degC"}};
      if (at.middle > kHottest_degC || at.middle < kColdestMachine_degC)
        return {{fmt::format("{:.4g} degC", at.middle), "_degC in degrees Celsius"}};
      break;
    case Quantity::kAngle:
      if (column.name.starts_with("travel_j") && at.high > kLongest_rad)
        return {{fmt::format("moves of up to {:.4g} turns", at.high / (2.0 * M_PI)),
                 column.unit == "rad" ? "_deg" : "_urad"}};
      break;
    case Quantity::kLength:
      if (column.name.starts_with("travel_j") && at.high > kLongest_m)
        return {{fmt::format("moves of up to {:.4g} m", at.high), "_um"}};
      break;
    default:
      break;
  }
  return std::nullopt;
}

}  // namespace

void replace_zero_sigmas(MeasurementFiles& m) {
  if (m.sigma_m.rows() == 0) return;
  const double any = smallest_positive(m.sigma_m.reshaped());
  for (auto& table : m.tables) warn_of_zero_sigma(table, any == 0.0);
  if (any == 0.0) return m.sigma_m.resize(0, 3);
  for (int k = 0; k < 3; ++k) {
    if (!m.has_axis[k]) continue;
    const double own = smallest_positive(m.sigma_m.col(k));
    for (Eigen::Index i = 0; i < m.sigma_m.rows(); ++i)
      if (m.sigma_m(i, k) == 0.0) m.sigma_m(i, k) = own > 0.0 ? own : any;
  }
}

void warn_of_values(Table& table) {
  std::vector<Problem> found;
  for (const auto& column : table.columns) {
    if (column.values.empty() || !may_be_odd(column)) continue;
    const auto odd = oddity_of(column);
    if (!odd) continue;
    found.push_back({Severity::kWarning, "W-CSV-VALUE",
                     fmt::format("column '{}' holds {}", column.header, odd->first),
                     place_in_header(table, column, "is that the unit?"),
                     fmt::format("if it is not: rename it to '{}{}'", column.name, odd->second)});
  }
  table.remarks.insert(table.remarks.end(), found.begin(), found.end());
}

void warn_of_misspelt(Table& table) {
  for (const auto& column : table.columns) {
    const auto meant = misspelt(column.name, column.quantity);
    if (!meant || table.find(*meant) != nullptr) continue;
    const std::string name = *meant + "_" + column.unit;
    table.remarks.push_back(
        {Severity::kWarning, "W-CSV-COLUMN",
         fmt::format("column '{}' is not known, so nothing reads it", column.header),
         place_in_header(table, column, fmt::format("did you mean '{}'?", name)),
         fmt::format("rename it to '{}' if it is meant", name)});
  }
}

void warn_of_doubles(Table& table) {
  std::vector<std::pair<std::size_t, int>> hashes(table.rows());
  for (int row = 0; row < table.rows(); ++row)
    hashes[row] = {std::hash<std::string_view>{}(table.raw_rows.view(row)), row};
  std::sort(hashes.begin(), hashes.end());
  int doubles = 0, first = table.rows(), original = 0;
  for (std::size_t k = 1; k < hashes.size(); ++k) {
    const int row = hashes[k].second, before = hashes[k - 1].second;
    if (hashes[k].first != hashes[k - 1].first) continue;
    if (table.raw_rows.view(row) != table.raw_rows.view(before)) continue;
    ++doubles;
    if (row > first) continue;
    first = row;
    original = before;
  }
  if (doubles == 0) return;
  table.remarks.push_back({Severity::kWarning, "W-CSV-DOUBLE",
                           fmt::format("{} identical to an earlier one", count_of(doubles)),
                           place_in_row(table, first, table.columns.front(),
                                        fmt::format("the same as line {}", table.lines[original])),
                           "delete the copy; a true repeat has its own reading"});
}

void warn_of_names(MeasurementFiles& m) {
  std::vector<int> first_of_group(m.size(), -1);
  int i = 0;
  for (auto& table : m.tables) {
    bool warned = false;
    for (int row = 0; row < table.rows(); ++row, ++i) {
      int& first = first_of_group[m.replicate_group[i]];
      if (first < 0) first = i;
      if (warned || m.q.cols() == 0) continue;
      warned = (m.q.row(i) - m.q.row(first)).cwiseAbs().maxCoeff() > kSamePose;
      if (warned) warn_of_name(table, row, m.pose[i]);
    }
  }
}

}  // namespace plumb::offline
