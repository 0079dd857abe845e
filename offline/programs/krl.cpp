// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <tuple>

#include "programs/current_frame.hpp"
#include "programs/languages.hpp"
#include "programs/names.hpp"
#include "programs/written.hpp"

/// KRL of KUKA: aggregates {X 1,Y 2,Z 3,A 0,B 90,C 0,S 2,T 35,E1 0}, declared in the .dat file or
/// standing in the move; tools and bases by $TOOL, $BASE, BAS(#TOOL,n) or the record FDAT_ACT of an
/// inline form. KUKA System Software, Operating and Programming Instructions.
namespace plumb::offline::programs {
namespace {

constexpr std::array kPoseParts{"x", "y", "z", "a", "b", "c"};
constexpr std::array kAxisParts{"a1", "a2", "a3", "a4", "a5", "a6"};

const std::string kInCell = "(the tool stands in the cell)";

/// The numbers of an aggregate by their names; empty if anything in it is computed.
using Aggregate = std::map<std::string, Number>;

class KrlReader {
 public:
  KrlReader(Program& program, const Facts& around)
      : program_(program), around_(around), names_(program) {
    for (std::size_t s = 0; s < program.sources.size(); ++s)
      files_.emplace_back(program.sources[s], s, Lexis{.comments = {";", "&"}});
  }

  void read() {
    for (Frames* frames : {&program_.tools, &program_.frames}) (*frames)["0"].X = Transformd();
    for (Tokens& file : files_) {
      comments_.push_back(file);
      file.drop_comments(false);
      for (std::size_t i = 0; i < file.size(); ++i) declaration(file, i);
    }
    for (const Tokens& file : files_) walk(file);
    flow_.report(program_.facts);
    const auto tools = flow_.names(CurrentFrame::What::kTool, around_);
    const auto bases = flow_.names(CurrentFrame::What::kFrame, around_);
    for (std::size_t m = 0; m < program_.moves.size(); ++m) {
      Move& move = program_.moves[m];
      if (move.tool.empty()) move.tool = tools[m];
      if (in_cell_) move.tool = kInCell;  // statements that name a tool leave $IPO_MODE as it is
      if (move.frame.empty()) move.frame = bases[m];
    }
    names_.look_elsewhere(around_);
    for (const Tokens& file : files_) names_.look_for_mentions(file);
    copies();
    shared_copies();
  }

 private:
  static bool begins(const Tokens& t, std::size_t i) {
    return i == 0 || t.at(i - 1).kind == Token::Kind::kLine;
  }
  static bool ends(const Tokens& t, std::size_t i) {
    return t.ended(i) || t.at(i).kind == Token::Kind::kLine;
  }

  static bool external(const std::string& part) {
    return part.size() == 2 && part[0] == 'e' && part[1] >= '1' && part[1] <= '6';
  }

  /// {X 1, Y 2} or {E6POS: X 1, Y 2} at token i, moved behind; other words as values are left out.
  static std::optional<Aggregate> aggregate(const Tokens& t, std::size_t& i) {
    std::size_t k = i;
    if (!t.is(k, "{")) return std::nullopt;
    if (t.is_word(k + 1) && t.is(k + 2, ":")) k += 2;
    Aggregate out;
    do {
      if (!t.is_word(k + 1)) return std::nullopt;
      const std::string name = t.lower(k + 1);
      k += 2;
      if (t.is(k, "[") && t.is(k + 1, "]")) k += 2;
      if (const auto bits = binary(t, k)) {
        out[name].value = *bits;
      } else if (t.is(k, "#") && t.is_word(k + 1)) {
        if (t.is(k + 1, "tcp")) out["#tcp"] = {};
        k += 2;
      } else if (t.is_word(k) || t.at(k).kind == Token::Kind::kText) {
        if (external(name)) out[name].value = 1.0;  // wherever it is
        ++k;  // left out, so that a position with such a part is not whole
      } else {
        const auto number = t.number(k);
        if (!number || !out.emplace(name, *number).second) return std::nullopt;
      }
    } while (t.is(k, ","));
    if (!t.is(k, "}")) return std::nullopt;
    i = k + 1;
    return out;
  }

  /// 'B010010' at token k, moved behind: how S and T are also written.
  static std::optional<double> binary(const Tokens& t, std::size_t& k) {
    if (!t.is(k, "'") || !t.is_word(k + 1) || !t.is(k + 2, "'")) return std::nullopt;
    const std::string word = t.lower(k + 1);
    double out = 0.0;
    for (const char c : word.substr(1)) out = 2.0 * out + (c == '1' ? 1.0 : 0.0);
    if (word[0] != 'b' || word.find_first_not_of("01", 1) != std::string::npos) return std::nullopt;
    k += 3;
    return out;
  }

  static std::vector<Number> parts(const Aggregate& from, const std::array<const char*, 6>& names) {
    std::vector<Number> out;
    for (const char* const name : names)
      if (const auto at = from.find(name); at != from.end()) out.push_back(at->second);
    if (out.size() != names.size()) out.clear();
    return out;
  }

  static Target target(const std::optional<Aggregate>& from) {
    Target out;
    if (from) {
      if (auto pose = parts(*from, kPoseParts); !pose.empty()) {
        out.written = {.notation = Notation::kZyx, .numbers = std::move(pose)};
        out.configuration = configuration(*from);
      } else if (auto axes = parts(*from, kAxisParts); !axes.empty()) {
        out.written = {.notation = Notation::kJoints_deg, .numbers = std::move(axes)};
      }
      for (const auto& [part, number] : *from)
        out.external_axes = out.external_axes || (external(part) && number.value != 0.0);
    }
    if (out.written.numbers.empty()) {
      out.why = "it is not stated whole as plain numbers";
      out.help = "state it as {X ...,Y ...,Z ...,A ...,B ...,C ...,S ...,T ...}";
    }
    return out;
  }

  /// T: bit i is set where axis i + 1 is negative. S: 1 with the wrist behind axis 1, 2 with it in
  /// front of the lower arm; its third bit says of axis 5 what T says.
  static Configuration configuration(const Aggregate& from) {
    Configuration out;
    const auto whole = [&](const char* name, int most) {
      const auto at = from.find(name);
      const double value = at == from.end() ? -1.0 : at->second.value;
      return value >= 0.0 && value <= most ? static_cast<int>(value) : -1;
    };
    if (const int turn = whole("t", 63); turn >= 0)
      for (int axis = 0; axis < 6; ++axis) {
        const bool negative = (turn >> axis & 1) != 0;
        out.ranges.push_back({axis, negative ? -720.0 : 0.0, negative ? 0.0 : 720.0});
      }
    if (const int status = whole("s", 31); status >= 0) {
      out.front = (status & 1) == 0;
      out.elbow_front = (status & 2) != 0;
    }
    return out;
  }

  static Frame frame_of(const std::optional<Aggregate>& from) {
    if (!from) return {.X = {}, .why = "it is computed"};
    const auto X = pose_of({.notation = Notation::kZyx, .numbers = parts(*from, kPoseParts)});
    return {.X = X, .why = X ? "" : "it is not stated whole"};
  }

  static std::string number_name(const Aggregate& from, const char* name) {
    if (from.contains("#tcp")) return kInCell;
    const auto at = from.find(name);
    return at == from.end() ? "default" : fmt::format("{:.0f}", at->second.value);
  }

  void declaration(const Tokens& t, std::size_t i) {
    if (!t.is_word(i)) return;
    const bool pose = t.is(i, "e6pos") || t.is(i, "pos") || t.is(i, "frame");
    const bool axes = t.is(i, "e6axis") || t.is(i, "axis");
    std::size_t k = i + 3;
    if ((pose || axes) && t.is_word(i + 1) && t.is(i + 2, "=")) {
      const auto value = aggregate(t, k);
      names_.declare(t, i + 1, target(ends(t, k) ? value : std::nullopt));
    } else if (t.is(i, "fdat") && t.is_word(i + 1) && t.is(i + 2, "=")) {
      const auto value = aggregate(t, k);
      const bool changes = around_.assigned.contains(t.lower(i + 1)) || !ends(t, k);
      if (value && !changes) fdat_[t.lower(i + 1)] = *value;
    } else if (t.is(i, "tool_data") || t.is(i, "base_data")) {
      array_element(t, i);
    }
  }

  /// TOOL_DATA[1]={...} says where a tool is, before all moves; "$TOOL=TOOL_DATA[1]" reads it. What
  /// else is done with one may change it.
  void array_element(const Tokens& t, std::size_t i) {
    Frames& frames = t.is(i, "tool_data") ? program_.tools : program_.frames;
    const bool reads = t.is(i - 1, "=") && (t.is(i - 2, "$tool") || t.is(i - 2, "$base"));
    if (i > 1 && reads) return;
    if (i > 0 && t.is(i - 1, "frame")) return;  // the declaration of the array
    const bool number = t.at(i + 2).kind == Token::Kind::kNumber && t.is(i + 3, "]");
    const std::string name = number ? std::string(t.text(i + 2)) : kAllFrames;
    Frame frame{.X = {},
                .why = fmt::format("line {} may change it while the program runs", t.line(i)),
                .moving = true};
    std::size_t k = i + 5;
    if (number && begins(t, i) && t.is(i + 4, "=") && first_step(t) > i) {
      const auto value = aggregate(t, k);
      frame = frame_of(ends(t, k) ? value : std::nullopt);
    }
    const auto [at, is_new] = frames.emplace(name, frame);
    if (is_new || at->second.moving) return;
    at->second = {.X = {}, .why = "it is set more than once", .moving = true};
  }

  /// The first token of a file that goes somewhere, or to another place of the text.
  std::size_t first_step(const Tokens& t) {
    const auto at = first_steps_.find(t.source());
    if (at != first_steps_.end()) return at->second;
    std::size_t i = 0;
    bool found = false;
    for (; i < t.size() && !found; ++i) {
      const std::string word = begins(t, i) ? t.lower(i) : "";
      for (const auto* step :
           {"ptp", "lin", "circ", "sptp", "slin", "scirc", "spline", "if", "for", "while", "loop",
            "repeat", "switch", "goto", "$tool", "$base", "fdat_act", "end"})
        found = found || word == step;
      found = found || (word == "bas" && (t.is(i + 3, "tool") || t.is(i + 3, "base")));
    }
    return first_steps_[t.source()] = i;
  }

  /// The order of the text: what tool and base are set, and the moves.
  void walk(const Tokens& t) {
    flow_.routine("");
    spline_ = false;
    for (std::size_t i = 0; i < t.size(); ++i) {
      structure(t, i);
      setting(t, i);
      assignment(t, i);
      move(t, i);
    }
    flow_.end_routine();
    flow_.end_routine();  // one without END
  }

  void structure(const Tokens& t, std::size_t i) {
    if (!t.is_word(i)) return;
    const auto one_of = [&](std::initializer_list<const char*> words) {
      return std::any_of(words.begin(), words.end(), [&](const char* w) { return t.is(i, w); });
    };
    const bool defines = i > 0 && (one_of_defs(t, i - 1) || one_of_defs(t, i - 2));
    if (t.is(i + 1, "(") && !defines) {
      flow_.call(t.lower(i), any_time(t, i));
      if (around_.moves.contains(t.lower(i))) somewhere();
    }
    // Sensors and technology packages that shift the targets of all moves.
    if (one_of({"rsi_movecorr", "rsi_on", "vectormoveon"})) names_.displace(t, i);
    const bool global = i > 0 && t.is(i - 1, "global");
    if (!begins(t, i) && !global) return;
    if (one_of_defs(t, i)) begin_routine(t, i);
    if (one_of({"end", "endfct"})) {
      flow_.end_routine();
      if (!program_.moves.empty()) somewhere();
    }
    const bool loop = one_of({"for", "while", "loop", "repeat"});
    const bool branch = one_of({"else", "case", "default"});
    const bool end = one_of({"endif", "endfor", "endwhile", "endloop", "until", "endswitch"});
    const bool label = t.is(i + 1, ":") && ends(t, i + 2);
    if (loop || one_of({"if", "switch"})) flow_.block(loop);
    if (branch) flow_.branch();
    if (end) flow_.end_block();
    // Reached from several places, or moved to where the text does not say.
    if (loop || branch || end || label || one_of({"spl", "sspl"})) somewhere();
    if (one_of({"goto"})) flow_.jump();
    if (label) flow_.label();
    if (one_of({"spline", "ptp_spline"})) spline_ = !ends(t, i + 1);
    if (one_of({"endspline"})) spline_ = false;
    if (one_of({"$robroot"})) names_.displace(t, i);
  }

  /// DEF name(...), DEFFCT INT name(...)
  void begin_routine(const Tokens& t, std::size_t i) {
    std::size_t open = i + 1;
    while (!ends(t, open) && !t.is(open, "(")) ++open;
    if (!program_.moves.empty()) somewhere();
    flow_.routine(t.lower(open - 1));
  }

  /// From here on the arm may be anywhere: other moves than those of the text before came between.
  void somewhere() { push({.tool = "default", .frame = "default"}); }

  static bool one_of_defs(const Tokens& t, std::size_t i) {
    return t.is(i, "def") || t.is(i, "deffct");
  }

  /// Called by an interrupt or along a path.
  static bool any_time(const Tokens& t, std::size_t i) {
    while (!begins(t, i)) --i;
    return t.is(i, "interrupt") || t.is(i, "trigger") ||
           (t.is(i, "global") && t.is(i + 1, "interrupt"));
  }

  void set_both(const std::string& name) {
    flow_.set(CurrentFrame::What::kTool, name);
    flow_.set(CurrentFrame::What::kFrame, name);
  }

  /// "FP1.TOOL_NO=2", "FP1=FP2", CALC(FP1): such a record does not say what its declaration says.
  void assignment(const Tokens& t, std::size_t i) {
    if (!t.is_word(i)) return;
    const bool field = t.is(i + 1, ".") && t.is(i + 3, "=");
    const bool argument =
        i > 1 &&
        (t.is(i - 1, ",") || (t.is(i - 1, "(") && t.is_word(i - 2) && !reads_record(t, i - 2)));
    if ((begins(t, i) && (field || t.is(i + 1, "="))) || argument)
      program_.facts.assigned.insert(t.lower(i));
  }

  /// "$IPO_MODE=#BASE", or that of a record whose tool says where it stands.
  static bool arm_has_tool(const Tokens& t, std::size_t i) {
    return (t.is(i + 2, "#") && t.is(i + 3, "base")) || t.is(i + 2, "sipo_mode");
  }

  static bool reads_record(const Tokens& t, std::size_t i) {
    return t.is(i, "stool2") || t.is(i, "stool") || t.is(i, "sbase") || t.is(i, "sload") ||
           t.is(i, "sipo_mode");
  }

  void setting(const Tokens& t, std::size_t i) {
    using What = CurrentFrame::What;
    if (t.is(i, "bas") && t.is(i + 1, "(") && t.is(i + 2, "#")) {
      const bool number = t.at(i + 5).kind == Token::Kind::kNumber && t.is(i + 6, ")");
      const std::string name = number ? std::string(t.text(i + 5)) : "(computed)";
      if (t.is(i + 3, "tool")) flow_.set(What::kTool, name);
      if (t.is(i + 3, "base")) flow_.set(What::kFrame, name);
      if (t.is(i + 3, "ex_base")) flow_.set(What::kFrame, "(computed)");
      if (t.is(i + 3, "initmov")) set_both("default");
    }
    if (t.is(i - 1, "do") && (t.is(i, "$tool") || t.is(i, "$base"))) {  // TRIGGER ... DO $BASE=...
      flow_.routine("(trigger)", true);
      set_both("(computed)");
      flow_.end_routine();
    }
    if (!begins(t, i)) return;
    if (t.is(i, "$tool") && t.is(i + 1, ".")) flow_.set(What::kTool, "(computed)");
    if (t.is(i, "$base") && t.is(i + 1, ".")) flow_.set(What::kFrame, "(computed)");
    if (t.is(i, "fdat_act") && t.is(i + 1, ".")) set_both("(computed)");
    if (!t.is(i + 1, "=")) return;
    if (t.is(i, "$ipo_mode") && !arm_has_tool(t, i)) {
      in_cell_ = true;
      flow_.set(What::kTool, kInCell);
    }
    if (t.is(i, "fdat_act")) {
      std::size_t k = i + 2;
      const auto known = fdat_.find(t.lower(k));
      const auto value = known != fdat_.end() ? known->second : aggregate(t, k);
      flow_.set(What::kTool, value ? number_name(*value, "tool_no") : "(computed)");
      flow_.set(What::kFrame, value ? number_name(*value, "base_no") : "(computed)");
    }
    if (t.is(i, "$tool")) flow_.set(What::kTool, stated(t, i + 2, "tool_data", program_.tools));
    if (t.is(i, "$base")) flow_.set(What::kFrame, stated(t, i + 2, "base_data", program_.frames));
  }

  /// What stands behind "$TOOL=": TOOL_DATA[n], NULLFRAME, an aggregate, or STOOL2(FP1).
  std::string stated(const Tokens& t, std::size_t i, const char* array, Frames& frames) const {
    if (t.is(i, array) && t.is(i + 1, "[") && t.is(i + 3, "]") && !t.is(i + 4, ":") &&
        t.at(i + 2).kind == Token::Kind::kNumber)
      return std::string(t.text(i + 2));
    if (t.is(i, "$nullframe") && !t.is(i + 1, ":")) return "0";
    std::size_t k = i;
    if (const auto value = aggregate(t, k); value && !t.is(k, ":")) {
      const std::string name = t.whole(i, k);
      frames[name] = frame_of(value);
      return name;
    }
    const bool call = t.is_word(i) && t.is(i + 1, "(");
    if (const auto known = fdat_.find(t.lower(i + 2)); call && known != fdat_.end())
      return number_name(known->second,
                         std::string_view(array) == "tool_data" ? "tool_no" : "base_no");
    return "(computed)";
  }

  void move(const Tokens& t, std::size_t i) {
    if (!begins(t, i) || !t.is_word(i)) return;
    std::string word = t.lower(i);
    if (word.size() > 3 && word[0] == 's') word.erase(0, 1);
    Move move{.motion = Motion::kJoint, .line = t.line(i), .configured = word == "ptp"};
    if (spline_) move.tool = move.frame = "(set by the SPLINE block)";
    std::size_t k = i + 1;
    if (word == "ptp_rel" || word == "lin_rel" || word == "circ_rel") {
      move.target = listed(t, k, "it is relative to where the arm stands");
      push(move);
      return;
    }
    if (word != "ptp" && word != "lin" && word != "circ") return;
    with_clause(t, k, move);
    if (word == "lin") move.motion = Motion::kLinear;
    if (word == "circ") move.motion = Motion::kVia;
    move.target = goal(t, k);
    push(move);
    if (word != "circ" || !t.is(k, ",")) return;
    move.motion = Motion::kCircleEnd;
    move.target = goal(t, ++k);
    push(move);
  }

  void push(const Move& move) {
    flow_.move();
    program_.moves.push_back(move);
  }

  /// "SLIN XP1 WITH $TOOL=STOOL2(FP1), $BASE=SBASE(FP1.BASE_NO)": of this move only.
  void with_clause(const Tokens& t, std::size_t k, Move& move) {
    for (; !ends(t, k) && !t.is(k, "with"); ++k) {
    }
    for (; !ends(t, k); ++k) {
      if (t.is(k, "$tool") && t.is(k + 1, ".")) move.tool = "(computed)";
      if (t.is(k, "$base") && t.is(k + 1, ".")) move.frame = "(computed)";
      if (!t.is(k + 1, "=")) continue;
      in_cell_ = in_cell_ || (t.is(k, "$ipo_mode") && !arm_has_tool(t, k));
      if (t.is(k, "$tool")) move.tool = stated(t, k + 2, "tool_data", program_.tools);
      if (t.is(k, "$base")) move.frame = stated(t, k + 2, "base_data", program_.frames);
    }
  }

  int goal(const Tokens& t, std::size_t& k) {
    const std::size_t begin = k;
    const auto over = [&](std::size_t at) { return ends(t, at) || t.is(at, ",") || t.is_word(at); };
    if (t.is_word(k) && over(k + 1))
      if (const int known = names_.used(t, k); known >= 0) {
        ++k;
        return known;
      }
    if (const auto value = aggregate(t, k); value && over(k))
      return program_.add_inline(target(value), t.source(), t.line(begin));
    k = begin;
    const bool name = t.is_word(k) && over(k + 1);
    const int out =
        name ? program_.list(std::string(t.text(begin)), t.source(), t.line(begin),
                             "the program does not state it", "state it in the .dat file beside it")
             : listed(t, begin, "it is computed while the program runs");
    int depth = 0;
    for (; !ends(t, k) && !(depth == 0 && t.is(k, ",")); ++k) {
      depth += t.is(k, "{") ? 1 : 0;
      depth -= t.is(k, "}") ? 1 : 0;
    }
    return out;
  }

  int listed(const Tokens& t, std::size_t i, std::string why) {
    std::size_t k = i;
    while (!ends(t, k)) ++k;
    return program_.list(t.quoted(i, k), t.source(), t.line(i), std::move(why),
                         "state it as a target of its own, in the .src or the .dat file");
  }

  /// Where whole numbers stand as `own` has them, from `from` on: not as a part of longer ones.
  static std::size_t place_of(std::string_view own, std::string_view text, std::size_t from) {
    const auto joins = [&](std::size_t at) {
      const char c = at < text.size() ? text[at] : ' ';
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '+' || c == '-' ||
             c == '_';
    };
    for (std::size_t at = text.find(own, from); at != std::string_view::npos;
         at = text.find(own, at + 1))
      if (!(at > 0 && joins(at - 1)) && !joins(at + own.size())) return at;
    return std::string_view::npos;
  }

  /// A fold may hold the aggregate of its move once more in its comment, and the editor makes the
  /// move of it again: both are kept the same.
  void copies() {
    for (Target& target : program_.targets) {
      if (target.written.numbers.empty()) continue;
      const Tokens& t = comments_[target.source];
      const std::string& bytes = program_.sources[target.source].bytes;
      std::size_t first = bytes.size(), last = 0;
      for (const Number& n : target.written.numbers) {
        first = std::min(first, n.begin);
        last = std::max(last, n.end);
      }
      const std::string_view own = std::string_view(bytes).substr(first, last - first);
      const std::size_t i = t.first_from(first);
      bool inside = false;  // walks back to the beginning of the fold
      for (std::size_t k = i; k-- > 0 && !inside;) {
        if (t.at(k).kind != Token::Kind::kComment) continue;
        const std::string comment = t.lower(k);
        if (comment.substr(0, 8) == ";endfold") break;
        inside = comment.substr(0, 5) == ";fold";
        for (std::size_t at = place_of(own, t.text(k), 0); at != std::string_view::npos;
             at = place_of(own, t.text(k), at + 1))
          for (Number n : target.written.numbers) {
            n.end = t.at(k).begin + at + (n.end - first);
            n.begin = t.at(k).begin + at + (n.begin - first);
            target.copies.push_back(n);
          }
      }
      if (!inside) target.copies.clear();
    }
  }

  /// Two moves in one fold with the same numbers share their copy: made with different tools, they
  /// need different ones.
  void shared_copies() {
    std::map<std::pair<std::size_t, std::size_t>, const Move*> owners;
    for (const Move& move : program_.moves) {
      if (move.target < 0) continue;
      for (const Number& copy : program_.targets[static_cast<std::size_t>(move.target)].copies) {
        const Move& other =
            *owners.emplace(std::pair(copy.source, copy.begin), &move).first->second;
        if (std::tie(other.tool, other.frame, other.configured) ==
            std::tie(move.tool, move.frame, move.configured))
          continue;
        for (const int t : {other.target, move.target})
          program_.targets[static_cast<std::size_t>(t)].leave(
              "the comment of its fold stands for two moves, with different tools or bases",
              "give each of them a fold of its own");
      }
    }
  }

  Program& program_;
  const Facts& around_;
  Names names_;
  std::vector<Tokens> files_, comments_;
  std::map<std::string, Aggregate> fdat_;
  std::map<std::size_t, std::size_t> first_steps_;  // of each source
  CurrentFrame flow_;
  bool in_cell_ = false;  // the program says so of a tool, without a record
  bool spline_ = false;   // inside a block that states what its moves are made with
};

}  // namespace

void read_krl(Program& program, const Facts& around) { KrlReader(program, around).read(); }

/// Behind the lines with & and the line of DEF, DEFFCT or DEFDAT.
std::size_t krl_comment_place(std::string_view bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const std::string line = lower_case(line_at(bytes, at));
    at += line.size();
    const std::size_t word = std::min(line.find_first_not_of(" \t"), line.size());
    if (line.substr(word, 3) == "def" || line.substr(word, 10) == "global def") return at;
  }
  return 0;
}

}  // namespace plumb::offline::programs
