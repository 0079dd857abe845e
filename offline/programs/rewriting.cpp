// SPDX-License-Identifier: Apache-2.0
#include "programs/rewriting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "programs/lexer.hpp"
#include "programs/written.hpp"

namespace plumb::offline::programs {
namespace {

constexpr std::string_view kSaid = "plumb filter: targets corrected";  // Fanuc: 32 characters

std::string_view text_of(const Program& program, const Number& number) {
  return std::string_view(program.sources[number.source].bytes)
      .substr(number.begin, number.end - number.begin);
}

/// The text in ASCII, so that it is right in every code page, and on one line.
std::string plain(std::string_view text, std::size_t most) {
  std::string out;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) continue;
    out += c >= ' ' && c <= '~' && c != ';' ? c : '?';
  }
  return out.substr(0, most);
}

std::pair<std::size_t, std::size_t> place(const Edit& edit) {
  return {edit.number.source, edit.number.begin};
}

std::vector<std::string_view> lines_of(std::string_view bytes) {
  std::vector<std::string_view> out;
  for (std::size_t at = 0; at < bytes.size(); at += out.back().size())
    out.push_back(line_at(bytes, at));
  return out;
}

/// A line of a diff: of both files, or of one of them.
struct DiffLine {
  char sign;  // ' ', '-' or '+'
  std::string_view text;
};

void put_hunk(const std::vector<DiffLine>& all, std::size_t from, std::size_t to,
              std::string& out) {
  const auto lines = [&](std::size_t begin, std::size_t end, char not_in) {
    return std::count_if(all.begin() + static_cast<std::ptrdiff_t>(begin),
                         all.begin() + static_cast<std::ptrdiff_t>(end),
                         [&](const DiffLine& line) { return line.sign != not_in; });
  };
  out += fmt::format("@@ -{},{} +{},{} @@\n", lines(0, from, '+') + 1, lines(from, to, '+'),
                     lines(0, from, '-') + 1, lines(from, to, '-'));
  for (std::size_t i = from; i < to; ++i) {
    out += all[i].sign;
    out += all[i].text;
    if (all[i].text.back() != '\n') out += "\n\\ No newline at end of file\n";
  }
}

}  // namespace

Decimals decimals_of(const Program& program, int least_mm) {
  Decimals out;
  bool metres = false;
  for (const Target& target : program.targets)
    for (std::size_t k = 0; k < target.written.numbers.size(); ++k) {
      const auto text = text_of(program, target.written.numbers[k]);
      const bool position = k < 3 && !of_joints(target.written.notation);
      metres = metres || target.written.notation == Notation::kVector;
      int& most = position ? out.position : out.orientation;
      most = std::max(most, decimals_of(text));
    }
  if (least_mm <= 0) return out;
  out.position = std::max(out.position, metres ? least_mm + 3 : least_mm);
  out.orientation = std::max(out.orientation, least_mm + 3);  // of a quaternion, radians, degrees
  return out;
}

NewDigits new_digits(const Program& program, const Target& target,
                     const std::vector<double>& values, const Decimals& decimals) {
  NewDigits out;
  const Written& written = target.written;
  for (std::size_t k = 0; k < written.numbers.size(); ++k) {
    const Number& old = written.numbers[k];
    const bool position = k < 3 && !of_joints(written.notation);
    const int places = position ? decimals.position : decimals.orientation;
    const double scale = std::pow(10.0, places);
    out.written.push_back(old.value);
    if (std::round(values[k] * scale) == std::round(old.value * scale)) continue;
    const std::string digits = written_like(values[k], places, text_of(program, old));
    out.written.back() = std::strtod(digits.c_str(), nullptr);
    out.edits.push_back({old, digits});
    for (std::size_t copy = k; copy < target.copies.size(); copy += written.numbers.size())
      out.edits.push_back({target.copies[copy], digits});
  }
  return out;
}

std::vector<std::string> edited(const Program& program, std::vector<Edit> edits) {
  std::vector<std::string> out;
  for (const Source& source : program.sources) out.push_back(source.bytes);
  std::sort(edits.begin(), edits.end(),
            [](const Edit& a, const Edit& b) { return place(a) > place(b); });
  // Two targets may share the copy of their numbers in a comment: it is written once.
  edits.erase(std::unique(edits.begin(), edits.end(),
                          [](const Edit& a, const Edit& b) { return place(a) == place(b); }),
              edits.end());
  for (const Edit& edit : edits)
    out[edit.number.source].replace(edit.number.begin, edit.number.end - edit.number.begin,
                                    edit.digits);
  return out;
}

std::string marked(const Language& language, std::string_view bytes, const Mark& mark) {
  const std::size_t first = bytes.find('\n');
  const bool returns = first != std::string_view::npos && first > 0 && bytes[first - 1] == '\r';
  const std::size_t order_mark = bytes.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;
  const std::size_t at =
      std::min(language.comment_place(bytes.substr(order_mark)) + order_mark, bytes.size());
  std::string out(bytes.substr(0, at));
  const char* const end = returns ? "\r\n" : "\n";
  if (at > order_mark && out.back() != '\n') out += end;
  for (const std::string& line :
       {std::string(kSaid), "model " + mark.model, "sha256 " + mark.sha256})
    out +=
        fmt::format("{}{}{}{}", language.comment, plain(line, language.longest), language.end, end);
  return out.append(bytes.substr(at));
}

int line_of_mark(std::string_view bytes) {
  const std::size_t at = bytes.find(kSaid);
  if (at == std::string_view::npos) return 0;
  return 1 + static_cast<int>(
                 std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

std::string unified_diff(const std::string& file, std::string_view before, std::string_view after) {
  constexpr std::size_t kContext = 3;
  const auto a = lines_of(before), b = lines_of(after);
  const std::size_t added = b.size() - std::min(a.size(), b.size());
  std::size_t put_in = 0;  // the lines that were put in stand together, where the mark is
  if (added > 0)
    while (put_in < b.size() && b[put_in].find(kSaid) == std::string_view::npos) ++put_in;
  std::vector<DiffLine> all;
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    if (j < b.size() && (i == a.size() || (added > 0 && j >= put_in && j < put_in + added))) {
      all.push_back({'+', b[j++]});
    } else if (j < b.size() && a[i] == b[j]) {
      all.push_back({' ', a[i++]});
      ++j;
    } else {
      all.push_back({'-', a[i++]});
      if (j < b.size()) all.push_back({'+', b[j++]});
    }
  }
  std::string out;
  for (std::size_t i = 0; i < all.size();) {
    if (all[i].sign == ' ') {
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    for (std::size_t k = i; k < std::min(all.size(), end + 2 * kContext); ++k)
      if (all[k].sign != ' ') end = k + 1;
    put_hunk(all, i - std::min(i, kContext), std::min(all.size(), end + kContext), out);
    i = std::min(all.size(), end + kContext);
  }
  return out.empty() ? "" : fmt::format("--- {}\n+++ {}\n", file, file) + out;
}

}  // namespace plumb::offline::programs
