// SPDX-License-Identifier: Apache-2.0
#include "cell/table_file.hpp"

#include <algorithm>

#include "cell/line_source.hpp"
#include "cell/table_blocks.hpp"
#include "cell/table_reader.hpp"
#include "program/file.hpp"

namespace plumb::offline {
namespace {

/// What is read on after an error, to find the others, of a pipe or device that may never end.
constexpr std::size_t kMostAfterError = 64 << 20;

std::size_t lines_of(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
}

/// As many lines as the first block has, over the whole file, and some more.
std::size_t expected_lines(const std::string& first_block, std::uintmax_t size) {
  const double blocks =
      std::max(1.0, static_cast<double>(size) / static_cast<double>(first_block.size()));
  return static_cast<std::size_t>(1.02 * blocks * static_cast<double>(lines_of(first_block)));
}

Table finished(TableReader& reader) {
  reader.check_content();
  reader.problems().stop_on_errors();
  const auto note = reader.separator_note(reader.has_decimal_comma());
  Table table = reader.take();
  if (note) table.remarks.push_back(*note);
  return table;
}

}  // namespace

Table parse_table(std::string_view text, const std::string& file_name) {
  TableReader reader(file_name);
  reader.expect(lines_of(text), text.size());
  reader.read(text);
  Table table = finished(reader);
  table.sha256 = sha256(text);
  return table;
}

Table read_table(const std::filesystem::path& file) {
  LineSource source(file);
  TableReader reader(display_name(file));
  std::string block;
  std::size_t after_error = 0;
  // An empty file has an empty block, which is read too: its header row is missing.
  source.next(block);
  reader.expect(expected_lines(block, source.size()), source.size());
  for (bool more = true; more;) {
    reader.read(block);
    if (!reader.problems().errors().empty()) after_error += block.size();
    const bool endless = source.size() == 0 && after_error > kMostAfterError;
    more = !endless && !reader.problems().full() && source.next(block);
  }
  Table table = finished(reader);
  table.sha256 = source.sha256();
  return table;
}

std::string read_blocks(const std::filesystem::path& file,
                        const std::function<void(const Table&)>& take) {
  LineSource source(file);
  TableReader first(display_name(file));
  std::string block;
  while (!first.has_header() && source.next(block)) first.read(block);
  const TableReader header = first.below(1);
  take(finished(first));
  while (source.next(block)) {
    TableReader reader = header.below(source.first_line());
    reader.expect(lines_of(block), block.size());
    reader.read(block);
    reader.problems().stop_on_errors();
    take(reader.take());
  }
  return source.sha256();
}

}  // namespace plumb::offline
