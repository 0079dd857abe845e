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

/// Other instructions whose last argument is a tool that they only read.
constexpr std::string_view kReaders[] = {"searchl", "searchc",   "arcl",    "arcc",  "arclstart",
                                         "arclend", "arccstart", "arccend", "spotl", "spotj",
                                         "spotml",  "spotmj",    "displ",   "dispc"};
/// Motion to where the text does not say, and places that are reached from several others.
constexpr std::string_view kElsewhere[] = {"egmrunjoint", "egmrunpose", "indamove", "indcmove",
                                           "inddmove",    "indrmove",   "for",      "while",
                                           "endfor",      "endwhile",   "else",     "elseif",
                                           "endif",       "case",       "default",  "endtest"};
constexpr std::string_view kReadingFunctions[] = {"crobt", "cpos", "calcjointt", "calcrobt"};

/// Instructions that move targets while the program runs, wherever these are stated.
constexpr std::string_view kDisplacing[] = {"pdispon", "pdispset", "fcact", "softact",
                                            "setalldataval"};

/// An argument of an instruction: tokens [begin, end), and what stands behind \WObj:= in it.
struct Argument {
  std::size_t begin = 0, end = 0;
  std::size_t wobj = 0;  // token of its name, or another if it is no name; 0: none
};

class RapidReader {
 public:
  RapidReader(Program& program, const Facts& around)
      : program_(program),
        around_(around),
        names_(program),
        tokens_(program.sources[0], 0, {.comments = {"!"}}) {
    tokens_.drop_comments(true);
  }

  void read() {
    program_.tools["tool0"].X = Transformd();
    program_.frames["wobj0"].X = Transformd();
    for (std::size_t i = 0; i < tokens_.size(); ++i) declaration(i);
    for (std::size_t i = 0; i < tokens_.size(); ++i) instruction(i);
    for (std::size_t i = 0; i < tokens_.size(); ++i) fact(i);
    names_.look_elsewhere(around_);
    names_.look_for_mentions(tokens_);
  }

 private:
  /// What counts in all programs.
  void fact(std::size_t i) {
    if (!tokens_.is_word(i)) return;
    if (one_of(kDisplacing, i)) names_.displace(tokens_, i);
    // Behind ConfJ \Off and ConfL \Off the controller goes to the nearest joint positions, whatever
    // a target states.
    if (tokens_.is(i + 1, "\\") && tokens_.is(i + 2, "off")) {
      if (tokens_.is(i, "confj")) program_.facts.joint_configurations = false;
      if (tokens_.is(i, "confl")) program_.facts.linear_configurations = false;
    }
    if (!tokens_.is(i, "setdataval")) return;
    const std::string_view name = tokens_.text(i + 1);
    const bool plain = name.find_first_of("/{\\[") == std::string_view::npos;
    if (plain && name.size() > 2 && name.front() == '"' && name.back() == '"') {
      names_.mention(tokens_, i, lower_case(name.substr(1, name.size() - 2)));
    } else {
      names_.displace(tokens_, i);
      for (Frames* frames : {&program_.tools, &program_.frames})
        (*frames)[kAllFrames] = {
            .X = {},
            .why = fmt::format("SetDataVal in line {} may change it", tokens_.line(i)),
            .moving = true};
    }
  }

  template <std::size_t N>
  bool one_of(const std::string_view (&words)[N], std::size_t i) const {
    return std::any_of(std::begin(words), std::end(words),
                       [&](std::string_view word) { return tokens_.is(i, word); });
  }

  /// "LOCAL PERS tooldata": of this module alone.
  bool local_at(std::size_t i) const {
    return (i > 0 && tokens_.is(i - 1, "local")) || (i > 1 && tokens_.is(i - 2, "local"));
  }

  void declaration(std::size_t i) {
    if (tokens_.is(i, "proc") || tokens_.is(i, "func") || tokens_.is(i, "trap")) inside_ = true;
    if (tokens_.is(i, "endproc") || tokens_.is(i, "endfunc") || tokens_.is(i, "endtrap"))
      inside_ = false;
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
      Frame frame = tool ? tool_of(value) : work_of(value);
      if (inside_) frame = {.X = {}, .why = "a routine has one of its own", .moving = true};
      frame.local = local_at(i);
      names_.declare(tokens_, i + 1, tool ? program_.tools : program_.frames, std::move(frame));
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
    if (value && value->items.size() > 1) out.external_axes = external(value->items.back());
    if (out.written.numbers.empty()) {
      out.why = "it is not stated as plain numbers";
      out.help = "state it as [[x,y,z],[q1,q2,q3,q4],[cf1,cf4,cf6,cfx],[...]]";
    }
    return out;
  }

  /// 9E9 is an axis that there is not.
  static bool external(const Value& axes) {
    constexpr double kNone = 9e9;
    return axes.items.size() != 6 ||
           std::any_of(axes.items.begin(), axes.items.end(), [](const Value& axis) {
             return !axis.number || axis.number->value != kNone;
           });
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
    if (value->items[0].word != "true")
      return {.X = {}, .why = "the tool stands in the cell", .moving = true};
    return {.X = frame_of(value->items[1]), .why = "it is not stated as numbers"};
  }

  static Frame work_of(const std::optional<Value>& value) {
    if (!value || value->items.size() != 5) return {.X = {}, .why = "it is not stated as numbers"};
    if (value->items[0].word != "false")
      return {.X = {}, .why = "the robot holds the work", .moving = true};
    if (value->items[1].word != "true" || value->items[2].word != "\"\"")
      return {.X = {}, .why = "another machine moves the work", .moving = true};
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
      if (now.end > now.begin)
        out.push_back(now);
      else if (now.wobj > 0 && !out.empty())  // ", \WObj:=" as well as "\WObj:="
        out.back().wobj = now.wobj;
      now = {.begin = k + 1, .end = 0};
    };
    for (; !tokens_.ended(i) && !tokens_.is(i, ";"); ++i) {
      if (tokens_.is(i, "[") || tokens_.is(i, "(") || tokens_.is(i, "{")) ++depth;
      if (tokens_.is(i, "]") || tokens_.is(i, ")") || tokens_.is(i, "}")) --depth;
      if (depth != 0) continue;
      if (tokens_.is(i, "\\") && now.end == 0) now.end = i;
      const bool wobj = tokens_.is(i, "\\") && tokens_.is(i + 1, "wobj");
      if (wobj) now.wobj = tokens_.is(i + 2, ":=") ? i + 3 : i;
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

  /// The tool and the work object of a move, whose mention there does no harm.
  void allow_names(const Argument& tool, const std::vector<Argument>& given) {
    names_.allow(tokens_, tool.begin);
    for (const Argument& argument : given)
      if (argument.wobj > 0)  // \WObj:=wTable, or \WObj?wTable
        names_.allow(tokens_, argument.wobj + (tokens_.is_word(argument.wobj) ? 0 : 3));
  }

  /// CRobT(\Tool:=tGun \WObj:=wTable) reads both.
  void reading_function(std::size_t i) {
    int depth = 0;
    for (std::size_t k = i + 1; !tokens_.ended(k); ++k) {
      depth += tokens_.is(k, "(") ? 1 : 0;
      depth -= tokens_.is(k, ")") ? 1 : 0;
      if (depth <= 0) return;
      if (depth == 1 && tokens_.is(k, "\\") && tokens_.is(k + 2, ":=") &&
          (tokens_.is(k + 1, "tool") || tokens_.is(k + 1, "wobj")))
        names_.allow(tokens_, k + 3);
    }
  }

  /// PROC main(), and calls of routines that move.
  void routine(std::size_t i) {
    const bool begins = i > 0 && (tokens_.is(i - 1, "proc") || tokens_.is(i - 1, "trap"));
    if (begins) routine_ = tokens_.lower(i);
    if (begins ? !program_.moves.empty() : around_.moves.contains(tokens_.lower(i))) somewhere();
    if (!routine_.empty() && !begins) program_.facts.calls[routine_].insert(tokens_.lower(i));
  }

  /// From here on the arm may be anywhere: other moves than those of the text before came between.
  void somewhere() { program_.moves.push_back({}); }

  void instruction(std::size_t i) {
    if (tokens_.is(i, "%") || tokens_.is(i, "callbyvar")) somewhere();  // a call of any routine
    if (!tokens_.is_word(i)) return;
    if (one_of(kReadingFunctions, i)) return reading_function(i);
    routine(i);
    if (one_of(kElsewhere, i)) return somewhere();
    const auto* words = std::find_if(std::begin(kRapidMoves), std::end(kRapidMoves),
                                     [&](const MoveWords& w) { return tokens_.is(i, w.name); });
    const bool moves = words != std::end(kRapidMoves);
    if (!moves && !one_of(kReaders, i)) return;
    const auto given = arguments(i + 1);
    if (!routine_.empty()) program_.facts.moves.insert(routine_);
    if (!moves) somewhere();
    if (!moves && given.size() > 2) allow_names(given.back(), given);
    if (!moves || given.size() <= words->tool) return;
    allow_names(given[words->tool], given);
    const bool joint = words->motion == Motion::kJoint;
    Move move{.motion = words->motion,
              .tool = name_at(given[words->tool].begin),
              .frame = "wobj0",
              .line = tokens_.line(i),
              .configured = joint ? around_.joint_configurations : around_.linear_configurations};
    for (const Argument& argument : given)
      if (argument.wobj > 0) move.frame = name_at(argument.wobj);
    for (std::size_t k = 0; k < words->targets; ++k) {
      Move one = move;
      if (k + 1 < words->targets) one.motion = Motion::kVia;
      one.target = goal(given[k], words->name == "moveabsj");
      program_.moves.push_back(one);
      if (tracks(i))
        program_.targets[static_cast<std::size_t>(one.target)].leave(
            fmt::format("line {} moves it with \\Corr", move.line),
            "state the position that is meant, without a correction");
    }
  }

  bool tracks(std::size_t i) const {
    for (; !tokens_.ended(i) && !tokens_.is(i, ";"); ++i)
      if (tokens_.is(i, "\\") && tokens_.is(i + 1, "corr")) return true;
    return false;
  }

  int goal(const Argument& at, bool joints) {
    if (at.end == at.begin + 1 && tokens_.is_word(at.begin)) {
      if (const int known = names_.used(tokens_, at.begin); known >= 0) return known;
      return listed(at, "the program does not state it", "state it in the module of its moves");
    }
    std::size_t k = at.begin;
    if (const auto value = list_at(tokens_, k); value && k == at.end)
      return program_.add_inline(target(value, !joints), 0, tokens_.line(at.begin));
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

  Program& program_;
  const Facts& around_;
  Names names_;
  Tokens tokens_;
  bool inside_ = false;  // a routine, while declarations are read
  std::string routine_;  // the one around
};

}  // namespace

void read_rapid(Program& program, const Facts& around) { RapidReader(program, around).read(); }

/// Behind the line of MODULE, before which no comment needs to be legal.
std::size_t rapid_comment_place(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::string line = lower_case(line_at(bytes, at));
    const std::size_t word = line.find_first_not_of(" \t"), end = at + line.size();
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
