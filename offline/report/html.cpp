// SPDX-License-Identifier: Apache-2.0
#include "report/html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "draw/paint.hpp"
#include "draw/svg.hpp"

namespace plumb::offline::report {
namespace {

/// What a page has once is taken out of its figures: their style, and the colours for programs that
/// know no style, where a class says the colour.
std::string compacted(std::string_view svg) {
  const std::string style = "<style>\n" + draw::style_sheet() + "</style>\n";
  std::string out;
  out.reserve(svg.size());
  const auto skip = [&svg](std::size_t at, std::string_view attribute) {
    return svg.compare(at, attribute.size(), attribute) == 0
               ? svg.find('"', at + attribute.size()) + 1
               : at;
  };
  std::size_t from = 0;
  if (const auto at = svg.find(style); at != std::string_view::npos) {
    out += svg.substr(0, at);
    from = at + style.size();
  }
  constexpr std::string_view kClass = " class=\"";
  for (auto at = svg.find(kClass, from); at != std::string_view::npos;
       at = svg.find(kClass, from)) {
    const auto end = svg.find('"', at + kClass.size()) + 1;
    const auto classes = svg.substr(at + kClass.size(), end - at - kClass.size());
    out += svg.substr(from, end - from);
    from = classes.starts_with('f') ? skip(end, " fill=\"#") : end;
    if (classes.find('s') != std::string_view::npos) from = skip(from, " stroke=\"#");
  }
  return out += svg.substr(from);
}

/// Without the names of poses by which a program would find the marks: no program runs here.
std::string without_poses(const std::string& svg) {
  constexpr std::string_view kPose = " data-pose=\"";
  std::string out;
  std::size_t from = 0;
  for (auto at = svg.find(kPose); at != std::string::npos; at = svg.find(kPose, from)) {
    out += svg.substr(from, at - from);
    from = svg.find('"', at + kPose.size()) + 1;
  }
  return out += svg.substr(from);
}

/// Without the numbers of the marks, which no telephone shows.
std::string without_titles(const std::string& svg) {
  constexpr std::string_view kTitle = "><title>", kEnd = "</title></";
  std::string out;
  std::size_t from = 0;
  for (auto at = svg.find(kTitle); at != std::string::npos; at = svg.find(kTitle, from)) {
    out += svg.substr(from, at - from) + "/>";
    from = svg.find('>', svg.find(kEnd, at) + kEnd.size()) + 1;
  }
  return out += svg.substr(from);
}

/// A bar of '#', which the numbers beside it say in words, is drawn as one.
std::string cell_of(const std::string& text) {
  const bool bar = !text.empty() && text.find_first_not_of('#') == std::string::npos;
  return bar ? fmt::format("<span class=\"bar\" aria-hidden=\"true\">{}</span>", text)
             : draw::escaped(text);
}

/// The words with line breaks where the text has them; `escaped` would make them blanks.
std::string escaped_lines(std::string_view text) {
  std::string out;
  for (std::size_t from = 0; from <= text.size();) {
    const auto end = std::min(text.find('\n', from), text.size());
    out += draw::escaped(text.substr(from, end - from)) + '\n';
    from = end + 1;
  }
  return out;
}

}  // namespace

void Html::heading(std::string_view words) {
  text_ += fmt::format("<h3>{}</h3>\n", draw::escaped(words));
}

void Html::paragraph(std::string_view words) {
  if (!words.empty()) text_ += fmt::format("<p>{}</p>\n", draw::escaped(words));
}

void Html::list(const std::vector<std::string>& items) {
  if (items.empty()) return;
  text_ += "<ul>\n";
  for (const auto& item : items) text_ += fmt::format("<li>{}</li>\n", draw::escaped(item));
  text_ += "</ul>\n";
}

void Html::table(const show::Table& table) {
  if (table.rows.empty()) return;
  // A region that scrolls must be reachable by keyboard, and so needs a name.
  const std::string caption = draw::escaped(table.caption);
  text_ += fmt::format(
      "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{0}\"><table>\n"
      "<caption>{0}</caption>\n<thead><tr>",
      caption);
  const auto side = [&](std::size_t i) {
    return i == 0 || i >= table.left_from ? " class=\"left\"" : "";
  };
  for (std::size_t i = 0; i < table.head.size(); ++i)
    text_ += fmt::format("<th scope=\"col\"{}>{}</th>", side(i), draw::escaped(table.head[i]));
  text_ += "</tr></thead>\n<tbody>\n";
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const auto& row = table.rows[k];
    text_ += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      text_ += i == 0 ? fmt::format("<th scope=\"row\">{}</th>", draw::escaped(row[i]))
               : i + 1 == row.size() && k < table.last_class.size()
                   ? fmt::format("<td class=\"left {}\">{}</td>", table.last_class[k],
                                 draw::escaped(row[i]))
                   : fmt::format("<td{}>{}</td>", side(i), cell_of(row[i]));
    for (std::size_t i = row.size(); i < table.head.size(); ++i) text_ += "<td></td>";
    text_ += "</tr>\n";
  }
  text_ += "</tbody></table></div>\n";
}

void Html::facts(const std::vector<std::pair<std::string, std::string>>& facts) {
  text_ += "<dl>\n";
  for (const auto& [name, value] : facts)
    text_ += fmt::format("<dt>{}</dt><dd>{}</dd>\n", draw::escaped(name), draw::escaped(value));
  text_ += "</dl>\n";
}

void Html::preformatted(std::string_view label, std::string_view text) {
  text_ +=
      fmt::format("<pre role=\"region\" tabindex=\"0\" aria-label=\"{}\"><code>{}</code></pre>\n",
                  draw::escaped(label), escaped_lines(text));
}

void Html::blocks(const show::Blocks& blocks,
                  const std::function<void(const std::string&)>& put_figure) {
  std::string next;
  for (const show::Block& block : blocks) {
    if (const auto* const sentence = std::get_if<show::Sentence>(&block))
      paragraph(sentence->words);
    if (const auto* const found = std::get_if<show::Table>(&block)) table(*found);
    if (const auto* const drawn = std::get_if<show::Figure>(&block)) put_figure(drawn->name);
    if (const auto* const note = std::get_if<show::Note>(&block)) paragraph(note->words);
    if (const auto* const action = std::get_if<Action>(&block))
      next += (next.empty() ? "" : "\n") + action->typed() +
              (action->why.empty() ? "" : "   # " + action->why);
  }
  if (next.empty()) return;
  heading("What to do next");
  preformatted("Commands to type next", next);
}

void Html::figure(std::string_view wide_svg, std::string_view narrow_svg) {
  text_ += "<figure><div class=\"wide\">" + without_poses(compacted(wide_svg)) + "</div>";
  if (!narrow_svg.empty())
    text_ +=
        "<div class=\"narrow\">" + without_titles(without_poses(compacted(narrow_svg))) + "</div>";
  text_ += "</figure>\n";
}

}  // namespace plumb::offline::report
