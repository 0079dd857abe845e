// SPDX-License-Identifier: Apache-2.0
#include "import/controller_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>

#include "import/cells.hpp"
#include "import/number_text.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kFirstLines = 40;  // that tell what a program is written in
constexpr std::size_t kFewestAxes = 4;

/// A position as the program writes it.
struct Position {
  std::string name;
  int line = 0;
  Cells joints;
};
using Positions = std::vector<Position>;

struct Language {
  const char* name;
  const char* unit;
  const char* instead;  // what to export
  bool (*is_written)(std::string_view line);
  Positions (*read)(const SourceText& text);
};

std::string lower_case(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

bool begins(std::string_view line, std::string_view word) {
  return lower_case(trimmed(line)).starts_with(word);
}

bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// The name that ends before `end`; empty if there is none.
std::string name_before(std::string_view line, std::size_t end) {
  while (end > 0 && (line[end - 1] == ' ' || line[end - 1] == '=' || line[end - 1] == ':')) --end;
  std::size_t first = end;
  while (first > 0 && is_name(line[first - 1])) --first;
  return std::string(line.substr(first, end - first));
}

/// Numbers that follow one another in a list that begins at `first` and ends with the sign.
Cells list_at(std::string_view line, std::size_t first, char end) {
  Cells out = cut_line(line.substr(first, line.find(end, first) - first), ',');
  const bool numbers = std::all_of(out.begin(), out.end(), [](std::string_view cell) {
    return number_in(cell, '.').has_value();
  });
  return numbers ? out : Cells{};
}

/// Adds "A1 -5.0" or "J1= 54.8 deg": the number behind the letter and the next number.
void add_joints(std::string_view line, char letter, Cells& joints) {
  for (;;) {
    const std::string wanted = letter + std::to_string(joints.size() + 1);
    std::size_t at = line.find(wanted);
    while (at != line.npos &&
           ((at > 0 && is_name(line[at - 1])) ||
            (at + 2 < line.size() && std::isdigit(static_cast<unsigned char>(line[at + 2])))))
      at = line.find(wanted, at + 1);
    if (at == line.npos) return;
    auto rest = line.substr(at + wanted.size());
    rest.remove_prefix(std::min(rest.find_first_not_of(" =\t"), rest.size()));
    const auto number = rest.substr(0, rest.find_first_of(" ,}\t;"));
    if (!number_in(number, '.')) return;
    joints.push_back(number);
    line = rest;
  }
}

Positions read_fanuc(const SourceText& text) {
  Positions out;
  bool inside = false, first_group = true;
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const auto line = trimmed(text.lines[i]);
    if (line.starts_with("P[") && line.find('{') != line.npos) {
      const auto number = line.substr(2, line.find_first_of(":]") - 2);
      out.push_back({"P" + std::string(trimmed(number)), static_cast<int>(i) + 1, {}});
      inside = first_group = true;
    }
    if (line.starts_with("GP")) first_group = line.starts_with("GP1");
    if (inside && first_group) add_joints(line, 'J', out.back().joints);
    inside = inside && line.find('}') == line.npos;
  }
  return out;
}

Positions read_rapid(const SourceText& text) {
  Positions out;
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const auto line = text.lines[i];
    const std::string small = lower_case(line);
    const auto declared = small.find("jointtarget"), moved = small.find("moveabsj");
    const auto at = line.find("[[");
    if ((declared == small.npos && moved == small.npos) || at == line.npos) continue;
    out.push_back({declared == small.npos ? std::to_string(out.size() + 1) : name_before(line, at),
                   static_cast<int>(i) + 1, list_at(line, at + 2, ']')});
  }
  return out;
}

Positions read_krl(const SourceText& text) {
  Positions out;
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const auto line = text.lines[i];
    const auto at = line.find('{');
    if (at == line.npos) continue;
    Position position{name_before(line, at), static_cast<int>(i) + 1, {}};
    add_joints(line.substr(at), 'A', position.joints);
    const std::string name = lower_case(position.name);
    if (name.empty() || name == "ptp" || name == "e6axis" || name == "axis")
      position.name = std::to_string(out.size() + 1);
    if (!position.joints.empty()) out.push_back(std::move(position));
  }
  return out;
}

Positions read_ur(const SourceText& text) {
  Positions out;
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const auto line = text.lines[i];
    auto at = line.find("movej");
    if (at == line.npos) continue;
    at = line.find_first_not_of(" (", at + 5);
    if (at != line.npos && line[at] == '[')
      out.push_back(
          {std::to_string(out.size() + 1), static_cast<int>(i) + 1, list_at(line, at + 1, ']')});
  }
  return out;
}

Positions read_nothing(const SourceText&) { return {}; }

const std::vector<Language>& languages() {
  static const std::vector<Language> all{
      {"Fanuc program (LS)", "deg",
       "teach the positions as joint positions (POSITION, [REPRE], JOINT) and save the program as "
       "ASCII again",
       [](std::string_view line) { return begins(line, "/prog"); }, read_fanuc},
      {"RAPID module (ABB)", "deg",
       "store the positions as jointtarget (CJointT()), not as robtarget",
       [](std::string_view line) {
         return begins(line, "module ") || begins(line, "%%%") ||
                begins(line, "const jointtarget") || begins(line, "pers jointtarget") ||
                begins(line, "const robtarget");
       },
       read_rapid},
      {"KRL program (KUKA)", "deg",
       "store the positions as E6AXIS ($AXIS_ACT), {A1 ..., A2 ...}, not as E6POS or FRAME",
       [](std::string_view line) {
         return begins(line, "&access") || begins(line, "defdat ") || begins(line, "decl e6") ||
                (begins(line, "def ") && trimmed(line).back() == ')');
       },
       read_krl},
      {"script of Universal Robots", "rad",
       "write the joint positions, movej([...]), or log actual_q over RTDE",
       [](std::string_view line) { return begins(line, "movej(") || begins(line, "movel("); },
       read_ur},
      {"INFORM job (Yaskawa)", "deg",
       "its positions are pulses of the motors or Cartesian; export the joint angles in degrees as "
       "text",
       [](std::string_view line) { return begins(line, "/job"); }, read_nothing},
      {"program of a Kawasaki controller", "deg",
       "export the joint angles in degrees as text, one row a pose",
       [](std::string_view line) { return begins(line, ".program") || begins(line, ".joints"); },
       read_nothing},
  };
  return all;
}

const Language* language_of(const SourceText& text) {
  std::size_t looked = 0;
  for (const auto line : text.lines) {
    if (trimmed(line).empty()) continue;
    for (const auto& language : languages())
      if (language.is_written(line)) return &language;
    if (++looked == kFirstLines) break;
  }
  return nullptr;
}

RawRows rows_of(const SourceText& text, const Language& language, const Positions& positions) {
  RawRows out(text);
  auto& d = out.dialect;
  const std::size_t joints = positions.front().joints.size();
  d.separator = '=';
  d.header = {"pose"};
  d.units = {""};
  for (std::size_t j = 1; j <= joints; ++j) {
    d.header.push_back(fmt::format("q{}", j));
    d.units.emplace_back(language.unit);
  }
  for (const auto& position : positions) {
    Cells row{position.name};
    row.insert(row.end(), position.joints.begin(), position.joints.end());
    out.cells.add(row);
    out.lines.push_back(position.line);
  }
  out.remarks.push_back(
      {.severity = Severity::kNote,
       .code = "N-IMPORT-PROGRAM",
       .message = fmt::format("this is a {}: {} joint positions in {} were taken from it, as it "
                              "commands them",
                              language.name, positions.size(), language.unit),
       .place = Place{.file = text.file, .line = positions.front().line},
       .help =
           "the measured points come from another file: plumb import FILE TRACKER --join pose"});
  return out;
}

}  // namespace

std::optional<RawRows> controller_program(const SourceText& text) {
  const Language* language = language_of(text);
  if (language == nullptr) return std::nullopt;
  Positions positions = language->read(text);
  const std::size_t all = positions.size();
  std::erase_if(positions, [](const Position& p) { return p.joints.size() < kFewestAxes; });
  if (positions.empty() || (positions.size() < all && language->read == read_fanuc))
    throw Failure(Exit::kInput, {.code = "E-IMPORT-PROGRAM",
                                 .message = fmt::format(
                                     "this is a {}, and {} of its positions are no joint angles",
                                     language->name, positions.empty() ? "all" : "some"),
                                 .place = Place{.file = text.file, .line = 1},
                                 .help = language->instead});
  return rows_of(text, *language, positions);
}

}  // namespace plumb::offline
