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

Program read_program(const Language& language, std::vector<Source> sources) {
  Program out;
  out.sources = std::move(sources);
  language.read(out);
  settle(out);
  return out;
}

}  // namespace plumb::offline::programs
