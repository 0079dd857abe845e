// SPDX-License-Identifier: Apache-2.0
#include "programs/current_frame.hpp"

#include <algorithm>
#include <utility>

namespace plumb::offline::programs {
namespace {

const std::string kUnset = "default";
const std::string kInBlock = "(set in a loop or a condition)";
const std::string kCalled = "(set by a routine that is called)";
const std::string kBeside = "(set by a thread or an interrupt)";
const std::string kJumps = "(set where a jump may pass it by)";

const std::set<std::string>& setters(CurrentFrame::What what, const Facts& facts) {
  return what == CurrentFrame::What::kTool ? facts.sets_tool : facts.sets_frame;
}

}  // namespace

const std::string& CurrentFrame::routine_name() const {
  static const std::string kNone;
  for (std::size_t k = open_.size(); k-- > 0;)
    if (steps_[open_[k]].kind == Kind::kRoutine) return steps_[open_[k]].name;
  return kNone;
}

void CurrentFrame::routine(const std::string& name, bool any_time) {
  open_.push_back(steps_.size());
  steps_.push_back({.kind = Kind::kRoutine, .name = name});
  if (any_time) any_time_.insert(name);
}

void CurrentFrame::close(Kind kind) {
  steps_[open_.back()].end = steps_.size();
  steps_.push_back({.kind = kind});
  open_.pop_back();
}

void CurrentFrame::end_routine() {
  while (inside_block()) close(Kind::kEnd);
  if (!open_.empty()) close(Kind::kEndRoutine);
}

void CurrentFrame::block(bool loop) {
  open_.push_back(steps_.size());
  steps_.push_back({.kind = loop ? Kind::kLoop : Kind::kBlock});
}

void CurrentFrame::branch() {
  if (inside_block()) steps_.push_back({.kind = Kind::kBranch});
}

void CurrentFrame::end_block() {
  if (inside_block()) close(Kind::kEnd);
}

bool CurrentFrame::end() {
  const bool block = inside_block();
  block ? end_block() : end_routine();
  return !block;
}

void CurrentFrame::set(What what, std::string name) {
  steps_.push_back({.kind = Kind::kSet, .what = what, .name = std::move(name)});
  if (routine_name().empty()) return;
  (what == What::kTool ? own_.sets_tool : own_.sets_frame).insert(routine_name());
}

void CurrentFrame::call(const std::string& name, bool any_time) {
  steps_.push_back({.kind = Kind::kCall, .name = name});
  if (!routine_name().empty()) own_.calls[routine_name()].insert(name);
  if (any_time) any_time_.insert(name);
}

void CurrentFrame::label() { steps_.push_back({.kind = Kind::kLabel}); }

void CurrentFrame::jump() {
  label();  // nothing behind it is sure to be done
  for (std::size_t k = open_.size(); k-- > 0;)
    if (steps_[open_[k]].kind == Kind::kRoutine) {
      steps_[open_[k]].jumps = true;
      return;
    }
}

std::size_t CurrentFrame::move() {
  steps_.push_back({.kind = Kind::kMove});
  if (!routine_name().empty()) own_.moves.insert(routine_name());
  return moves_++;
}

void CurrentFrame::report(Facts& facts) const { facts.add(own_); }

/// What the step makes of the tool or the frame; empty if it leaves it.
std::string CurrentFrame::set_to(const Step& step, What what, const Facts& around) const {
  if (step.kind == Kind::kSet && step.what == what) return step.name;
  if (step.kind == Kind::kCall && setters(what, around).contains(step.name)) return kCalled;
  return "";
}

/// Whether a step of the block sets another one than `from`.
bool CurrentFrame::differs(std::size_t begin, const std::string& from, What what,
                           const Facts& around) const {
  const std::size_t end = std::min(steps_[begin].end, steps_.size());
  for (std::size_t i = begin + 1; i < end; ++i) {
    if (steps_[i].kind == Kind::kRoutine) i = std::min(steps_[i].end, end);
    if (i >= end) break;
    const std::string to = set_to(steps_[i], what, around);
    if (!to.empty() && to != from) return true;
  }
  return false;
}

/// In a routine with jumps: whether a statement that sets it may be left out, or come too late.
bool CurrentFrame::passed_by(std::size_t begin, What what, const Facts& around) const {
  if (!steps_[begin].jumps) return false;
  for (std::size_t i = begin + 1; i < std::min(steps_[begin].end, steps_.size()); ++i) {
    if (steps_[i].kind == Kind::kCall || (steps_[i].kind == Kind::kSet && steps_[i].what != what)) {
      if (set_to(steps_[i], what, around).empty()) continue;
    }
    const std::string first = set_to(steps_[i], what, around);
    return first.empty() ? differs(begin, "", what, around) : differs(begin, first, what, around);
  }
  return false;
}

std::vector<std::string> CurrentFrame::names(What what, const Facts& around) const {
  struct Level {
    std::size_t begin;
    std::string before;
    bool passed_by;
  };
  std::vector<Level> levels;
  std::vector<std::string> out;
  std::string now = kUnset;
  const bool beside = std::any_of(any_time_.begin(), any_time_.end(), [&](const auto& name) {
    return setters(what, around).contains(name);
  });
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const bool unsure = !levels.empty() && levels.back().passed_by;
    if (step.kind == Kind::kRoutine) {
      levels.push_back({i, std::exchange(now, kUnset), passed_by(i, what, around)});
    } else if (step.kind == Kind::kBlock || step.kind == Kind::kLoop) {
      if (step.kind == Kind::kLoop && differs(i, now, what, around)) now = kInBlock;
      levels.push_back({i, now, unsure});
    } else if (step.kind == Kind::kBranch) {
      now = levels.back().before;
    } else if (step.kind == Kind::kEnd || step.kind == Kind::kEndRoutine) {
      const Level& level = levels.back();
      const bool other =
          step.kind == Kind::kEnd && differs(level.begin, level.before, what, around);
      now = other ? kInBlock : level.before;
      levels.pop_back();
    } else if (step.kind == Kind::kMove) {
      out.push_back(beside ? kBeside : unsure ? kJumps : now);
    } else if (const std::string to = set_to(step, what, around); !to.empty()) {
      now = to;
    }
  }
  return out;
}

}  // namespace plumb::offline::programs
