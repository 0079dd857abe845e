// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "programs/current_frame.hpp"
#include "programs/languages.hpp"
#include "programs/names.hpp"
#include "programs/written.hpp"

/// URScript: poses p[x,y,z,rx,ry,rz] in m and rad, in the base frame; joints [q1, ... q6] in rad.
/// The tool is that of set_tcp. The URScript Programming Language, chapters "Module motion" and
/// "Module internals".
namespace plumb::offline::programs {
namespace {

class UrscriptReader {
 public:
  UrscriptReader(Program& program, const Facts& around)
      : program_(program),
        around_(around),
        names_(program),
        tokens_(program.sources[0], 0, {.comments = {"#"}}) {
    tokens_.drop_comments(false);
  }

  void read() {
    program_.frames["base"].X = Transformd();
    for (std::size_t i = 0; i < tokens_.size(); ++i) declaration(i);
    flow_.routine("");
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      structure(i);
      set_tcp(i);
      move(i);
      if (displaces(i)) names_.displace(tokens_, i);
    }
    flow_.report(program_.facts);
    const auto tools = flow_.names(CurrentFrame::What::kTool, around_);
    for (std::size_t m = 0; m < program_.moves.size(); ++m) program_.moves[m].tool = tools[m];
    names_.look_elsewhere(around_);
    names_.look_for_mentions(tokens_);
    for (const auto& [m, near] : near_) begin_near(program_.moves[m], near);
  }

 private:
  /// The numbers of p[...] or [...] at token i, moved behind; the notation says which it was.
  std::optional<Written> literal(std::size_t& i) const {
    const bool pose = tokens_.is(i, "p") && tokens_.is(i + 1, "[");
    std::size_t k = pose ? i + 1 : i;
    const auto value = list_at(tokens_, k);
    if (!value) return std::nullopt;
    Written out{.notation = pose ? Notation::kVector : Notation::kJoints_rad,
                .numbers = numbers_of(*value, 6)};
    if (out.numbers.empty()) return std::nullopt;
    i = k;
    return out;
  }

  void declaration(std::size_t i) {
    if (!tokens_.is_word(i) || !tokens_.is(i + 1, "=") || tokens_.is(i + 2, "=")) return;
    if (!begins(i) && !tokens_.is(i - 1, "global") && !tokens_.is(i - 1, "local")) return;
    std::size_t k = i + 2;
    const auto written = literal(k);
    if (!written || tokens_.at(k).kind == Token::Kind::kSign) return;
    names_.declare(tokens_, i, {.written = *written});
  }

  bool begins(std::size_t i) const {
    return i == 0 || tokens_.at(i - 1).kind == Token::Kind::kLine;
  }

  void structure(std::size_t i) {
    if (!tokens_.is_word(i)) return;
    const bool thread = tokens_.is(i, "thread") || tokens_.is(i, "sec");
    const bool loop = tokens_.is(i, "while") || tokens_.is(i, "for");
    if (tokens_.is(i, "end")) {
      flow_.end();
      somewhere();
    }
    if (begins(i) && (thread || tokens_.is(i, "def"))) {
      if (!program_.moves.empty()) somewhere();
      flow_.routine(tokens_.lower(i + 1), thread);
    }
    const bool branch = tokens_.is(i, "elif") || tokens_.is(i, "else");
    if (begins(i) && (loop || branch)) somewhere();  // reached from several places
    if (begins(i) && (loop || tokens_.is(i, "if"))) flow_.block(loop);
    if (begins(i) && branch) flow_.branch();
    const bool declares = i > 0 && (tokens_.is(i - 1, "def") || tokens_.is(i - 1, "thread") ||
                                    tokens_.is(i - 1, "sec"));
    if (!tokens_.is(i + 1, "(") || declares) return;
    flow_.call(tokens_.lower(i));
    constexpr std::array kOtherMotion{"servoj",         "servoc",     "speedj",       "speedl",
                                      "freedrive_mode", "teach_mode", "movep_follow", "jog"};
    const bool elsewhere = std::any_of(kOtherMotion.begin(), kOtherMotion.end(),
                                       [&](const char* word) { return tokens_.is(i, word); });
    if (elsewhere || around_.moves.contains(tokens_.lower(i))) somewhere();
  }

  /// From here on the arm may be anywhere: other moves than those of the text before came between.
  void somewhere() { push({.frame = "base"}); }

  void set_tcp(std::size_t i) {
    if (!tokens_.is(i, "set_tcp") || !tokens_.is(i + 1, "(")) return;
    std::size_t k = i + 2;
    const auto written = literal(k);
    const bool whole = written && (tokens_.is(k, ")") || tokens_.is(k, ","));
    const auto X = whole ? pose_of(*written) : std::nullopt;
    std::string key = fmt::format("set_tcp of {}:{}", program_.sources[0].file, tokens_.line(i));
    if (X) key = "set_tcp(" + tokens_.whole(i + 2, k) + ")";
    program_.tools[key] = {.X = X, .why = X ? "" : "its numbers are computed"};
    flow_.set(CurrentFrame::What::kTool, key);
  }

  /// What moves the targets of all moves while it is switched on.
  bool displaces(std::size_t i) const {
    const std::string word = tokens_.is_word(i) ? tokens_.lower(i) : "";
    return word.rfind("track_conveyor_", 0) == 0 || word.rfind("path_offset_", 0) == 0 ||
           word == "force_mode" || word == "screw_driving";
  }

  void move(std::size_t i) {
    const bool circle = tokens_.is(i, "movec");
    const bool joint = tokens_.is(i, "movej");
    if (!circle && !joint && !tokens_.is(i, "movel") && !tokens_.is(i, "movep")) return;
    if (!tokens_.is(i + 1, "(")) return;
    std::size_t k = i + 2;
    Move move{.motion = joint ? Motion::kJoint : Motion::kLinear,
              .frame = "base",
              .line = tokens_.line(i)};
    if (circle) move.motion = Motion::kVia;
    goal(k, move);
    push(move);
    if (!circle || !tokens_.is(k, ",")) return;
    ++k;
    move.motion = Motion::kCircleEnd;
    goal(k, move);
    push(move);
  }

  void push(const Move& move) {
    flow_.move();
    program_.moves.push_back(move);
  }

  bool ends(std::size_t k) const { return tokens_.is(k, ",") || tokens_.is(k, ")"); }

  /// The goal at token k, moved behind it.
  void goal(std::size_t& k, Move& move) {
    const std::size_t begin = k;
    if (auto written = literal(k); written && ends(k)) {
      move.target = inline_target(begin, *written);
      return;
    }
    k = begin;
    if (tokens_.is_word(k) && ends(k + 1) && (move.target = names_.used(tokens_, k)) >= 0) {
      ++k;
      return;
    }
    if (inverse_of(k, move)) return;
    int depth = 0;
    for (k = begin; !tokens_.ended(k) && tokens_.at(k).kind != Token::Kind::kLine; ++k) {
      if (depth == 0 && ends(k)) break;
      if (tokens_.is(k, "(") || tokens_.is(k, "[")) ++depth;
      if (tokens_.is(k, ")") || tokens_.is(k, "]")) --depth;
    }
    move.target =
        program_.list(tokens_.quoted(begin, k), 0, tokens_.line(begin),
                      "it is computed while the program runs", "state it as p[...] of its own");
  }

  /// get_inverse_kin(P, qnear=Q), as the teach pendant writes it: a move to P, with its joints near
  /// Q.
  bool inverse_of(std::size_t& k, Move& move) {
    if (!tokens_.is(k, "get_inverse_kin") || !tokens_.is(k + 1, "(")) return false;
    const std::size_t begin = k + 2;
    std::size_t next = begin;
    const auto stated = literal(next);
    if (!stated) next = begin + 1;
    std::size_t near = 0;
    std::optional<Written> joints;
    if (tokens_.is(next, ",") && tokens_.is(next + 1, "qnear") && tokens_.is(next + 2, "=")) {
      near = next + 3;
      next = near;
      joints = literal(next);
      if (!joints) next = near + 1;
    }
    if (!tokens_.is(next, ")") || !ends(next + 1)) return false;
    if (stated && stated->notation == Notation::kVector) {
      move.target = inline_target(begin, *stated);
    } else {
      move.target = tokens_.is_word(begin) ? names_.used(tokens_, begin) : -1;
    }
    if (move.target < 0) return false;
    if (joints) {
      for (const Number& q : joints->numbers)
        move.joints_deg.push_back(q.value * 180.0 / std::numbers::pi);
    } else if (near > 0) {
      near_.emplace_back(program_.moves.size(), names_.used(tokens_, near));
    }
    k = next + 1;
    return true;
  }

  int inline_target(std::size_t i, const Written& written) {
    return program_.add_inline({.written = written}, 0, tokens_.line(i));
  }

  /// The joints that qnear names, if they are known and nothing changes them.
  void begin_near(Move& move, int joints) {
    const Target* near = joints < 0 ? nullptr : &program_.targets[static_cast<std::size_t>(joints)];
    if (near != nullptr && near->why.empty() && near->written.notation == Notation::kJoints_rad) {
      for (const Number& q : near->written.numbers)
        move.joints_deg.push_back(q.value * 180.0 / std::numbers::pi);
      return;
    }
    program_.targets[static_cast<std::size_t>(move.target)].leave(
        fmt::format("line {} takes its joints near others that are not known", move.line),
        "state the joints of qnear as [...] of their own, which nothing changes");
  }

  Program& program_;
  const Facts& around_;
  Names names_;
  Tokens tokens_;
  CurrentFrame flow_;
  std::vector<std::pair<std::size_t, int>> near_;  // moves, and the joints of their qnear
};

}  // namespace

void read_urscript(Program& program, const Facts& around) {
  UrscriptReader(program, around).read();
}

std::size_t urscript_comment_place(std::string_view) { return 0; }

}  // namespace plumb::offline::programs
