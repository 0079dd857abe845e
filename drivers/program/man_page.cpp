// SPDX-License-Identifier: Apache-2.0
#include "program/man_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace plumb {
namespace {

/// Text that roff prints as it is: a minus that can be pasted, and no line that is a request.
std::string roff(const std::string& text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    line_begins = c == '\n';
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

/// A sentence: it begins with a capital letter and ends with a full stop.
std::string sentence(std::string text) {
  if (text.empty()) return text;
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text.ends_with('.') ? text : text + ".";
}

std::string joined(const std::vector<std::string>& parts, const std::string& between) {
  return fmt::format("{}", fmt::join(parts, between));
}

std::string option_text(const OptionRow& row) {
  std::string out = row.help;
  const bool named = row.value == joined(row.words, "|");  // the words are the name of the value
  if (!row.words.empty() && !named) out += " (one of " + joined(row.words, ", ") + ")";
  if (!row.range.empty()) out += " (allowed: " + row.range + ")";
  if (!row.preset.empty()) out += " (default: " + row.preset + ")";
  return sentence(out);
}

std::string option_item(const OptionRow& row) {
  std::vector<std::string> names;
  for (const auto& name : row.names) names.push_back(bold(name));
  const std::string value = row.value.empty() ? "" : " " + italic(row.value);
  return ".TP\n" + joined(names, ", ") + value + "\n" + roff(option_text(row)) + "\n";
}

std::string positional_item(const OptionRow& row) {
  return ".TP\n" + italic(row.names.front()) + "\n" + roff(option_text(row)) + "\n";
}

std::string example_block(const std::string& examples) {
  return ".PP\nExamples:\n.PP\n.nf\n" + roff(examples) + "\n.fi\n";
}

std::string synopsis(const CommandTable& table, const VerbRow& verb) {
  std::string out = bold(table.program) + " " + bold(verb.name) + " [" + italic("OPTIONS") + "]";
  for (const auto& word : verb.positionals) {
    const std::string name = italic(word.names.front()) + (word.repeated ? "..." : "");
    out += word.required ? " " + name : " [" + name + "]";
  }
  return out;
}

bool is_among(const OptionRow& row, const std::vector<OptionRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [&row](const OptionRow& other) {
    return other.names == row.names && other.help == row.help;
  });
}

std::string option_section(const CommandTable& table) {
  std::vector<std::string> alone;
  for (const auto& row : table.options)
    if (!table.verbs.empty() && !is_among(row, table.verbs.front().options))
      alone.push_back(roff(row.names.back()));
  std::string out = ".SH OPTIONS\nEvery verb takes these too";
  out += alone.empty() ? ".\n" : ", except " + joined(alone, ", ") + ".\n";
  for (const auto& row : table.options) out += option_item(row);
  return out;
}

std::string verb_section(const CommandTable& table, const VerbRow& verb) {
  std::string out = fmt::format(".SS \"{} {}\"\n", roff(table.program), roff(verb.name));
  out += synopsis(table, verb) + "\n.PP\n" + roff(sentence(verb.summary)) + "\n";
  for (const auto& row : verb.positionals) out += positional_item(row);
  for (const auto& row : verb.options)
    if (!is_among(row, table.options)) out += option_item(row);
  return out + example_block(verb.examples);
}

std::string name_section(const CommandTable& table) {
  std::string about = table.about;
  about[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(about[0])));
  if (about.ends_with('.')) about.pop_back();
  return fmt::format(".SH NAME\n{} \\- {}\n", roff(table.program), roff(about));
}

std::string exit_section(ExitRow::Of program) {
  std::string out = ".SH EXIT STATUS\n";
  for (const auto& row : exit_codes())
    if (row.of == ExitRow::Of::kEveryProgram || row.of == program)
      out += fmt::format(".TP\n.B {}\n{}\n", static_cast<int>(row.code), roff(sentence(row.means)));
  return out;
}

std::string file_section(const std::vector<FileRow>& files) {
  if (files.empty()) return "";
  std::string out = ".SH FILES\n";
  for (const auto& file : files)
    out += ".TP\n" + italic(file.name) + "\n" + roff(sentence(file.what)) + "\n";
  return out;
}

std::string see_also_section(const std::vector<std::string>& programs) {
  std::vector<std::string> names;
  for (const auto& program : programs) names.push_back(bold(program) + "(1)");
  return names.empty() ? "" : ".SH SEE ALSO\n" + joined(names, ",\n") + "\n";
}

}  // namespace

std::string man_page(const CommandTable& table, const ManualText& text) {
  std::string title = table.program;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string out = ".\\\" SPDX-License-Identifier: Apache-2.0\n";
  out += fmt::format(".TH {} 1 \"\" \"{} {}\" \"Plumb\"\n", roff(title), roff(table.program),
                     roff(text.version));
  out += name_section(table);
  out += ".SH SYNOPSIS\n" + bold(table.program) + " [" + italic("OPTIONS") + "] " + italic("VERB") +
         " ...\n";
  out += ".SH DESCRIPTION\n" + roff(table.about) + "\n" + example_block(table.examples);
  out += option_section(table) + ".SH VERBS\n";
  for (const auto& verb : table.verbs) out += verb_section(table, verb);
  return out + exit_section(text.exits) + file_section(text.files) +
         see_also_section(text.see_also);
}

}  // namespace plumb
