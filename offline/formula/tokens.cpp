// SPDX-License-Identifier: Apache-2.0
#include "formula/tokens.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace plumb::offline {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

FormulaProblem trouble(std::size_t at, std::size_t length, std::string message, std::string label) {
  return {.at = at,
          .length = length,
          .message = std::move(message),
          .label = std::move(label),
          .help = "numbers as in 1.5e-6, units as in 50 [N m], signs + - * / ^ ( ) ,"};
}

/// The number at the beginning of `text`; its length is 0 if there is none.
Token number(std::string_view text) {
  Token out{.kind = Token::Kind::kNumber};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out.value);
  if (error == std::errc{} && std::isfinite(out.value))
    out.length = static_cast<std::size_t>(end - text.data());
  return out;
}

}  // namespace

std::vector<Token> tokens_of(std::string_view text, FormulaProblems& problems) {
  std::vector<Token> out;
  std::size_t at = 0;
  while (at < text.size()) {
    const char c = text[at];
    Token token{.at = at};
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      ++at;
      continue;
    }
    if (is_digit(c) || c == '.') {
      token = number(text.substr(at));
      token.at = at;
      if (token.length == 0) {
        problems.push_back(trouble(at, 1, "this number cannot be read", "here"));
        break;
      }
    } else if (is_letter(c)) {
      token.kind = Token::Kind::kName;
      while (at + token.length < text.size() &&
             (is_letter(text[at + token.length]) || is_digit(text[at + token.length])))
        ++token.length;
    } else if (c == '[') {
      const std::size_t end = text.find(']', at);
      if (end == std::string_view::npos) {
        problems.push_back(trouble(at, 1, "a unit has no end", "']' is missing"));
        break;
      }
      token.kind = Token::Kind::kUnit;
      token.length = end + 1 - at;
      token.text = text.substr(at + 1, token.length - 2);
    } else if (std::string_view("+-*/^(),").find(c) != std::string_view::npos) {
      token.kind = Token::Kind::kSign;
      token.length = 1;
    } else {
      problems.push_back(trouble(at, 1, "this does not belong to a formula", "unknown sign"));
      break;
    }
    if (token.kind != Token::Kind::kUnit) token.text = text.substr(at, token.length);
    at += token.length;
    out.push_back(std::move(token));
  }
  out.push_back({.kind = Token::Kind::kEnd, .at = at});
  return out;
}

}  // namespace plumb::offline
