// SPDX-License-Identifier: Apache-2.0
#include "import/source_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cell/unmarked_utf16.hpp"
#include "program/file.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kLongestLine = 1 << 20;

/// Different letters beyond ASCII one after another, which no European word has.
constexpr std::size_t kNoEuropeanWord = 4;
/// First bytes of a file, which tell a text from a binary file.
constexpr std::size_t kLooked = 1 << 16;

void append_utf8(std::string& out, unsigned code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xC0 | (code >> 6));
    out += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    out += static_cast<char>(0xE0 | (code >> 12));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (code & 0x3F));
  }
}

/// Latin-1, with the signs that Windows-1252 puts where it has none: dashes and quotes.
std::string from_latin1(std::string_view bytes) {
  static constexpr unsigned kWindows[32] = {
      0x20AC, 0x81,   0x201A, 0x192,  0x201E, 0x2026, 0x2020, 0x2021, 0x2C6,  0x2030, 0x160,
      0x2039, 0x152,  0x8D,   0x17D,  0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
      0x2013, 0x2014, 0x2DC,  0x2122, 0x161,  0x203A, 0x153,  0x9D,   0x17E,  0x178};
  std::string out;
  out.reserve(bytes.size() + bytes.size() / 8);
  for (char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    append_utf8(out, byte >= 0x80 && byte < 0xA0 ? kWindows[byte - 0x80] : byte);
  }
  return out;
}

/// DOS programs end a text with Ctrl-Z.
void remove_end_mark(std::string& bytes) {
  const auto last = bytes.find_last_not_of("\x1A\r\n \t");
  const auto end = bytes.find('\x1A', last == bytes.npos ? 0 : last);
  if (end != bytes.npos) bytes.erase(end);
}

std::string from_utf16(std::string_view bytes, bool big_endian) {
  std::string out;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const auto first = static_cast<unsigned char>(bytes[i]);
    const auto second = static_cast<unsigned char>(bytes[i + 1]);
    append_utf8(out, big_endian ? (first << 8 | second) : (second << 8 | first));
  }
  return out;
}

bool looks_binary(std::string_view bytes) {
  const auto part = bytes.substr(0, kLooked);
  return std::any_of(part.begin(), part.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 && c != '\n' && c != '\r' && c != '\t' && c != '\f';
  });
}

unsigned byte_at(std::string_view bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

/// True if all bytes beyond ASCII form characters of Shift-JIS, and at least one of these is a pair
/// of bytes that does not occur in European text.
bool looks_shift_jis(std::string_view bytes) {
  bool sure = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const unsigned lead = byte_at(bytes, i);
    if (lead < 0x80 || (lead >= 0xA1 && lead <= 0xDF)) continue;  // ASCII, half-width kana
    const unsigned trail = i + 1 < bytes.size() ? byte_at(bytes, i + 1) : 0;
    const bool is_lead = (lead >= 0x81 && lead <= 0x9F) || (lead >= 0xE0 && lead <= 0xFC);
    if (!is_lead || trail < 0x40 || trail == 0x7F || trail > 0xFC) return false;
    sure = sure || (lead <= 0x9F && trail >= 0x80);
    ++i;
  }
  return sure;
}

/// Four different letters with accents one after another: no European word has them, and words in
/// Chinese, Korean, Japanese or Cyrillic encodings do.
bool looks_not_latin(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    std::size_t end = i;
    std::set<char> different;
    while (end < bytes.size() && byte_at(bytes, end) >= 0x80) different.insert(bytes[end++]);
    if (different.size() >= kNoEuropeanWord) return true;
    i = end + 1;
  }
  return false;
}

Problem note(std::string message) {
  return {.severity = Severity::kNote,
          .code = "N-IMPORT-ENCODING",
          .message = std::move(message),
          .help = "the imported file is UTF-8"};
}

void cut_lines(std::string_view text, std::vector<std::string_view>& out) {
  out.reserve(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1);
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    auto line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    out.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

void decode(std::string bytes, const std::string& file, SourceText& out) {
  out.file = file;
  out.sha256 = sha256(bytes);
  const auto fail = [&](const char* code, std::string message, std::string help) {
    throw Failure(Exit::kInput, {.code = code,
                                 .message = std::move(message),
                                 .place = Place{.file = file},
                                 .help = std::move(help)});
  };
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    bytes = from_utf16(std::string_view(bytes).substr(2), bytes.starts_with("\xFE\xFF"));
    out.remarks.push_back(note(fmt::format("{} is in UTF-16", file)));
  } else if (bytes.starts_with("\xEF\xBB\xBF")) {
    bytes.erase(0, 3);
  } else if (const auto order = unmarked_utf16(bytes)) {
    bytes = from_utf16(bytes, *order == ByteOrder::kBigEndian);
    out.remarks.push_back(
        note(fmt::format("{} is in UTF-16, though no byte-order mark says so", file)));
  }
  remove_end_mark(bytes);
  if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("\xD0\xCF\x11\xE0"))
    fail("E-IMPORT-BINARY", "this is a workbook of a spreadsheet, no text",
         "save its sheet as CSV, and import that");
  if (looks_binary(bytes))
    fail("E-IMPORT-BINARY", "this is no text file",
         "export the measurements as text (CSV) from the tracker's or controller's software");
  if (find_invalid_utf8(bytes) != std::string::npos) {
    if (looks_shift_jis(bytes))
      fail("E-IMPORT-ENCODING",
           "the text is in Shift-JIS, and import reads UTF-8, UTF-16 and Latin-1",
           fmt::format("convert it: iconv -f CP932 -t UTF-8 {} > utf8.csv", file));
    if (looks_not_latin(bytes))
      fail("E-IMPORT-ENCODING",
           "the text is in none of the encodings that import reads: UTF-8, UTF-16 and Latin-1",
           fmt::format("save it as UTF-8, or convert it from the encoding it was written in, as "
                       "with: iconv -f GB18030 -t UTF-8 {} > utf8.csv",
                       file));
    bytes = from_latin1(bytes);
    out.remarks.push_back(note(fmt::format("{} is not UTF-8; it was read as Latin-1", file)));
  }
  out.texts = std::make_shared<TextStore>(std::move(bytes));
  cut_lines(out.texts->file(), out.lines);
  for (std::size_t k = 0; k < out.lines.size(); ++k)
    if (out.lines[k].size() > kLongestLine)
      throw Failure(Exit::kInput,
                    {.code = "E-CSV-LINE",
                     .message = "a line is longer than 1 MB: this is no table of measurements",
                     .place = Place{.file = file, .line = static_cast<int>(k) + 1},
                     .help = "look at its beginning: head -c 300 " + file});
  if (std::all_of(out.lines.begin(), out.lines.end(),
                  [](std::string_view line) { return trimmed(line).empty(); }))
    fail("E-IMPORT-EMPTY", "the file is empty", "export the measurements again");
}

std::string_view other_format(std::string_view line) {
  if (line.starts_with("PK\x03\x04")) return "a spreadsheet";
  if (line.starts_with("<")) return "XML";
  if (line.starts_with("{") || line.starts_with("[{") || line.starts_with("[[") || line == "[")
    return "JSON";
  const bool key = line.ends_with(":") && line.find_first_of(" ,;\t") == line.npos;
  return key || line == "---" ? "YAML" : "";
}

}  // namespace plumb::offline
