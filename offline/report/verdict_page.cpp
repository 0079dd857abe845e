// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "draw/svg.hpp"
#include "fit/verdict.hpp"
#include "plumb/format/version.hpp"
#include "program/counted_words.hpp"
#include "report/page_words.hpp"
#include "report/pages.hpp"
#include "report/report.hpp"
#include "show/compare_view.hpp"
#include "show/counted.hpp"
#include "show/units.hpp"

namespace plumb::offline::report {
namespace {

using show::mm;

void put_verdict(const ReportData& data, Html& html) {
  const char* const found = name_of(grade(data.run.fit, data.cell.tolerance_m));
  html.raw(fmt::format(
      "<div class=\"verdict {}\" role=\"note\"><strong>{} {}</strong><p>{}</p></div>\n", found,
      verdict_mark(found), draw::escaped(verdict_head(data.run.fit, data.cell.tolerance_m)),
      draw::escaped(data.answers.sentence)));
}

/// Where, why and what next stand on the first page: most readers see no other.
void put_answers(const Answers& answers, Html& html) {
  const Action next = action_of(answers.next);
  html.facts(
      {{"Where does it fail?", answers.where},
       {"Why?", answers.why.text},
       {"What next?", next.typed() + (next.why.empty() ? "" : fmt::format(" ({})", next.why))}});
}

/// Whether the file says the tolerance, outside comments.
bool states_tolerance(const std::string& toml) {
  for (std::size_t at = toml.find("tolerance_mm"); at != std::string::npos;
       at = toml.find("tolerance_mm", at + 1)) {
    const auto line = toml.rfind('\n', at);
    const std::size_t begin = line == std::string::npos ? 0 : line + 1;
    if (toml.substr(begin, at - begin).find('#') == std::string::npos) return true;
  }
  return false;
}

std::string fall_words(const Fit& fit) {
  if (fit.held.n == 0 || fit.nominal_held.n == 0)
    return "No reading was held out, so nothing is known of readings that the model has not seen: "
           "the row of the fitted readings is no accuracy.";
  const ErrorStats& held = usual_held(fit);
  const double share = 1.0 - held.mean / std::max(fit.nominal_held.mean, 1e-12);
  return fmt::format(
      "On {} that the model has not seen, calibration takes the mean error from {} mm to {} mm "
      "({}{:.0f} %).",
      counted_words(static_cast<std::size_t>(held.n), "reading", "readings"),
      mm(fit.nominal_held.mean), mm(held.mean), share >= 0.0 ? "-" : "+", std::abs(100.0 * share));
}

std::string assumed_words(const Cell& cell) {
  if (states_tolerance(cell.text)) return "";
  return fmt::format(" cell.toml states no tolerance, so {} mm is assumed.", mm(cell.tolerance_m));
}

std::string inferred_words(const NoiseFloor& floor) {
  if (!(floor.inferred_m > 0.0)) return "";
  return fmt::format(
      " A diagnosis takes what the model leaves for joints that do not come back to the same "
      "place, "
      "which would make it {} mm: that is inferred, not measured; repeats of some poses, each "
      "approached anew, would measure it.",
      mm(floor.inferred_m));
}

std::string floor_source_words(const NoiseFloor& floor) {
  switch (floor.source) {
    case NoiseFloor::Source::kRepeats:
      return fmt::format(
          "The noise floor, {} mm, is what noise alone leaves of the error: {:.1f} um per axis, by "
          "which repeats of the same poses differ.",
          mm(floor.mean_m), floor.sigma_m * 1e6);
    case NoiseFloor::Source::kSigma:
      return fmt::format(
          "The noise floor, {} mm, is what noise alone leaves of the error if the stated sigma of "
          "{:.1f} um per axis is right; repeats of a few poses would measure it.",
          mm(floor.mean_m), floor.sigma_m * 1e6);
    default:
      return "The noise floor is unknown: no pose was measured several times and no sigma_um is "
             "stated, so nobody can say how much of the error is noise.";
  }
}

show::Blocks errors(const ReportData& data) {
  show::Blocks out =
      show::tolerance_blocks(data.cell, data.measured, data.comparison, data.run.fit);
  std::get<show::Table>(out.front())
      .add({"tolerance", "", "", "", "", mm(data.cell.tolerance_m), ""});
  return out;
}

std::string files_words(const MeasurementFiles& measured) {
  std::vector<std::string> names;
  for (const auto& table : measured.tables)
    names.push_back(std::filesystem::path(table.file).filename().string());
  return listed_words(names);
}

std::string or_none(const std::string& text, const char* none) {
  return text.find_first_not_of(" \t") == std::string::npos ? none : text;
}

void put_facts(const ReportData& data, Html& html) {
  const auto& chain = data.cell.nominal;
  html.facts(
      {{"Cell", or_none(data.cell.name, "without a name")},
       {"Robot",
        fmt::format("{}, {} joints, {} DH", or_none(data.cell.robot_name, "without a name"),
                    chain.joints.size(),
                    chain.convention == format::Convention::kStandard ? "standard" : "modified")},
       {"Serial number", or_none(data.cell.serial, "none stated in cell.toml")},
       {"Run", fmt::format("{}, made {}",
                           data.run.number > 0 ? fmt::format("{}", data.run.number) : "not kept",
                           data.run.created)},
       {"Model", show::counted(data.run.effects.empty() ? std::vector<std::string>{"nothing fitted"}
                                                        : data.run.effects)},
       {"Measured", fmt::format("{}: {}", files_words(data.measured),
                                counted_words(static_cast<std::size_t>(data.measured.size()),
                                              "reading", "readings"))},
       {"Report", fmt::format("{} by plumb {}", data.created, format::kVersion)}});
}

}  // namespace

std::optional<bool> is_good(const Run& run, double tolerance_m) {
  if (run.fit.held.n == 0) return std::nullopt;
  return keeps(usual_held(run.fit), tolerance_m);
}

Html verdict_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  put_verdict(data, html);
  put_answers(data.answers, html);
  if (!data.run_is_current)
    html.paragraph(fmt::format(
        "Run {} was made from another cell.toml than the present one: what this report says of the "
        "cell file is of the present one, what it says of errors and parameters is of the run.",
        data.run.number));
  html.paragraph(fall_words(data.run.fit) + assumed_words(data.cell));
  html.blocks(show::moved_blocks(data.cell, data.measured, data.comparison), {});
  html.blocks(errors(data), {});
  html.paragraph(floor_source_words(data.run.fit.floor) + inferred_words(data.run.fit.floor));
  put_facts(data, html);
  figures.put(Page::kVerdict, html);
  return html;
}

}  // namespace plumb::offline::report
