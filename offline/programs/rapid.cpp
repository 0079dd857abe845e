// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "programs/languages.hpp"
#include "programs/names.hpp"
#include "programs/written.hpp"

/// RAPID of ABB: robtarget [[x,y,z],[q1,q2,q3,q4],[cf1,cf4,cf6,cfx],[six external axes]], tooldata
/// [robhold,[[x,y,z],[q]],load], wobjdata [robhold,ufprog,ufmec,[user frame],[object frame]].
/// Technical reference manual RAPID Instructions, Functions and Data types.
namespace plumb::offline::programs {
namespace {

struct MoveWords {
  std::string_view name;
  Motion motion;
  std::size_t targets;  // arguments that are targets, the first ones
  std::size_t tool;     // which argument is the tool
};

constexpr MoveWords kRapidMoves[] = {
    {"movej", Motion::kJoint, 1, 3},         {"movel", Motion::kLinear, 1, 3},
    {"movec", Motion::kCircleEnd, 2, 4},     {"movejdo", Motion::kJoint, 1, 3},
    {"moveldo", Motion::kLinear, 1, 3},      {"movecdo", Motion::kCircleEnd, 2, 4},
    {"movejsync", Motion::kJoint, 1, 3},     {"movelsync", Motion::kLinear, 1, 3},
    {"movecsync", Motion::kCircleEnd, 2, 4}, {"triggj", Motion::kJoint, 1, 4},
    {"triggl", Motion::kLinear, 1, 4},       {"triggc", Motion::kCircleEnd, 2, 5},
    {"moveabsj", Motion::kJoint, 1, 3},
};

/// An argument of an instruction: tokens [begin, end), and what stands behind \WObj:= in it.
struct Argument {
  std::size_t begin = 0, end = 0;
  std::size_t wobj = 0;  // token, 0: none
};

class RapidReader {
 public:
  explicit RapidReader(Program& program)
      : program_(program), names_(program), tokens_(program.sources[0], 0, {.comments = {"!"}}) {
    tokens_.drop_comments(true);
  }

  void read() {
    program_.tools["tool0"].X = Transformd();
    program_.frames["wobj0"].X = Transformd();
    for (std::size_t i = 0; i < tokens_.size(); ++i) declaration(i);
    for (std::size_t i = 0; i < tokens_.size(); ++i) instruction(i);
    for (std::size_t i = 0; i < tokens_.size(); ++i)
      if (tokens_.is(i, "pdispon") || tokens_.is(i, "pdispset"))
        names_.spoil_all(fmt::format("{} in line {} moves all targets while the program runs",
                                     tokens_.text(i), tokens_.line(i)),
                         "put the displacement into a work object");
    if (configuration_is_off())
      for (Target& one : program_.targets) one.configuration = {};
    names_.look_for_mentions(tokens_);
  }

 private:
  /// Behind ConfL \Off or ConfJ \Off the controller goes to the nearest joint positions, whatever a
  /// target states.
  bool configuration_is_off() const {
    for (std::size_t i = 0; i + 2 < tokens_.size(); ++i)
      if ((tokens_.is(i, "confl") || tokens_.is(i, "confj")) && tokens_.is(i + 1, "\\") &&
          tokens_.is(i + 2, "off"))
        return true;
    return false;
  }

  void declaration(std::size_t i) {
    const bool pose = tokens_.is(i, "robtarget"), joints = tokens_.is(i, "jointtarget");
    const bool tool = tokens_.is(i, "tooldata"), wobj = tokens_.is(i, "wobjdata");
    if (!(pose || joints || tool || wobj) || !tokens_.is_word(i + 1)) return;
    std::size_t k = i + 3;
    std::optional<Value> value;
    if (tokens_.is(i + 2, ":=")) value = list_at(tokens_, k);
    if (value && !tokens_.is(k, ";")) value.reset();
    if (pose || joints) {
      names_.declare(tokens_, i + 1, target(value, pose));
    } else {
      Frames& frames = tool ? program_.tools : program_.frames;
      const auto [at, is_new] =
          frames.emplace(tokens_.lower(i + 1), tool ? tool_of(value) : work_of(value));
      if (!is_new) at->second = {.X = {}, .why = "it is declared more than once"};
      names_.allow(tokens_, i + 1);
    }
  }

  static Target target(const std::optional<Value>& value, bool pose) {
    Target out;
    if (value && pose && value->items.size() == 4) {
      const auto& parts = value->items;
      auto p = numbers_of(parts[0], 3);
      const auto q = numbers_of(parts[1], 4), cf = numbers_of(parts[2], 4);
      if (!p.empty() && !q.empty() && !cf.empty()) {
        p.insert(p.end(), q.begin(), q.end());
        out.written = {.notation = Notation::kQuaternion, .numbers = p};
        out.configuration = configuration(cf);
      }
    } else if (value && !pose && value->items.size() == 2) {
      out.written = {.notation = Notation::kJoints_deg, .numbers = numbers_of(value->items[0], 6)};
    }
    if (out.written.numbers.empty()) {
      out.why = "it is not stated as plain numbers";
      out.help = "state it as [[x,y,z],[q1,q2,q3,q4],[cf1,cf4,cf6,cfx],[...]]";
    }
    return out;
  }

  /// cf1, cf4, cf6 are quarter turns of axes 1, 4, 6. cfx is 0 to 7: 4 with the wrist behind axis
  /// 1, 2 behind the lower arm, 1 with axis 5 negative.
  static Configuration configuration(const std::vector<Number>& cf) {
    Configuration out;
    constexpr int kAxes[] = {0, 3, 5};
    for (std::size_t k = 0; k < 3; ++k)
      out.ranges.push_back({kAxes[k], 90.0 * cf[k].value, 90.0 * (cf[k].value + 1.0)});
    const int x = static_cast<int>(std::clamp(cf[3].value, -1.0, 8.0));
    if (x < 0 || x > 7) return out;
    out.ranges.push_back({4, x & 1 ? -360.0 : 0.0, x & 1 ? 0.0 : 360.0});
    out.front = (x & 4) == 0;
    out.elbow_front = (x & 2) == 0;
    return out;
  }

  static std::optional<Transformd> frame_of(const Value& value) {
    if (value.items.size() != 2) return std::nullopt;
    auto p = numbers_of(value.items[0], 3);
    const auto q = numbers_of(value.items[1], 4);
    p.insert(p.end(), q.begin(), q.end());
    return pose_of({.notation = Notation::kQuaternion, .numbers = p});
  }

  static Frame tool_of(const std::optional<Value>& value) {
    if (!value || value->items.size() < 2) return {.X = {}, .why = "it is not stated as numbers"};
    if (value->items[0].word != "true") return {.X = {}, .why = "the tool stands in the cell"};
    return {.X = frame_of(value->items[1]), .why = "it is not stated as numbers"};
  }

  static Frame work_of(const std::optional<Value>& value) {
    if (!value || value->items.size() != 5) return {.X = {}, .why = "it is not stated as numbers"};
    if (value->items[0].word != "false") return {.X = {}, .why = "the robot holds the work"};
    if (value->items[1].word != "true") return {.X = {}, .why = "another machine moves the work"};
    const auto user = frame_of(value->items[3]), object = frame_of(value->items[4]);
    if (!user || !object) return {.X = {}, .why = "it is not stated as numbers"};
    return {.X = *user * *object, .why = ""};
  }

  std::vector<Argument> arguments(std::size_t i) const {
    std::vector<Argument> out;
    int depth = 0;
    Argument now{.begin = i, .end = 0};
    const auto close = [&](std::size_t k) {
      if (now.end == 0) now.end = k;
      if (now.end > now.begin) out.push_back(now);
      now = {.begin = k + 1, .end = 0};
    };
    for (; !tokens_.ended(i) && !tokens_.is(i, ";"); ++i) {
      if (tokens_.is(i, "[") || tokens_.is(i, "(") || tokens_.is(i, "{")) ++depth;
      if (tokens_.is(i, "]") || tokens_.is(i, ")") || tokens_.is(i, "}")) --depth;
      if (depth != 0) continue;
      if (tokens_.is(i, "\\") && now.end == 0) now.end = i;
      const bool wobj = tokens_.is(i, "\\") && tokens_.is(i + 1, "wobj");
      if (wobj && tokens_.is(i + 2, ":=")) now.wobj = i + 3;
      if (tokens_.is(i, ",")) close(i);
    }
    close(i);
    return out;
  }

  /// A name stands alone if the argument ends behind it; else it is computed, and not known here.
  std::string name_at(std::size_t i) const {
    const bool alone = tokens_.is_word(i) && (tokens_.is(i + 1, ";") || tokens_.is(i + 1, ",") ||
                                              tokens_.is(i + 1, "\\"));
    return alone ? tokens_.lower(i) : "(computed)";
  }

  void instruction(std::size_t i) {
    if (changed_frame(i)) return;
    const auto* words = std::find_if(std::begin(kRapidMoves), std::end(kRapidMoves),
                                     [&](const MoveWords& w) { return tokens_.is(i, w.name); });
    if (words == std::end(kRapidMoves) || !tokens_.is_word(i)) return;
    const auto given = arguments(i + 1);
    if (given.size() <= words->tool) return;
    Move move{.motion = words->motion,
              .tool = name_at(given[words->tool].begin),
              .frame = "wobj0",
              .line = tokens_.line(i)};
    for (const Argument& argument : given)
      if (argument.wobj > 0) move.frame = name_at(argument.wobj);
    for (std::size_t k = 0; k < words->targets; ++k) {
      Move one = move;
      if (k + 1 < words->targets) one.motion = Motion::kVia;
      one.target = goal(given[k], words->name == "moveabsj");
      program_.moves.push_back(one);
    }
  }

  int goal(const Argument& at, bool joints) {
    if (at.end == at.begin + 1 && tokens_.is_word(at.begin)) {
      if (const int known = names_.used(tokens_, at.begin); known >= 0) return known;
      const int out =
          listed(at, "the program does not state it", "state it in the module of its moves");
      program_.targets[static_cast<std::size_t>(out)].missing = true;
      return out;
    }
    std::size_t k = at.begin;
    if (const auto value = list_at(tokens_, k); value && k == at.end) {
      Target inline_one = target(value, !joints);
      inline_one.name = "target of the move";
      inline_one.line = tokens_.line(at.begin);
      program_.targets.push_back(inline_one);
      return static_cast<int>(program_.targets.size()) - 1;
    }
    const bool offset = tokens_.is(at.begin, "offs") || tokens_.is(at.begin, "reltool");
    if (offset && tokens_.is(at.begin + 1, "(") && tokens_.is_word(at.begin + 2) &&
        tokens_.is(at.begin + 3, ",")) {
      names_.allow(tokens_, at.begin + 2);
      return listed(at, "it is an offset of another target", "state it as a target of its own");
    }
    return listed(at, "it is computed while the program runs", "state it as a target of its own");
  }

  int listed(const Argument& at, std::string why, std::string help) {
    return program_.list(tokens_.quoted(at.begin, at.end), 0, tokens_.line(at.begin),
                         std::move(why), std::move(help));
  }

  /// "tGun.tframe.trans := ...": what was declared does not hold.
  bool changed_frame(std::size_t i) {
    if (!tokens_.is_word(i) || tokens_.is(i - 1, ".")) return false;
    std::size_t k = i + 1;
    while (tokens_.is(k, ".") && tokens_.is_word(k + 1)) k += 2;
    const bool declared = i > 0 && (tokens_.is(i - 1, "tooldata") || tokens_.is(i - 1, "wobjdata"));
    if (!tokens_.is(k, ":=") || tokens_.is(i - 1, "\\") || declared) return false;
    for (Frames* frames : {&program_.tools, &program_.frames})
      if (const auto at = frames->find(tokens_.lower(i)); at != frames->end())
        at->second = {
            .X = {},
            .why = fmt::format("line {} changes it while the program runs", tokens_.line(i))};
    return true;
  }

  Program& program_;
  Names names_;
  Tokens tokens_;
};

}  // namespace

void read_rapid(Program& program) { RapidReader(program).read(); }

/// Behind the line of MODULE, before which no comment needs to be legal.
std::size_t rapid_comment_place(std::string_view bytes) {
  std::size_t at = 0;
  while (at < bytes.size()) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size() - 1) + 1;
    const std::string line = lower_case(bytes.substr(at, end - at));
    const std::size_t word = line.find_first_not_of(" \t");
    if (word != std::string::npos && line.substr(word, 7) == "module ") {
      // MODULE m (SYSMODULE, NOSTEPIN): the list may go on for lines.
      const std::size_t open = line.find('('), shut = line.find(')');
      if (open != std::string::npos && shut == std::string::npos)
        return std::min(bytes.find('\n', bytes.find(')', at)), bytes.size() - 1) + 1;
      return end;
    }
    at = end;
  }
  return 0;
}

}  // namespace plumb::offline::programs
