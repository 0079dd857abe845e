// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "programs/languages.hpp"
#include "programs/names.hpp"

/// Fanuc LS, the text form of a teach pendant program: statements behind /MN, positions behind
/// /POS: P[1]{ GP1: UF : 1, UT : 1, CONFIG : 'N U T, 0, 0, 0', X = 1.0 mm, ... W = 0.0 deg, ... };
/// the user frames and tools themselves are not in the file. FANUC Robot series, operator's manual.
namespace plumb::offline::programs {
namespace {

constexpr std::array kPose{"x", "y", "z", "w", "p", "r"};

class FanucReader {
 public:
  FanucReader(Program& program, const Facts& around)
      : program_(program),
        around_(around),
        tokens_(
            program.sources[0], 0,
            {.comments = {"!", "//", "--"}, .quote = '\'', .only_first = true, .labels = true}) {
    tokens_.drop_comments(false);
  }

  void read() {
    program_.tools["0"].X = Transformd();
    program_.frames["0"].X = Transformd();
    if (tokens_.is(0, "/") && tokens_.is(1, "prog")) name_ = tokens_.lower(2);
    attributes();
    std::size_t begin = section("mn"), positions = section("pos");
    for (std::size_t i = positions; i < tokens_.size(); ++i)
      if (line_begins(i) && is_position(i) && tokens_.is(i + 4, "{")) position(i);
    if (begin == tokens_.size()) return;
    std::size_t from = begin;
    for (std::size_t i = begin; i <= positions; ++i) {
      if (i < positions && !tokens_.is(i, ";")) continue;
      statement(from, std::min(i, tokens_.size()));
      from = i + 1;
    }
    if (!program_.moves.empty()) program_.facts.moves.insert(name_);
    for (Target& target : program_.targets)
      spoil(target, own_, "state them in a program that does not follow a line");
    Names(program_).look_elsewhere(around_);
  }

 private:
  /// A program that follows a line: "LINE_TRACK_SCHEDULE_NUMBER : 1;".
  void attributes() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      std::size_t k = i + 2;
      if (!tokens_.is(i, "line_track_schedule_number") || !tokens_.is(i + 1, ":")) continue;
      if (const auto number = tokens_.number(k); !number || number->value != 0.0)
        own_ = fmt::format("line {} moves all targets with a conveyor", tokens_.line(i));
    }
  }

  bool line_begins(std::size_t i) const {
    return i == 0 || tokens_.at(i - 1).kind == Token::Kind::kLine;
  }

  /// The first token behind "/MN"; the number of tokens if there is none.
  std::size_t section(std::string_view name) const {
    for (std::size_t i = 0; i + 1 < tokens_.size(); ++i)
      if (line_begins(i) && tokens_.is(i, "/") && tokens_.is(i + 1, name)) return i + 2;
    return tokens_.size();
  }

  bool is_position(std::size_t i) const {
    return tokens_.is(i, "p") && tokens_.is(i + 1, "[") &&
           tokens_.at(i + 2).kind == Token::Kind::kNumber && tokens_.is(i + 3, "]");
  }

  std::string after_colon(std::size_t i) const {
    const bool number = tokens_.at(i + 2).kind == Token::Kind::kNumber;
    return tokens_.is(i + 1, ":") && number ? std::string(tokens_.text(i + 2)) : "default";
  }

  void position(std::size_t i) {
    Target target{.name = "P[" + std::string(tokens_.text(i + 2)) + "]",
                  .line = tokens_.line(i),
                  .tool = "default",
                  .frame = "default"};
    std::map<std::string, Number> found;
    std::size_t k = i + 5;
    for (; !tokens_.ended(k) && !tokens_.is(k, "}"); ++k) {
      if (tokens_.is(k, "gp2") && tokens_.is(k + 1, ":")) break;
      if (tokens_.is(k, "uf")) target.frame = after_colon(k);
      if (tokens_.is(k, "ut")) target.tool = after_colon(k);
      if (tokens_.is(k, "config") && tokens_.is(k + 1, ":"))
        target.configuration = configuration(tokens_.lower(k + 2));
      std::size_t n = k + 2;
      if (!tokens_.is_word(k) || !tokens_.is(k + 1, "=")) continue;
      if (const auto number = tokens_.number(n)) found.emplace(tokens_.lower(k), *number);
    }
    fill(target, found);
    for (int axis = 1; axis <= 9; ++axis)
      target.external_axes = target.external_axes || found.contains(fmt::format("e{}", axis));
    const auto index = static_cast<int>(program_.targets.size());
    if (!index_.emplace(tokens_.text(i + 2), index).second) {
      target.why = "the program states it more than once";
      target.help = "give every position a number of its own";
      spoil(index_[std::string(tokens_.text(i + 2))], target.why, target.help);
    }
    program_.targets.push_back(target);
  }

  static void fill(Target& target, const std::map<std::string, Number>& found) {
    Written& written = target.written;
    written.notation = Notation::kXyz;
    for (const char* const name : kPose)
      if (const auto at = found.find(name); at != found.end())
        written.numbers.push_back(at->second);
    if (written.numbers.size() == kPose.size()) return;
    written = {.notation = Notation::kJoints_deg, .numbers = {}};
    for (int joint = 1; joint <= 9; ++joint)
      if (const auto at = found.find(fmt::format("j{}", joint)); at != found.end())
        written.numbers.push_back(at->second);
    if (!written.numbers.empty()) return;
    target.why = "it is not taught: its numbers are missing";
    target.help = "teach it on the controller, and take the file anew";
  }

  /// 'N U T, 0, 0, 0': U with the elbow above, T with the wrist in front of axis 1. What N and F
  /// and the three turns say of which axis is not read: no public source says it for sure.
  static Configuration configuration(const std::string& text) {
    Configuration out;
    for (const char c : text.substr(0, text.find(','))) {
      if (c == 't' || c == 'b') out.front = c == 't';
      if (c == 'u' || c == 'd') out.elbow_front = c == 'u';
      if (c == 'n' || c == 'f') out.side = c;
    }
    return out;
  }

  void spoil(int index, const std::string& why, const std::string& help) {
    spoil(program_.targets[static_cast<std::size_t>(index)], why, help);
  }

  static void spoil(Target& target, const std::string& why, const std::string& help) {
    if (!why.empty()) target.leave(why, help);
  }

  /// Tokens [from, to): "12 : L P[1] 100 mm / sec FINE", on one or several lines.
  void statement(std::size_t from, std::size_t to) {
    std::size_t i = from;
    while (i < to && !tokens_.is_word(i)) ++i;
    const bool joint = tokens_.is(i, "j"), line = tokens_.is(i, "l");
    const bool circle = tokens_.is(i, "c") || tokens_.is(i, "a");
    const bool goes = joint || line || circle;
    if (!goes || !(tokens_.is(i + 1, "p") || tokens_.is(i + 1, "pr"))) return other(i, to);
    Move move{.motion = joint ? Motion::kJoint : Motion::kLinear,
              .line = tokens_.line(i),
              .configured = true};
    if (circle) move.motion = tokens_.is(i, "c") ? Motion::kVia : Motion::kCircleEnd;
    bool first = true;
    for (std::size_t k = i + 1; k < to; ++k) {
      if (!tokens_.is(k + 1, "[") || !(tokens_.is(k, "p") || tokens_.is(k, "pr"))) continue;
      if (!first && (tokens_.is(k - 1, ",") || move.motion != Motion::kVia)) continue;
      if (!first) move.motion = Motion::kCircleEnd;
      move.target = goal(k, move.line);
      program_.moves.push_back(move);
      if (const auto* word = changed_by(i, to); word != nullptr && move.target >= 0)
        spoil(move.target, fmt::format("line {} moves it with {}", move.line, word),
              "state the position that is meant, without an offset");
      first = false;
    }
  }

  const char* changed_by(std::size_t from, std::size_t to) const {
    constexpr std::array kWords{"offset", "tool_offset",   "voffset",      "inc",
                                "rtcp",   "sensor_offset", "touch_offset", "track",
                                "coord",  "mrot",          "wjnt"};
    for (std::size_t k = from; k < to; ++k)
      for (const char* const word : kWords)
        if (tokens_.is(k, word)) return word;
    return nullptr;
  }

  int goal(std::size_t i, int line) {
    const bool number = is_position(i);
    if (number)
      if (const auto at = index_.find(std::string(tokens_.text(i + 2))); at != index_.end())
        return at->second;
    std::size_t end = i + 2;
    while (!tokens_.ended(end) && !tokens_.is(end, "]") &&
           tokens_.at(end).kind != Token::Kind::kLine)
      ++end;
    if (tokens_.is(end + 1, "]")) ++end;  // P[R[5]]
    return program_.list(tokens_.quoted(i, end + 1), 0, line,
                         number ? "the program does not state it" : "it is read from a register",
                         "state it as a position of the program");
  }

  /// CALL of a program that moves: from there on the arm may be anywhere.
  void call(std::size_t from, std::size_t to) {
    for (std::size_t k = from; k + 1 < to; ++k) {
      if (!tokens_.is(k, "call") && !tokens_.is(k, "run")) continue;
      program_.facts.calls[name_].insert(tokens_.lower(k + 1));
      const bool any = tokens_.is(k + 2, "[");  // CALL SR[1]
      if (any || around_.moves.contains(tokens_.lower(k + 1))) program_.moves.push_back({});
    }
  }

  /// A statement that is no move: what it does to positions and frames.
  void other(std::size_t from, std::size_t to) {
    call(from, to);
    for (const auto* word : {"lbl", "else", "endif", "for", "endfor", "select", "jmp"})
      if (tokens_.is(from, word)) program_.moves.push_back({});  // reached from several places
    for (std::size_t k = from; k < to; ++k) {
      if (tokens_.is(k, "p") && tokens_.is(k + 1, "[") && !is_position(k))  // P[R[1]]=LPOS
        for (Target& target : program_.targets)
          spoil(target,
                fmt::format("line {} uses a position whose number is computed", tokens_.line(k)),
                "name positions by their numbers there");
      if (is_position(k))
        if (const auto at = index_.find(std::string(tokens_.text(k + 2))); at != index_.end())
          spoil(
              at->second,
              fmt::format("line {} uses it for something else than a move to it", tokens_.line(k)),
              "give the moves a position that nothing else reads or changes");
      changed_frame(k, to);
    }
    displacement(from, to);
  }

  /// "UTOOL[2]=PR[9]", or of a register's number "UTOOL[R[1]]=PR[9]".
  void changed_frame(std::size_t k, std::size_t to) {
    const bool tool = tokens_.is(k, "utool") || tokens_.is(k, "$mnutool");
    const bool frame = tokens_.is(k, "uframe") || tokens_.is(k, "$mnuframe");
    if (!(tool || frame) || !tokens_.is(k + 1, "[")) return;
    const bool number = tokens_.at(k + 2).kind == Token::Kind::kNumber && tokens_.is(k + 3, "]");
    bool set = false;
    for (std::size_t i = k + 1; i < to; ++i) set = set || tokens_.is(i, "=");
    if (!set) return;
    const std::string name = number ? std::string(tokens_.text(k + 2)) : kAllFrames;
    (tool ? program_.tools : program_.frames)[name] = {
        .X = {},
        .why = fmt::format("line {} changes it while the program runs", tokens_.line(k)),
        .moving = true};
  }

  /// Statements that move the targets of the moves behind them: of this program, or also of those
  /// that it calls.
  void displacement(std::size_t from, std::size_t to) {
    std::size_t i = from;
    while (i < to && !tokens_.is_word(i)) ++i;
    const bool ends = tokens_.is(i + 1, "end");
    const auto next = [&](const char* word) {
      for (std::size_t k = i + 1; k < to; ++k)
        if (tokens_.is(k, word)) return true;
      return false;
    };
    const bool touch = tokens_.is(i, "touch") && tokens_.is(i + 1, "offset");
    const bool passes = tokens_.is(i, "mp") && tokens_.is(i + 1, "offset");
    const bool conditions = (tokens_.is(i, "offset") || tokens_.is(i, "tool_offset") ||
                             tokens_.is(i, "voffset") || tokens_.is(i, "tool")) &&
                            next("condition");
    if (touch || passes || conditions || (tokens_.is(i, "track") && !ends) ||
        tokens_.is(i, "softfloat"))
      Names(program_).displace(tokens_, i);
  }

  Program& program_;
  const Facts& around_;
  Tokens tokens_;
  std::map<std::string, int, std::less<>> index_;
  std::string name_;  // of the program
  std::string own_;   // why no target of this program may be touched, or empty
};

}  // namespace

void read_fanuc(Program& program, const Facts& around) { FanucReader(program, around).read(); }

/// Behind the line "/MN".
std::size_t fanuc_comment_place(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::string line = lower_case(line_at(bytes, at));
    at += line.size();
    if (line.substr(0, 3) == "/mn") return at;
  }
  return 0;
}

}  // namespace plumb::offline::programs
