// SPDX-License-Identifier: Apache-2.0
#include "report/document.hpp"

#include <fmt/format.h>

#include "draw/svg.hpp"
#include "plumb/format/version.hpp"
#include "report/page_style.hpp"

namespace plumb::offline::report {
namespace {

std::string contents(const std::vector<Section>& sections) {
  std::string out = "<nav aria-label=\"Contents\"><ol>\n";
  for (const auto& section : sections)
    out += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, section.title);
  return out + "</ol></nav>\n";
}

std::string numbered(const Section& section, std::size_t number) {
  return fmt::format(
             "<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\">{1}. "
             "{2}</h2>\n",
             section.id, number, section.title) +
         section.body.text() + "</section>\n";
}

/// Nothing is loaded and nothing runs: the policy says so to the browser too.
std::string head(const std::string& title) {
  return "<!DOCTYPE html>\n<html lang=\"en\" class=\"plumb-figure\">\n<head>\n<meta "
         "charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
         "'unsafe-inline'; img-src data:\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"generator\" content=\"plumb " +
         std::string(format::kVersion) +
         "\">\n<link rel=\"icon\" href=\"data:,\">\n"
         "<title>" +
         title + "</title>\n<style>\n" + page_style() + "</style>\n</head>\n";
}

}  // namespace

std::string document(const std::string& title, const std::vector<Section>& sections) {
  const std::string heading = draw::escaped(title);
  std::string body;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (i == 1) body += contents(sections);  // the first one says how it is
    body += numbered(sections[i], i + 1);
  }
  return head(heading) + "<body>\n<header><h1>" + heading + "</h1></header>\n<main>\n" + body +
         "</main>\n</body>\n</html>\n";
}

}  // namespace plumb::offline::report
