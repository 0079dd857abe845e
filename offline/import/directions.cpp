// SPDX-License-Identifier: Apache-2.0
#include "import/directions.hpp"

#include <fmt/format.h>

#include <charconv>

#include "cell/units.hpp"
#include "import/moves.hpp"

namespace plumb::offline {
namespace {

/// A joint that moved less stood still.
constexpr double kStill_rad = 1e-5;

}  // namespace

void add_directions(Imported& data) {
  std::vector<ImportedColumn> more;
  for (int j = 1; const ImportedColumn* q = data.find("q" + std::to_string(j)); ++j) {
    std::vector<double> values;
    for (const auto text : q->text) {
      double value = 0.0;
      std::from_chars(text.data(), text.data() + text.size(), value);
      values.push_back(value);
    }
    const auto unit = *unit_of(q->unit);
    const Arrivals arrivals = arrivals_from_order(values, unit.from_si(kStill_rad));
    ImportedColumn direction{"", fmt::format("dir_j{}", j), "", {}};
    ImportedColumn travel{"", fmt::format("travel_j{}", j), q->unit, {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
      direction.text.add(std::to_string(arrivals.direction[i]));
      travel.text.add(fmt::format("{:.9g}", arrivals.travel[i]));
    }
    more.push_back(std::move(direction));
    more.push_back(std::move(travel));
  }
  for (auto& column : more) data.columns.push_back(std::move(column));
}

}  // namespace plumb::offline
