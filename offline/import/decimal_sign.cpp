// SPDX-License-Identifier: Apache-2.0
#include "import/decimal_sign.hpp"

#include "import/number_text.hpp"

namespace plumb::offline {
namespace {

/// Characters of a group of thousands: the sign and three digits.
constexpr std::size_t kThousands = 4;

/// Cells by what their signs can mean.
struct DecimalVotes {
  int comma = 0, point = 0;                         // decimals, and nothing else
  int commas = 0, points = 0;                       // "1,234", "1.234": thousands or decimals
  int comma_line = 0, point_line = 0;               // the first of these
  bool comma_proved = false, point_proved = false;  // "1.234,5", "1,234.5": both signs in one cell
};

void vote(std::string_view cell, int line, DecimalVotes& votes) {
  if (const auto measured = measured_cell(cell)) cell = measured->number;
  const bool has_comma = cell.find(',') != cell.npos, has_point = cell.find('.') != cell.npos;
  if (!has_comma && !has_point) return;
  // "12.3456": a point that cannot divide thousands, as in nearly every cell.
  const bool decimals = !has_comma && cell.size() - cell.rfind('.') != kThousands;
  const bool as_comma = !decimals && number_in(cell, ',').has_value(),
             as_point = number_in(cell, '.').has_value();
  if (as_comma && as_point) {
    int& first = has_comma ? votes.comma_line : votes.point_line;
    if (first == 0) first = line;
    ++(has_comma ? votes.commas : votes.points);
  } else if (as_comma) {
    ++votes.comma;
    votes.comma_proved = votes.comma_proved || has_point;
  } else if (as_point) {
    ++votes.point;
    votes.point_proved = votes.point_proved || has_comma;
  }
}

[[noreturn]] void ask(const SourceText& text, int line, std::string message, std::string help,
                      std::string label) {
  throw Failure(Exit::kInput, {.code = "E-IMPORT-DECIMAL",
                               .message = std::move(message),
                               .place = Place{.file = text.file,
                                              .line = line,
                                              .column = 1,
                                              .source = std::string(text.lines[line - 1]),
                                              .label = std::move(label)},
                               .help = std::move(help)});
}

}  // namespace

char find_decimal(const SourceText& text, const RawRows& rows) {
  DecimalVotes votes;
  for (std::size_t i = 0; i < rows.cells.size(); ++i)
    for (const auto cell : rows.cells[i]) vote(cell, rows.lines[i], votes);
  if (votes.comma > 0 && votes.points > 0 && !votes.comma_proved)
    ask(text, votes.point_line,
        "a point with three digits behind it may divide thousands or decimals: other numbers have "
        "a decimal comma",
        "if it divides thousands: --decimal comma; else write all numbers alike",
        "1.234 is 1.234 or 1234");
  if (votes.comma > 0) return ',';
  if (votes.commas > 0 && !votes.point_proved)
    ask(text, votes.comma_line,
        "a comma with three digits behind it may divide thousands or decimals",
        "say which: --decimal comma, or --decimal point", "1,234 is 1.234 or 1234");
  return '.';
}

}  // namespace plumb::offline
