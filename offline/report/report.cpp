// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include "report/document.hpp"
#include "report/pages.hpp"

namespace plumb::offline::report {
Report make_report(const ReportData& data) {
  const ReportFigures figures(data);
  std::vector<Section> pages;
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

  Report out;
  out.html = document(
      "Calibration of " + (data.cell.name.empty() ? std::string("cell") : data.cell.name), pages);
  out.pages = static_cast<int>(pages.size());
  out.verdict = data.answers.sentence;
  out.good = is_good(data.run, data.cell.tolerance_m);
  return out;
}

}  // namespace plumb::offline::report
