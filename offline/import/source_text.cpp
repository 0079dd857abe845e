// SPDX-License-Identifier: Apache-2.0
#include "import/source_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "program/file.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kLooked = 1 << 16;  // bytes that tell a text from a binary file

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

std::string from_latin1(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size() + bytes.size() / 8);
  for (char c : bytes) append_utf8(out, static_cast<unsigned char>(c));
  return out;
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

Problem note(std::string message) {
  return {.severity = Severity::kNote,
          .code = "N-IMPORT-ENCODING",
          .message = std::move(message),
          .help = "the imported file is UTF-8"};
}

void cut_lines(std::string_view text, std::vector<std::string_view>& out) {
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
  }
  if (looks_binary(bytes))
    fail("E-IMPORT-BINARY", "this is no text file",
         "export the measurements as text (CSV) from the tracker's or controller's software");
  if (find_invalid_utf8(bytes) != std::string::npos) {
    bytes = from_latin1(bytes);
    out.remarks.push_back(note(fmt::format("{} is not UTF-8; it was read as Latin-1", file)));
  }
  out.bytes = std::move(bytes);
  cut_lines(out.bytes, out.lines);
  if (std::all_of(out.lines.begin(), out.lines.end(),
                  [](std::string_view line) { return trimmed(line).empty(); }))
    fail("E-IMPORT-EMPTY", "the file is empty", "export the measurements again");
}

}  // namespace plumb::offline
