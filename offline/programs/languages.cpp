// SPDX-License-Identifier: Apache-2.0
#include "programs/languages.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "programs/lexer.hpp"
#include "programs/settle.hpp"

namespace plumb::offline::programs {
namespace {

constexpr Language kLanguages[] = {
    {"RAPID", "|.mod|.prg|", "", "! ", "", 200, read_rapid, rapid_comment_place},
    {"Fanuc LS", "|.ls|", "", "   1:  !", " ;", 32, read_fanuc, fanuc_comment_place},
    {"KRL", "|.src|.dat|", ".dat", "; ", "", 200, read_krl, krl_comment_place},
    {"URScript", "|.script|", "", "# ", "", 200, read_urscript, urscript_comment_place},
};

constexpr std::size_t kBuiltIn = 2;  // tool0 and wobj0, or the like, that no program states

bool same(const Frame& a, const Frame& b) {
  return a.X && b.X && a.X->p == b.X->p && a.X->R == b.X->R;
}

/// What one program states of tools or frames holds for all; what two state differently is not
/// known.
void share(std::vector<Program>& programs, Frames Program::*which) {
  for (const Program& from : programs)
    for (Program& to : programs) {
      if (&from == &to) continue;
      for (const auto& [name, frame] : from.*which) {
        if (frame.local) continue;
        const auto [at, is_new] = (to.*which).emplace(name, frame);
        Frame& own = at->second;
        if (is_new || own.moving || same(own, frame)) continue;
        own = frame.moving ? frame : Frame{.X = {}, .why = "the programs state it differently"};
      }
    }
}

}  // namespace

const Language* language_of(const std::string& file) {
  const std::string ending = lower_case(std::filesystem::path(file).extension().string());
  if (ending.empty()) return nullptr;
  for (const Language& language : kLanguages)
    if (language.endings.find("|" + ending + "|") != std::string_view::npos) return &language;
  return nullptr;
}

std::string known_endings() {
  std::string out;
  for (const Language& language : kLanguages)
    for (const char c : language.endings.substr(1)) out += c == '|' ? ", " : std::string(1, c);
  return out.substr(0, out.size() - 2);
}

std::vector<Program> read_programs(const Language& language,
                                   std::vector<std::vector<Source>> programs) {
  // Twice: what another program says is known only when all are read.
  Facts around;
  for (const auto& sources : programs) {
    Program first;
    first.sources = sources;
    language.read(first, {});
    around.add(first.facts);
  }
  around.close();
  std::vector<Program> out;
  for (auto& sources : programs) {
    Program& program = out.emplace_back();
    program.sources = std::move(sources);
    language.read(program, around);
    settle(program);
    const std::size_t frames = program.tools.size() + program.frames.size();
    program.states_nothing = program.targets.empty() && program.moves.empty() && frames <= kBuiltIn;
  }
  share(out, &Program::tools);
  share(out, &Program::frames);
  return out;
}

}  // namespace plumb::offline::programs
