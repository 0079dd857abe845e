// SPDX-License-Identifier: Apache-2.0
#include "import/stated_units.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "cell/units.hpp"
#include "import/unit_words.hpp"
#include "import/words.hpp"

namespace plumb::offline {
namespace {

constexpr auto kSpeaksOfUnits = std::to_array<std::string_view>(
    {"unit",        "units",        "lengthunit",   "lengthunits",   "angleunit",     "angleunits",
     "angularunit", "angularunits", "distanceunit", "distanceunits", "linearunit",    "linearunits",
     "einheit",     "einheiten",    "masseinheit",  "langeneinheit", "winkeleinheit", "unite",
     "unites",      "unita",        "unidad",       "unidades",      "单位",          "単位"});

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> out{""};
  for (const char c : line)
    if (std::string_view(" \t,;:=/|\"[]()").find(c) != std::string_view::npos)
      out.emplace_back();
    else
      out.back() += c;
  std::erase(out, "");
  return out;
}

/// The position behind the word that speaks of units; that of the end if there is none.
std::size_t behind_key(const std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i)
    if (std::find(kSpeaksOfUnits.begin(), kSpeaksOfUnits.end(), folded(words[i])) !=
        kSpeaksOfUnits.end())
      return i + 1;
  return words.size();
}

void take(const std::string& unit, int number, std::string& stated, int& line, bool& twice) {
  twice = twice || (!stated.empty() && stated != unit);
  stated = unit;
  line = number;
}

}  // namespace

bool states_units(std::string_view line) {
  const auto words = words_of(line);
  return behind_key(words) < words.size();
}

void read_stated_units(std::string_view line, int number, StatedUnits& out) {
  const auto words = words_of(line);
  bool two_lengths = false, two_angles = false;
  for (std::size_t i = behind_key(words); i < words.size(); ++i) {
    // "Units in mm": the word is no inch here. A frame may be called A or M.
    if (words[i] == "in" && i + 1 < words.size()) continue;
    if (words[i].size() == 1 && words[i] != "m" && words[i] != "\"") continue;
    const std::string unit = known_unit(words[i]);
    const auto known = unit_of(unit);
    if (!known) continue;
    if (known->quantity == Quantity::kLength)
      take(unit, number, out.length, out.length_line, two_lengths);
    else if (known->quantity == Quantity::kAngle)
      take(unit, number, out.angle, out.angle_line, two_angles);
  }
  if (two_lengths) out.length.clear();
  if (two_angles) out.angle.clear();
}

}  // namespace plumb::offline
