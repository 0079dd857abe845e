// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

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
  explicit UrscriptReader(Program& program)
      : program_(program), names_(program), tokens_(program.sources[0], 0, {.comments = {"#"}}) {
    tokens_.drop_comments(false);
  }

  void read() {
    program_.frames["base"].X = Transformd();
    for (std::size_t i = 0; i < tokens_.size(); ++i) declaration(i);
    CurrentFrame scan("default");
    int depth = 0;
    for (std::size_t i = 0; i < tokens_.size(); ++i) tool_statement(i, depth, scan);
    scan.decide();
    depth = 0;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      tool_statement(i, depth, scan);
      move(i, scan.name());
    }
    names_.look_for_mentions(tokens_);
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
    const bool begins = i == 0 || tokens_.at(i - 1).kind == Token::Kind::kLine ||
                        tokens_.is(i - 1, "global") || tokens_.is(i - 1, "local");
    if (!begins) return;
    std::size_t k = i + 2;
    const auto written = literal(k);
    if (!written || tokens_.at(k).kind == Token::Kind::kSign) return;
    names_.declare(tokens_, i, {.written = *written});
  }

  void tool_statement(std::size_t i, int& depth, CurrentFrame& tool) {
    for (const auto* word : {"def", "thread", "sec", "if", "while", "for"})
      if (tokens_.is(i, word) && (i == 0 || tokens_.at(i - 1).kind == Token::Kind::kLine)) {
        if (depth++ == 0) tool.begin();
      }
    if (tokens_.is(i, "end") && depth > 0) --depth;
    if (!tokens_.is(i, "set_tcp") || !tokens_.is(i + 1, "(")) return;
    std::size_t k = i + 2;
    const auto written = literal(k);
    const bool whole = written && (tokens_.is(k, ")") || tokens_.is(k, ","));
    const auto X = whole ? pose_of(*written) : std::nullopt;
    std::string key = fmt::format("set_tcp of line {}", tokens_.line(i));
    if (X) key = "set_tcp(" + tokens_.quoted(i + 2, k) + ")";
    program_.tools[key] = {.X = X, .why = X ? "" : "its numbers are computed"};
    tool.set(key, depth > 1);
  }

  void move(std::size_t i, const std::string& tool) {
    const bool circle = tokens_.is(i, "movec");
    const bool joint = tokens_.is(i, "movej");
    if (!circle && !joint && !tokens_.is(i, "movel") && !tokens_.is(i, "movep")) return;
    if (!tokens_.is(i + 1, "(")) return;
    std::size_t k = i + 2;
    Move move{.motion = joint ? Motion::kJoint : Motion::kLinear,
              .tool = tool,
              .frame = "base",
              .line = tokens_.line(i)};
    if (circle) move.motion = Motion::kVia;
    goal(k, move);
    program_.moves.push_back(move);
    if (!circle || !tokens_.is(k, ",")) return;
    ++k;
    move.motion = Motion::kCircleEnd;
    move.joints_deg.clear();
    goal(k, move);
    program_.moves.push_back(move);
  }

  bool ends(std::size_t k) const { return tokens_.is(k, ",") || tokens_.is(k, ")"); }

  /// The goal at token k, moved behind it.
  void goal(std::size_t& k, Move& move) {
    const std::size_t begin = k;
    if (auto written = literal(k); written && ends(k)) {
      move.target = static_cast<int>(program_.targets.size());
      program_.targets.push_back(
          {.name = "target of the move", .line = tokens_.line(begin), .written = *written});
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
    if (!tokens_.is(k, "get_inverse_kin") || !tokens_.is(k + 1, "(") || !tokens_.is_word(k + 2))
      return false;
    std::size_t next = k + 3;
    std::size_t near = 0;
    if (tokens_.is(next, ",") && tokens_.is(next + 1, "qnear") && tokens_.is(next + 2, "=")) {
      near = next + 3;
      next = near + 1;
    }
    if (!tokens_.is(next, ")") || !ends(next + 1)) return false;
    const int target = names_.used(tokens_, k + 2);
    if (target < 0) return false;
    move.target = target;
    const int joints = near > 0 ? names_.used(tokens_, near) : -1;
    if (joints >= 0)
      for (const Number& q : program_.targets[static_cast<std::size_t>(joints)].written.numbers)
        move.joints_deg.push_back(q.value * 180.0 / 3.14159265358979323846);
    k = next + 1;
    return true;
  }

  Program& program_;
  Names names_;
  Tokens tokens_;
};

}  // namespace

void read_urscript(Program& program) { UrscriptReader(program).read(); }

std::size_t urscript_comment_place(std::string_view) { return 0; }

}  // namespace plumb::offline::programs
