// SPDX-License-Identifier: Apache-2.0
#include "import/imported.hpp"

#include <charconv>

#include "cell/units.hpp"

namespace plumb::offline {

std::vector<double> si_values(const ImportedColumn& column) {
  const auto unit = unit_of(column.unit);
  std::vector<double> out;
  for (const auto text : column.text) {
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    out.push_back(unit ? unit->to_si(value) : value);
  }
  return out;
}

}  // namespace plumb::offline
