// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "programs/program.hpp"

/// Words, numbers and signs of a program, whatever its language. No bytes are an error here.
namespace plumb::offline::programs {

struct Token {
  enum class Kind { kEnd, kNumber, kWord, kText, kSign, kComment, kLine } kind = Kind::kEnd;
  std::size_t begin = 0, end = 0;
  int line = 0;
};

/// How a language writes comments and texts.
struct Lexis {
  std::vector<std::string_view> comments;  // what begins one; it ends with the line
  char quote = '"';
  bool only_first = false;  // a comment stands only where a statement begins, after "12:"
  bool labels = false;      // "[3:any text]" is [3]
};

class Tokens {
 public:
  Tokens(const Source& source, std::size_t index, const Lexis& lexis);

  std::size_t size() const { return tokens_.size(); }
  const Token& at(std::size_t i) const { return i < tokens_.size() ? tokens_[i] : end_; }
  std::string_view text(std::size_t i) const;
  std::string lower(std::size_t i) const;
  int line(std::size_t i) const { return at(i).line; }
  bool is(std::size_t i, std::string_view lower_case) const;
  bool is_word(std::size_t i) const { return at(i).kind == Token::Kind::kWord; }
  bool ended(std::size_t i) const { return i >= tokens_.size(); }

  /// The number at token i, a sign before it included; moves i behind it.
  std::optional<Number> number(std::size_t& i) const;

  /// The first token that begins at this byte or behind it.
  std::size_t first_from(std::size_t byte) const;

  /// Text of the tokens [from, to) as it stands in the file, on one line; whole, or not too long.
  std::string whole(std::size_t from, std::size_t to) const;
  std::string quoted(std::size_t from, std::size_t to) const;

  /// Removes the comments, and the ends of lines too if `lines`.
  void drop_comments(bool lines);

  std::size_t source() const { return index_; }

 private:
  void read(const Lexis& lexis);
  std::size_t word_end(std::size_t at) const;
  std::size_t number_end(std::size_t at) const;
  bool begins_comment(std::size_t at, const Lexis& lexis) const;

  std::string_view bytes_;
  std::size_t index_;
  std::vector<Token> tokens_;
  Token end_;
};

/// "[[1, 2], word]" as a tree; empty if brackets do not match or something else is computed in it.
struct Value {
  std::vector<Value> items;
  std::optional<Number> number;
  std::string word;  // lower case
};

/// The list that begins at token i with '['; moves i behind it.
std::optional<Value> list_at(const Tokens& tokens, std::size_t& i, int depth = 0);

/// The numbers of a list of so many numbers; empty if it is none.
std::vector<Number> numbers_of(const Value& value, std::size_t count);

std::string lower_case(std::string_view text);

/// From this byte to the end of its line, with the sign that ends it.
std::string_view line_at(std::string_view bytes, std::size_t at);

}  // namespace plumb::offline::programs
