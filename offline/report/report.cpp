// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include <fmt/format.h>

#include "compare/full_verdict.hpp"
#include "draw/svg.hpp"
#include "plumb/format/version.hpp"
#include "report/page_style.hpp"
#include "report/pages.hpp"

namespace plumb::offline::report {
namespace {

struct Titled {
  const char* id;
  const char* title;
  Html body;
};

std::string contents(const std::vector<Titled>& pages) {
  std::string out = "<nav aria-label=\"Contents\"><ol>\n";
  for (const auto& page : pages)
    out += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", page.id, page.title);
  return out + "</ol></nav>\n";
}

std::string section(const Titled& page, std::size_t number) {
  return fmt::format(
             "<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\">{1}. "
             "{2}</h2>\n",
             page.id, number, page.title) +
         page.body.text() + "</section>\n";
}

std::string heading_of(const ReportData& data) {
  const std::string name = data.cell.name.empty() ? "cell" : data.cell.name;
  return draw::escaped("Calibration of " + name);
}

/// Nothing is loaded and nothing runs: the policy says so to the browser too.
std::string head_of(const ReportData& data) {
  return "<!DOCTYPE html>\n<html lang=\"en\" class=\"plumb-figure\">\n<head>\n<meta "
         "charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
         "'unsafe-inline'; img-src data:\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"generator\" content=\"plumb " +
         std::string(format::kVersion) +
         "\">\n<link rel=\"icon\" href=\"data:,\">\n"
         "<title>" +
         heading_of(data) + "</title>\n<style>\n" + page_style() + "</style>\n</head>\n";
}

}  // namespace

Report make_report(const ReportData& data) {
  const ReportFigures figures(data);
  std::vector<Titled> pages;
  pages.push_back({"verdict", "Verdict", verdict_page(data, figures)});
  pages.push_back({"data", "Data", data_page(data, figures)});
  pages.push_back({"where", "Where it fails", where_page(data, figures)});
  pages.push_back({"patterns", "Patterns of what is left", patterns_page(data, figures)});
  pages.push_back({"missing", "What is missing", missing_page(data, figures)});
  pages.push_back({"added", "What was added", added_page(data, figures)});
  pages.push_back({"parameters", "Parameters", parameters_page(data, figures)});
  pages.push_back({"controller", "The model in the controller", controller_page(data, figures)});
  pages.push_back({"limits", "Limits of validity", limits_page(data, figures)});
  pages.push_back({"reproduce", "How to reproduce it", reproduce_page(data)});
  std::string before;
  for (const auto& page : pages) before += page.body.text();
  pages.push_back({"glossary", "Glossary", glossary_page(data, before)});

  std::string body;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    if (i == 1) body += contents(pages);  // the verdict comes first
    body += section(pages[i], i + 1);
  }
  Report out;
  out.html = head_of(data) + "<body>\n<header><h1>" + heading_of(data) +
             "</h1></header>\n<main>\n" + body + "</main>\n</body>\n</html>\n";
  out.pages = static_cast<int>(pages.size());
  out.verdict = compare::full_verdict(data.cell, data.measured, data.run.fit);
  out.good = is_good(data.run, data.cell.tolerance_m);
  return out;
}

}  // namespace plumb::offline::report
