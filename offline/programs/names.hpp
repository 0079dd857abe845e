// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>

#include "programs/lexer.hpp"

namespace plumb::offline::programs {

/// Targets, tools and frames by the names under which a program declares them, in lower case.
class Names {
 public:
  explicit Names(Program& program) : program_(&program) {}

  /// A target that is declared at this token. A second one of the same name spoils both.
  void declare(const Tokens& tokens, std::size_t name, Target target);

  /// Likewise a tool of `frames`, or a frame.
  void declare(const Tokens& tokens, std::size_t name, Frames& frames, Frame frame);

  /// The target of the name at this token, which a move goes to; -1 if none is declared.
  int used(const Tokens& tokens, std::size_t name);

  /// This mention of a name does no harm.
  void allow(const Tokens& tokens, std::size_t name) { allowed_.insert(place(tokens, name)); }

  /// Every other mention of a declared name spoils what it names: it may be changed there, or the
  /// numbers of a target may be used for something that is no move.
  void look_for_mentions(const Tokens& tokens);

  /// So do the mentions in the other programs, and what there moves all targets.
  void look_elsewhere(const Facts& around);

  /// Spoils what has this name, as if the program changed it at this token.
  void mention(const Tokens& tokens, std::size_t i, const std::string& lower_name);

  /// Spoils all targets, of all programs.
  void displace(const Tokens& tokens, std::size_t i);

 private:
  using Spot = std::pair<std::size_t, std::size_t>;  // source, offset
  static Spot place(const Tokens& tokens, std::size_t i) {
    return {tokens.source(), tokens.at(i).begin};
  }

  void spoil(const std::string& name, const std::string& where);

  Program* program_;
  std::map<std::string, int> index_;
  std::map<std::string, Frames*> frames_;
  std::set<Spot> allowed_;
};

}  // namespace plumb::offline::programs
