// SPDX-License-Identifier: Apache-2.0
#include "cli/row_stream.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "cell/line_source.hpp"
#include "cell/table_reader.hpp"
#include "cli/in_order.hpp"
#include "program/file.hpp"

namespace plumb::offline::cli {
namespace {

constexpr std::size_t kMostProblems = 1000;  // are reported; nobody reads more
/// Bytes that are read on after the first problem, if the input is a pipe, which may never end.
constexpr std::size_t kMostAfterError = 64 << 20;
/// Larger allocations go back to the system when they are freed, and of the rest the process keeps
/// this much [bytes].
constexpr int kLargestPart = 64 << 20, kKeptFree = 256 << 20;

/// Lets every block reuse the memory of an earlier one. Memory that goes back to the system is
/// cleared page by page before it is used again, which costs a tenth of the time.
void keep_freed_memory() {
  ::mallopt(M_MMAP_THRESHOLD, kLargestPart);
  ::mallopt(M_TRIM_THRESHOLD, kKeptFree);
}

struct Lines {
  std::string text;
  int first_line = 1;
};

/// What a worker found in a block.
struct Block {
  std::vector<Problem> of_text;  // cells that are no numbers and the like
  std::vector<Problem> of_rows;  // impossible numbers
  RowStream::Computed computed;
  std::size_t rows = 0, bytes = 0;
  bool decimal_comma = false;
};

void append(std::vector<Problem>& to, const std::vector<Problem>& more) {
  const std::size_t room = kMostProblems - std::min(kMostProblems, to.size());
  to.insert(to.end(), more.begin(), more.begin() + static_cast<long>(std::min(room, more.size())));
}

/// The problems of rows alone. Those of the header and of the whole file were reported with the
/// first block; every further block finds them again.
std::vector<Problem> below(int header_line, std::vector<Problem> problems) {
  std::erase_if(problems, [&](const Problem& problem) {
    return !problem.place || problem.place->line <= header_line || problem.place->column == 0;
  });
  return problems;
}

Block worked_on(TableReader& reader, const show::PassThrough& columns,
                const RowStream::Work& work) {
  Block out;
  reader.check_texts();
  out.rows = static_cast<std::size_t>(reader.rows());
  out.decimal_comma = reader.has_decimal_comma();
  out.of_text = reader.problems().errors();
  Table table = reader.take();
  out.computed.remarks = table.remarks;
  if (!out.of_text.empty() || out.rows == 0) return out;
  try {
    out.computed = work(std::move(table), columns);
  } catch (const Failure& failure) {
    if (failure.exit_code() != Exit::kInput) throw;
    out.of_rows = failure.problems();
  }
  return out;
}

}  // namespace

void RowCells::add(double value) {
  char* const begin = text_.data() + used_;
  char* const end = fmt::format_to(begin, "{}", value);
  cells_[count_++] = {begin, static_cast<std::size_t>(end - begin)};
  used_ += static_cast<std::size_t>(end - begin);
}

void RowCells::add(const char* text) { cells_[count_++] = text; }

namespace {

/// One pass over a file.
class Pass {
 public:
  Pass(const std::filesystem::path& file, const std::vector<std::string>& ours,
       const RowStream::Work& work, Spool& spool)
      : source_(file), first_(std::in_place, display_name(file)), work_(work), spool_(spool) {
    read_header();
    base_ = first_->below(1);
    Table header = base_->below(1).take();
    header_line_ = header.header_line;
    columns_.emplace(header.raw_header, ours);
  }

  void run() {
    text_ = columns_->header();
    bool more = take(worked_on(*first_, *columns_, work_));
    first_.reset();
    in_order(
        usable_threads(), [&] { return more ? next() : std::nullopt; },
        [this](const Lines& lines) { return computed(lines); },
        [&](Block block) { return take(std::move(block)); });
    finish();
  }

  const show::PassThrough& columns() const { return *columns_; }
  std::vector<Problem>& remarks() { return remarks_; }
  std::string sha256() { return source_.sha256(); }

 private:
  void read_header() {
    std::string block;
    while (!first_->has_header() && source_.next(block)) {
      first_->expect(static_cast<std::size_t>(std::count(block.begin(), block.end(), '\n')) + 1,
                     block.size());
      first_->read(block);
    }
    if (first_->has_header()) return;
    first_->check_content();
    first_->problems().stop_on_errors();
  }

  std::optional<Lines> next() {
    Lines out;
    if (!source_.next(out.text)) return std::nullopt;
    out.first_line = source_.first_line();
    return out;
  }

  Block computed(const Lines& lines) const {
    TableReader reader = base_->below(lines.first_line);
    reader.expect(
        static_cast<std::size_t>(std::count(lines.text.begin(), lines.text.end(), '\n')) + 1,
        lines.text.size());
    reader.read(lines.text);
    Block out = worked_on(reader, *columns_, work_);
    out.bytes = lines.text.size();
    return out;
  }

  /// Appends a block to the output, or its problems to the list. Returns false if reading on is of
  /// no use.
  bool take(Block block) {
    if (rows_ > 0)
      block.of_rows = below(header_line_, std::move(block.of_rows));
    else
      append(remarks_, block.computed.remarks);
    append(of_text_, block.of_text);
    append(of_rows_, block.of_rows);
    rows_ += block.rows;
    decimal_comma_ = decimal_comma_ || block.decimal_comma;
    if (of_text_.empty() && of_rows_.empty()) {
      if (block.computed.append) block.computed.append(text_);
      spool_.write(text_);
      text_.clear();
      return true;
    }
    after_error_ += block.bytes;
    const bool endless = source_.size() == 0 && after_error_ > kMostAfterError;
    return !endless && std::max(of_text_.size(), of_rows_.size()) < kMostProblems;
  }

  void finish() {
    if (!of_text_.empty()) throw Failure(Exit::kInput, std::move(of_text_));
    if (!of_rows_.empty()) throw Failure(Exit::kInput, std::move(of_rows_));
    if (rows_ == 0) {
      base_->check_content();
      base_->problems().stop_on_errors();
    }
    if (auto note = base_->separator_note(decimal_comma_)) remarks_.push_back(std::move(*note));
  }

  LineSource source_;
  std::optional<TableReader> first_;  // header and first rows
  std::optional<TableReader> base_;   // header alone
  std::optional<show::PassThrough> columns_;
  const RowStream::Work& work_;
  Spool& spool_;
  int header_line_ = 0;
  std::string text_;
  std::vector<Problem> of_text_, of_rows_, remarks_;
  std::size_t rows_ = 0, after_error_ = 0;
  bool decimal_comma_ = false;
};

}  // namespace

RowStream::RowStream(std::filesystem::path file, std::vector<std::string> columns,
                     const CsvOutput& output, Outcome& outcome)
    : file_(std::move(file)), columns_(std::move(columns)), output_(output), spool_(output.file) {
  outcome.kept.push_back(file_);
  refuse_existing(output, outcome);
}

void RowStream::run(const Work& work, Outcome& outcome) {
  keep_freed_memory();
  Pass pass(file_, columns_, work, spool_);
  pass.run();
  outcome.inputs.push_back({display_name(file_), pass.sha256()});
  outcome.remark(pass.remarks());
  outcome.remark(replaced_notes(pass.columns().replaced()));
}

void RowStream::deliver(const std::string& summary, Outcome& outcome) {
  if (!output_.file.empty()) outcome.text = summary + wrote(output_.file, output_.write) + "\n";
  cli::deliver(spool_, output_, outcome);
}

}  // namespace plumb::offline::cli
