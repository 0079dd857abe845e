// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "show/study_view.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

using study::PlanarStudy;
using study::RowKind;
using study::StudyRow;
using study::TotalError;

constexpr std::array kKinds{"published", "comparison", "ours", "physics"};
constexpr std::array kHeadings{"as published", "textbook smoothing of the same 93 leaves",
                               "blended, one global least squares", "the missing physics"};

const char* variant_name(PlanarVariant variant) {
  return variant == PlanarVariant::kPublished ? "published" : "printed";
}

std::string digits(double metres) {
  const double value = to_mm(metres);
  return value >= 0.001 ? fmt::format("{:.4g}", value) : fmt::format("{:.1e}", value);
}

std::string pair_of(const TotalError& e) { return digits(e.mean) + " / " + digits(e.max); }

void put_error(Json& out, const std::string& key, const TotalError& e) {
  put(out, key + "_mean_mm", to_mm(e.mean));
  put(out, key + "_max_mm", to_mm(e.max));
}

Json row_json(const StudyRow& row) {
  Json out{{"key", row.key},
           {"model", row.model},
           {"size", row.size},
           {"kind", kKinds[static_cast<std::size_t>(row.kind)]}};
  if (row.trees) {
    out["leaves"] = {row.trees->tree[0].leaves(), row.trees->tree[1].leaves()};
    out["degree"] = {row.trees->tree[0].degree, row.trees->tree[1].degree};
  }
  if (row.paper) put_error(out, "paper", *row.paper);
  put_error(out, "test", row.test);
  put_error(out, "unseen", row.disjoint);
  return out;
}

std::string headline(const PlanarStudy& study) {
  const StudyRow& ours = study.row("blended_quadratic");
  if (study.request.variant == PlanarVariant::kPublished)
    return fmt::format(
        "On positions that no model has seen: calibrated + LLMT {} mm (paper: 0.0157 / 0.131), its "
        "leaves blended and fitted together {} mm.\n\n",
        pair_of(study.row("calibrated_llmt").disjoint), pair_of(ours.disjoint));
  return fmt::format(
      "On positions that no model has seen: the best tree {} mm, the missing physics with 6 "
      "numbers "
      "{} mm.\n\n",
      pair_of(ours.disjoint), pair_of(study.row("link_flexure").disjoint));
}

std::string links_text(const PlanarStudy& study) {
  const auto& d = study.links.d;
  Table table{.head = {"calibration, eqs. (6) to (9)", "paper", "here"}};
  const auto add = [&](const char* name, const char* paper, const std::string& here) {
    table.add({name, paper, here});
  };
  add("L2 [mm]", "1000", fmt::format("{:.4f}", to_mm(d[0])));
  add("L3 [mm]", "999.998", fmt::format("{:.4f}", to_mm(d[1])));
  add("v2 [mm]", "0.41", fmt::format("{:.4f}", to_mm(d[2])));
  add("v3 [mm]", "0.36", fmt::format("{:.4f}", to_mm(d[3])));
  add("calibrability", "1.78", fmt::format("{:.4f}", study.links.calibrability));
  add("converged in iteration", "2", fmt::format("{}", study.links.iterations));
  return text_of(table);
}

std::string rows_text(const PlanarStudy& study) {
  Table table{.head = {"total error e_t [mm], mean / max", "size", "paper",
                       "its 5985 test positions", "20,000 unseen"}};
  std::optional<RowKind> kind;
  for (const StudyRow& row : study.rows) {
    if (kind != row.kind) {
      table.add({std::string("- ") + kHeadings[static_cast<std::size_t>(row.kind)]});
      kind = row.kind;
    }
    table.add(
        {row.model, row.size,
         row.paper ? fmt::format("{:g} / {:g}", to_mm(row.paper->mean), to_mm(row.paper->max)) : "",
         pair_of(row.test), pair_of(row.disjoint)});
  }
  return text_of(table);
}

}  // namespace

Json planar_json(const PlanarStudy& study) {
  const auto& d = study.links.d;
  Json out{{"study", "planar"},
           {"variant", variant_name(study.request.variant)},
           {"noise_um", study.request.noise_m * 1e6},
           {"seed", study.request.seed}};
  out["links"] = {{"L2_mm", to_mm(d[0])},
                  {"L3_mm", to_mm(d[1])},
                  {"v2_mm", to_mm(d[2])},
                  {"v3_mm", to_mm(d[3])}};
  put(out, "calibrability", study.links.calibrability);
  out["iterations"] = study.links.iterations;
  out["rows"] = Json::array();
  for (const auto& row : study.rows) out["rows"].push_back(row_json(row));
  out["diagnosis"] = study.diagnosis;
  out["remarks"] = study.remarks;
  return out;
}

std::string planar_text(const PlanarStudy& study) {
  std::string out = headline(study);
  out += fmt::format(
      "Variant '{}', {:g} um noise per axis on what is learnt from; errors against "
      "positions without noise.\n\n",
      variant_name(study.request.variant), study.request.noise_m * 1e6);
  out += links_text(study) + "\n" + rows_text(study) + "\n";
  out += "Diagnosis: " + study.diagnosis + "\n\n";
  for (const auto& remark : study.remarks) out += "* " + remark + "\n";
  return out;
}

}  // namespace plumb::offline::show
