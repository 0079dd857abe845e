// SPDX-License-Identifier: Apache-2.0
#include "cell/csv_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/csv_header.hpp"
#include "cell/unmarked_utf16.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

Place place_of_byte(std::string_view text, std::size_t offset, const std::string& file,
                    int first_line) {
  const auto before = text.substr(0, offset);
  const auto newline = before.rfind('\n');
  const auto begin = newline == std::string_view::npos ? 0 : newline + 1;
  const auto line = text.substr(begin, text.find('\n', offset) - begin);
  const int number = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + first_line;
  return CsvPlace{file, number, line}.of(text.substr(offset, 1), "here");
}

std::string from_utf16_to_utf8(const std::string& file, const char* encoding) {
  return fmt::format(
      "import it: plumb import {0}; or save it as UTF-8: iconv -f {1} -t UTF-8 {0} > "
      "utf8.csv",
      file, encoding);
}

}  // namespace

void check_bytes(std::string_view text, const std::string& file, int first_line) {
  ProblemList problems;
  const Place whole{.file = file};
  const bool begins = first_line == 1;
  if (text.empty())
    problems.error("E-CSV-EMPTY", "the file is empty", whole, "export the measurements again");
  else if (begins && (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")))
    problems.error("E-CSV-UTF8", "the file is UTF-16, not UTF-8", whole,
                   from_utf16_to_utf8(file, "UTF-16"));
  else if (const auto order = begins ? unmarked_utf16(text) : std::nullopt)
    problems.error(
        "E-CSV-UTF8", "the file is UTF-16 without a byte-order mark, not UTF-8", whole,
        from_utf16_to_utf8(file, *order == ByteOrder::kBigEndian ? "UTF-16BE" : "UTF-16LE"));
  else if (const auto zero = text.find('\0'); zero != std::string_view::npos)
    problems.error("E-CSV-BINARY", "this is no text file: it holds zero bytes",
                   place_of_byte(text, zero, file, first_line),
                   "save the measurements as CSV in UTF-8");
  else if (const auto bad = find_invalid_utf8(text); bad != std::string_view::npos)
    problems.error("E-CSV-UTF8", "this byte is not UTF-8",
                   place_of_byte(text, bad, file, first_line),
                   fmt::format("iconv -f WINDOWS-1252 -t UTF-8 {} > utf8.csv", file));
  problems.stop_on_errors();
}

}  // namespace plumb::offline
