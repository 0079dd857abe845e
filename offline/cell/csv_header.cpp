// SPDX-License-Identifier: Apache-2.0
#include "cell/csv_header.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/column_names.hpp"
#include "cell/units.hpp"
#include "program/shell_word.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kLongestSource = 4096;  // bytes of a line kept for a message

std::string listed(const std::vector<Quantity>& kinds) {
  std::string out;
  for (const Quantity kind : kinds)
    out += (out.empty() ? "" : " or ") + std::string(kind_name(kind));
  return out;
}

class HeaderReader {
 public:
  HeaderReader(const CsvPlace& place, ProblemList& problems) : at_(place), problems_(problems) {}

  Column read(const CsvCell& cell) {
    Column column;
    column.header = text_of(cell);
    column.name = column.header;
    if (column.header.empty()) {
      problems_.error("E-CSV-HEADER", "a column has no name", at_.of(cell.text, "no name"),
                      "name it, or delete the column");
    } else if (const auto quantity = unitless_quantity(column.header)) {
      column.quantity = *quantity;
    } else {
      read_unit(cell, column);
    }
    return column;
  }

 private:
  void read_unit(const CsvCell& cell, Column& column) {
    const Heading heading = split_heading(column.header);
    const auto unit = unit_of(heading.unit);
    if (!unit)
      // A known name may have an underscore of its own: payload_cx, travel_j1.
      return heading.unit.empty() || misspelt_header(column.header)
                 ? no_unit(cell, column)
                 : bad_unit(cell, column, heading);
    column.name = heading.name;
    column.unit = heading.unit;
    column.quantity = unit->quantity;
    const auto allowed = allowed_quantities(column.name);
    if (!allowed.empty() &&
        std::find(allowed.begin(), allowed.end(), unit->quantity) == allowed.end())
      problems_.error("E-CSV-KIND",
                      fmt::format("column '{}' is in '{}', but '{}' is {}", column.header,
                                  column.unit, column.name, listed(allowed)),
                      at_.of(cell.text, "wrong kind of unit"),
                      fmt::format("rename it to '{}_{}' if the numbers are", column.name,
                                  usual_unit(column.name)));
    if (const auto known = known_spelling(column.name))
      problems_.warning(
          "W-CSV-NAME",
          fmt::format("column '{}' is not '{}_{}'", column.header, *known, column.unit),
          at_.of(cell.text, "names are in lower case"),
          fmt::format("rename it to '{}_{}' if it is meant", *known, column.unit));
  }

  void no_unit(const CsvCell& cell, const Column& column) {
    const auto meant = misspelt_header(column.header);
    std::string renamed = meant.value_or(column.header + "_" + usual_unit(column.header));
    std::replace(renamed.begin(), renamed.end(), ' ', '_');
    const bool another = meant && !meant->starts_with(column.header + "_");
    problems_.error("E-CSV-UNIT", fmt::format("column '{}' has no unit", column.header),
                    at_.of(cell.text, another ? fmt::format("did you mean '{}'?", renamed)
                                              : "add a unit suffix"),
                    fmt::format("rename it to '{}', or: plumb import {} --map {}", renamed,
                                at_.file, shell_word(column.header + "=" + renamed)));
  }

  void bad_unit(const CsvCell& cell, const Column& column, const Heading& heading) {
    const auto report = [&](const std::string& label, const std::string& help) {
      problems_.error("E-CSV-UNIT",
                      fmt::format("column '{}': '{}' is not a unit", column.header, heading.unit),
                      at_.of(cell.text, label), help);
    };
    if (const auto* foreign = foreign_unit(heading.unit))
      return report(
          fmt::format("not one of plumb's: {}", foreign->equals),
          fmt::format("convert the numbers and rename it to '{}_{}'", heading.name, foreign->use));
    const std::string name = known_spelling(heading.name).value_or(heading.name);
    const auto guess = did_you_mean(heading.unit, unit_names());
    report("unknown unit", guess ? fmt::format("did you mean '{}_{}'?", name, *guess)
                                 : fmt::format("known units: {}", fmt::join(unit_names(), " ")));
  }

  const CsvPlace& at_;
  ProblemList& problems_;
};

bool same_meaning(const Column& a, const Column& b) {
  return a.name == b.name || a.header == b.header;
}

}  // namespace

Place CsvPlace::of(std::string_view part, std::string label) const {
  Place out{.file = file, .line = line, .label = std::move(label)};
  const auto offset = static_cast<std::size_t>(part.data() - text.data());
  out.column = count_characters(text.substr(0, offset)) + 1;
  out.length = std::max(1, count_characters(part));
  if (text.size() <= kLongestSource) out.source = std::string(text);
  return out;
}

char find_separator(std::string_view header) {
  bool quoted = false, comma = false, semicolon = false;
  for (const char c : header) {
    if (c == '"') quoted = !quoted;
    comma = comma || (c == ',' && !quoted);
    semicolon = semicolon || (c == ';' && !quoted);
  }
  if (comma) return ',';
  if (semicolon) return ';';
  return trimmed(header).find('\t') == std::string_view::npos ? ',' : '\t';
}

std::vector<Column> read_header(const std::vector<CsvCell>& cells, const CsvPlace& place,
                                ProblemList& problems) {
  std::vector<Column> out;
  for (const auto& cell : cells) {
    Column column = HeaderReader(place, problems).read(cell);
    const auto twin = std::find_if(out.begin(), out.end(),
                                   [&](const Column& c) { return same_meaning(c, column); });
    if (twin != out.end() && !column.header.empty())
      problems.error("E-CSV-DUPLICATE",
                     twin->header == column.header
                         ? fmt::format("column '{}' appears twice", column.header)
                         : fmt::format("columns '{}' and '{}' are the same quantity", twin->header,
                                       column.header),
                     place.of(cell.text, "second one"), "delete or rename one of them");
    out.push_back(std::move(column));
  }
  return out;
}

}  // namespace plumb::offline
