// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "programs/program.hpp"

namespace plumb::offline::programs {

/// Which tool and frame are in force at each move of a file, so far as its text says for sure. A
/// reader tells what it meets, in the order of the text; names() then judges. In force is what a
/// statement before the move set in the same routine; at the beginning of each, "default". But
///   * a condition or loop that sets another one makes it unknown behind its end, and a loop from
///     its beginning on;
///   * so does a call of a routine that sets one, directly or through others;
///   * a thread or an interrupt that sets one makes it unknown in the whole file;
///   * in a routine with jumps it is known only if all statements set the same, and one of them
///     stands before everything else.
/// What is unknown has a name in parentheses that says why.
class CurrentFrame {
 public:
  enum class What { kTool, kFrame };

  void routine(const std::string& name, bool any_time = false);  // any_time: beside the moves
  void end_routine();
  void block(bool loop);
  void branch();  // ELSE, CASE: where the innermost block began
  void end_block();
  bool end();  // of whichever is innermost: true for a routine
  void set(What what, std::string name);
  void call(const std::string& name, bool any_time = false);
  void label();
  void jump();
  std::size_t move();  // counts the moves from 0

  /// What routines do, for all programs.
  void report(Facts& facts) const;

  /// The tool or the frame of each move.
  std::vector<std::string> names(What what, const Facts& around) const;

 private:
  enum class Kind {
    kRoutine,
    kEndRoutine,
    kBlock,
    kLoop,
    kBranch,
    kEnd,
    kSet,
    kCall,
    kLabel,
    kMove
  };
  struct Step {
    Kind kind;
    What what = What::kTool;
    std::string name = {};
    std::size_t end = static_cast<std::size_t>(-1);  // of a routine or block: its last step
    bool jumps = false;
  };

  bool inside_block() const {
    return !open_.empty() && steps_[open_.back()].kind != Kind::kRoutine;
  }
  const std::string& routine_name() const;
  void close(Kind kind);
  std::string set_to(const Step& step, What what, const Facts& around) const;
  bool differs(std::size_t begin, const std::string& from, What what, const Facts& around) const;
  bool passed_by(std::size_t begin, What what, const Facts& around) const;

  std::vector<Step> steps_;
  std::vector<std::size_t> open_;  // routines and blocks around
  std::set<std::string> any_time_;
  Facts own_;
  std::size_t moves_ = 0;
};

}  // namespace plumb::offline::programs
