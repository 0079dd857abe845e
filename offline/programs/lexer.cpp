// SPDX-License-Identifier: Apache-2.0
#include "programs/lexer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace plumb::offline::programs {
namespace {

constexpr double kLargest = 1e12;  // larger numbers are no positions
constexpr int kDeepest = 8;        // lists within lists
constexpr std::size_t kLongest = 60;

bool digit(char c) { return c >= '0' && c <= '9'; }
bool letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' ||
         static_cast<unsigned char>(c) >= 0x80;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

Tokens::Tokens(const Source& source, std::size_t index, const Lexis& lexis)
    : bytes_(source.bytes), index_(index) {
  read(lexis);
  end_.begin = end_.end = bytes_.size();
  end_.line = tokens_.empty() ? 1 : tokens_.back().line;
}

std::size_t Tokens::word_end(std::size_t at) const {
  while (at < bytes_.size() && (letter(bytes_[at]) || digit(bytes_[at]))) ++at;
  return at;
}

std::size_t Tokens::number_end(std::size_t at) const {
  const auto digits = [&] {
    while (at < bytes_.size() && digit(bytes_[at])) ++at;
  };
  digits();
  if (at < bytes_.size() && bytes_[at] == '.') ++at;
  digits();
  if (at >= bytes_.size() || (bytes_[at] != 'e' && bytes_[at] != 'E')) return at;
  std::size_t power = at + 1;
  if (power < bytes_.size() && (bytes_[power] == '+' || bytes_[power] == '-')) ++power;
  if (power >= bytes_.size() || !digit(bytes_[power])) return at;
  at = power;
  digits();
  return at;
}

bool Tokens::begins_comment(std::size_t at, const Lexis& lexis) const {
  if (lexis.only_first && !tokens_.empty() && tokens_.back().kind != Token::Kind::kLine &&
      bytes_[tokens_.back().begin] != ':')
    return false;
  for (const auto mark : lexis.comments)
    if (bytes_.substr(at, mark.size()) == mark) return true;
  return false;
}

void Tokens::read(const Lexis& lexis) {
  using Kind = Token::Kind;
  int line = 1;
  std::size_t at = bytes_.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;  // a byte order mark
  const auto push = [&](Kind kind, std::size_t end) {
    tokens_.push_back({.kind = kind, .begin = at, .end = end, .line = line});
    at = end;
  };
  while (at < bytes_.size()) {
    const char c = bytes_[at];
    const std::size_t line_end = std::min(bytes_.find('\n', at), bytes_.size());
    if (c == '\n') {
      push(Kind::kLine, at + 1);
      ++line;
    } else if (begins_comment(at, lexis)) {
      push(Kind::kComment, line_end);
    } else if (c == '\'' && bytes_.find(c, at + 1) >= line_end) {
      push(Kind::kSign, at + 1);  // an apostrophe: MESSAGE[DON'T WAIT]
    } else if (c == lexis.quote) {
      push(Kind::kText, std::min(bytes_.find(lexis.quote, at + 1), line_end - 1) + 1);
    } else if (digit(c) || (c == '.' && at + 1 < bytes_.size() && digit(bytes_[at + 1]))) {
      push(Kind::kNumber, number_end(at));
    } else if (letter(c)) {
      push(Kind::kWord, word_end(at));
    } else if (lexis.labels && c == ':' && size() > 1 && is(size() - 2, "[")) {
      at = std::min(bytes_.find(']', at), line_end);
    } else if (c == ' ' || c == '\t' || c == '\r') {
      ++at;
    } else {
      push(Kind::kSign, bytes_.substr(at, 2) == ":=" ? at + 2 : at + 1);
    }
  }
}

std::string_view Tokens::text(std::size_t i) const {
  return bytes_.substr(at(i).begin, at(i).end - at(i).begin);
}

std::string Tokens::lower(std::size_t i) const { return lower_case(text(i)); }

bool Tokens::is(std::size_t i, std::string_view word) const {
  return text(i).size() == word.size() && lower(i) == word;
}

std::optional<Number> Tokens::number(std::size_t& i) const {
  std::size_t k = i;
  const bool minus = is(k, "-");
  if (minus || is(k, "+")) ++k;
  if (at(k).kind != Token::Kind::kNumber) return std::nullopt;
  double value = 0.0;
  const char* const end = bytes_.data() + at(k).end;
  const auto read = std::from_chars(bytes_.data() + at(k).begin, end, value);
  if (read.ec != std::errc() || read.ptr != end || !(std::abs(value) < kLargest))
    return std::nullopt;
  const Number out{
      .source = index_, .begin = at(i).begin, .end = at(k).end, .value = minus ? -value : value};
  i = k + 1;
  return out;
}

std::size_t Tokens::first_from(std::size_t byte) const {
  return static_cast<std::size_t>(
      std::partition_point(tokens_.begin(), tokens_.end(),
                           [&](const Token& token) { return token.begin < byte; }) -
      tokens_.begin());
}

std::string Tokens::whole(std::size_t from, std::size_t to) const {
  if (from >= to || ended(from)) return "";
  std::string out;
  for (const char c : bytes_.substr(at(from).begin, at(to - 1).end - at(from).begin)) {
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (!blank)
      out += c;
    else if (!out.empty() && out.back() != ' ')
      out += ' ';
  }
  return out;
}

std::string Tokens::quoted(std::size_t from, std::size_t to) const {
  std::string out = whole(from, to);
  if (out.size() > kLongest) out = out.substr(0, kLongest - 3) + "...";
  return out;
}

void Tokens::drop_comments(bool lines) {
  std::erase_if(tokens_, [&](const Token& token) {
    return token.kind == Token::Kind::kComment || (lines && token.kind == Token::Kind::kLine);
  });
}

std::optional<Value> list_at(const Tokens& tokens, std::size_t& i, int depth) {
  std::size_t k = i;
  if (!tokens.is(k, "[") || depth > kDeepest) return std::nullopt;
  Value out;
  do {
    ++k;
    Value item;
    if (tokens.is(k, "[")) {
      auto inner = list_at(tokens, k, depth + 1);
      if (!inner) return std::nullopt;
      item = std::move(*inner);
    } else if (const auto number = tokens.number(k)) {
      item.number = number;
    } else {
      const auto kind = tokens.at(k).kind;
      if (kind != Token::Kind::kWord && kind != Token::Kind::kText) return std::nullopt;
      item.word = tokens.lower(k++);
    }
    out.items.push_back(std::move(item));
  } while (tokens.is(k, ","));
  if (!tokens.is(k, "]")) return std::nullopt;
  i = k + 1;
  return out;
}

std::vector<Number> numbers_of(const Value& value, std::size_t count) {
  std::vector<Number> out;
  for (const Value& item : value.items)
    if (item.number) out.push_back(*item.number);
  if (out.size() != count || value.items.size() != count) out.clear();
  return out;
}

std::string_view line_at(std::string_view bytes, std::size_t at) {
  return bytes.substr(at, std::min(bytes.find('\n', at), bytes.size() - 1) + 1 - at);
}

}  // namespace plumb::offline::programs
