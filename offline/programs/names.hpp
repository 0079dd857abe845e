// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>

#include "programs/lexer.hpp"

namespace plumb::offline::programs {

/// Targets by the names under which a program declares them, in lower case.
class Names {
 public:
  explicit Names(Program& program) : program_(&program) {}

  /// A target that is declared at this token. A second one of the same name spoils both.
  void declare(const Tokens& tokens, std::size_t name, Target target);

  /// The target of the name at this token, which a move goes to; -1 if none is declared.
  int used(const Tokens& tokens, std::size_t name);

  /// This mention of a name does no harm.
  void allow(const Tokens& tokens, std::size_t name) { allowed_.insert(place(tokens, name)); }

  /// Every other mention of a declared name spoils its target: it may be changed there, or its
  /// numbers may be used for something that is no move.
  void look_for_mentions(const Tokens& tokens);

  /// Spoils all targets.
  void spoil_all(const std::string& why, const std::string& help);

 private:
  using Spot = std::pair<std::size_t, std::size_t>;  // source, offset
  static Spot place(const Tokens& tokens, std::size_t i) {
    return {tokens.source(), tokens.at(i).begin};
  }

  Program* program_;
  std::map<std::string, int> index_;
  std::set<Spot> allowed_;
};

}  // namespace plumb::offline::programs
