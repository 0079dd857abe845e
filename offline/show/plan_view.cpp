// SPDX-License-Identifier: Apache-2.0
#include "show/plan_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plumb/runtime/chain.hpp"
#include "show/text_table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

constexpr std::size_t kNumbersShown = 12;
constexpr double kConfounded = 0.8;  // above: two effects imitate each other too well to choose

Vector3 nominal_point(const Cell& cell, const Eigen::VectorXd& q) {
  ChainFrames frames;
  Chain(cell.nominal).frames({q.data(), static_cast<std::size_t>(q.size())}, frames);
  return frames.tip.p;
}

bool sides(const PosePlan& plan) { return plan.contrast == Contrast::kBothSides; }
bool payloads(const PosePlan& plan) { return plan.contrast == Contrast::kTwoPayloads; }

std::string header(const Cell& cell, const PosePlan& plan) {
  std::string out = "pose";
  for (int j = 0; j < cell.joints(); ++j)
    out += fmt::format(",q{}_{}", j + 1,
                       unit(slides(cell.nominal.joints[static_cast<std::size_t>(j)])));
  out += ",nx_mm,ny_mm,nz_mm";
  for (int j = 0; sides(plan) && j < cell.joints(); ++j) out += fmt::format(",dir_j{}", j + 1);
  if (payloads(plan)) out += ",payload_kg";
  return out + ",note\n";
}

std::string pair_words(const PlanRequest& request) {
  return request.separate.empty() ? ""
                                  : request.separate[0].name + " and " + request.separate[1].name;
}

Json sigma_json(const PredictionSigma& s) {
  return {{"mean_mm", to_mm(s.mean)}, {"worst_mm", to_mm(s.worst)}};
}

Json reproduction_json(const Reproduction& r) {
  Json out;
  const auto add = [&](const char* key, const std::optional<double>& share) {
    if (share)
      out[key] = 100.0 * *share;
    else
      put_null(out, key, "these poses do not show the effect");
  };
  add("a_by_b_pct", r.a_by_b);
  add("b_by_a_pct", r.b_by_a);
  return out;
}

Json numbers_json(const PosePlan& plan) {
  Json out = Json::array();
  for (const auto& number : plan.numbers) {
    Json row{{"name", number.name}, {"unit", number.unit}};
    if (number.before)
      row["std_before"] = *number.before;
    else
      put_null(row, "std_before", "the poses measured do not show it");
    row["std_after"] = number.after;
    out.push_back(std::move(row));
  }
  return out;
}

std::string prediction_text(const PosePlan& plan) {
  TextTable table({"1 sigma of a predicted point (3-D) [mm]", "mean", "worst"});
  const auto row = [&](const std::string& name, const PredictionSigma& s) {
    table.add({name, mm(s.mean), mm(s.worst)});
  };
  if (plan.measured > 0) row(fmt::format("with the {} measured", plan.measured), plan.before);
  row(fmt::format("{}these {}", plan.measured > 0 ? "and " : "with ", plan.poses.size()),
      plan.after);
  std::string out =
      table.text() +
      "\nThat comes from the uncertainty of the fitted numbers alone; the error of what "
      "the model lacks is added to it.\n";
  if (plan.measured > 0)
    out += fmt::format("The worst falls by {:.0f} %, the mean by {:.0f} %.\n",
                       100.0 * (1.0 - plan.after.worst / plan.before.worst),
                       100.0 * (1.0 - plan.after.mean / plan.before.mean));
  if (plan.measured > 0 && plan.before.worst < plan.sigma_m)
    out +=
        "Measuring them changes little: the fitted numbers already predict a point better than "
        "one reading of the tracker.\n";
  return out;
}

std::string contrast_text(const PosePlan& plan) {
  if (plan.contrast == Contrast::kNone) return "No contrast tells them apart, only poses do.\n";
  std::string out = fmt::format("What tells them apart best: {}.\n", contrast_words(plan.contrast));
  if (payloads(plan))
    out += fmt::format("A load of {:.3g} kg was assumed.\n", plan.sizes.payload_kg);
  for (const auto other : plan.others)
    out += fmt::format("Part of it would also be told by: {}.\n", contrast_words(other));
  return out;
}

std::string numbers_text(const PosePlan& plan) {
  TextTable table({"1 sigma of its numbers", "before", "after", ""});
  table.left_from(3);
  for (std::size_t i = 0; i < std::min(kNumbersShown, plan.numbers.size()); ++i) {
    const auto& n = plan.numbers[i];
    table.add({n.name, n.before ? fmt::format("{:.3g}", *n.before) : "unknown",
               fmt::format("{:.3g}", n.after), n.unit});
  }
  std::string out = table.text();
  if (plan.numbers.size() > kNumbersShown)
    out += fmt::format("  and {} more\n", plan.numbers.size() - kNumbersShown);
  return out;
}

std::string apart_text(const PlanRequest& request, const PosePlan& plan) {
  TextTable table({"share of its motion that the other imitates", request.separate[0].name,
                   request.separate[1].name});
  const auto share = [](const std::optional<double>& s) {
    return s ? fmt::format("{:.0f} %", 100.0 * *s) : std::string("not shown");
  };
  const auto row = [&](const std::string& name, const Reproduction& r) {
    table.add({name, share(r.a_by_b), share(r.b_by_a)});
  };
  if (plan.measured > 0) row(fmt::format("with the {} measured", plan.measured), plan.apart_before);
  row(plan.measured > 0 ? "and these" : "with these", plan.apart_after);
  std::string out = table.text() + "\n" + numbers_text(plan);
  const auto& after = plan.apart_after;
  if (std::min(after.a_by_b.value_or(0.0), after.b_by_a.value_or(0.0)) > kConfounded)
    out += "\nThey stay confounded: no poses of this arm tell them apart.\n";
  return out;
}

}  // namespace

std::string plan_csv(const Cell& cell, const PlanRequest& request, const PosePlan& plan) {
  std::string out = "# plan: " +
                    (request.separate.empty() ? std::string("poses that tell most about the arm")
                                              : "to tell apart " + pair_words(request)) +
                    "; measure in this order\n" + header(cell, plan);
  for (const auto& pose : plan.poses) {
    out += pose.name;
    for (int j = 0; j < cell.joints(); ++j)
      out += fmt::format(
          ",{:.4f}", shown(pose.q(j), slides(cell.nominal.joints[static_cast<std::size_t>(j)])));
    const Vector3 p = nominal_point(cell, pose.q);
    for (int k = 0; k < 3; ++k) out += fmt::format(",{:.3f}", to_mm(p(k)));
    for (int j = 0; sides(plan) && j < cell.joints(); ++j) out += pose.second ? ",-1" : ",1";
    if (payloads(plan)) out += fmt::format(",{:g}", pose.second ? plan.sizes.payload_kg : 0.0);
    out += pose.note.find(',') == std::string::npos ? "," + pose.note : ",\"" + pose.note + "\"";
    out += "\n";
  }
  return out;
}

Json plan_json(const Cell& cell, const PlanRequest& request, const PosePlan& plan) {
  Json out{{"n", plan.poses.size()},
           {"measured", plan.measured},
           {"pool", plan.pool},
           {"parameters", plan.parameters},
           {"sigma_um", plan.sigma_m * 1e6}};
  out["ln_det_gain"] = plan.ln_det;
  if (request.separate.empty()) {
    if (plan.measured > 0)
      out["before"] = sigma_json(plan.before);
    else
      put_null(out, "before", "nothing is measured yet");
    out["after"] = sigma_json(plan.after);
  } else {
    out["separate"] = Json::array({request.separate[0].name, request.separate[1].name});
    out["contrast"] = contrast_name(plan.contrast);
    out["contrast_text"] = contrast_words(plan.contrast);
    out["reproduction_before"] = reproduction_json(plan.apart_before);
    out["reproduction_after"] = reproduction_json(plan.apart_after);
    out["numbers"] = numbers_json(plan);
  }
  out["poses"] = Json::array();
  for (const auto& pose : plan.poses) {
    Json row{{"pose", pose.name}};
    for (int j = 0; j < cell.joints(); ++j) {
      const bool slide = slides(cell.nominal.joints[static_cast<std::size_t>(j)]);
      row[fmt::format("q{}_{}", j + 1, unit(slide))] = shown(pose.q(j), slide);
    }
    if (!pose.note.empty()) row["note"] = pose.note;
    out["poses"].push_back(std::move(row));
  }
  return out;
}

std::string plan_text(const PlanRequest& request, const PosePlan& plan) {
  std::string out;
  if (request.separate.empty()) {
    out = fmt::format(
        "Planned {} poses, chosen from {} random ones so that they tell most about the "
        "{} parameters.\n\n",
        plan.poses.size(), plan.pool, plan.parameters);
  } else {
    out = fmt::format("Planned {} measurements to tell {} apart.\n", plan.poses.size(),
                      pair_words(request)) +
          contrast_text(plan) + "\n" + apart_text(request, plan);
    return out;
  }
  return out + prediction_text(plan);
}

}  // namespace plumb::offline::show
