// SPDX-License-Identifier: Apache-2.0
#include "show/plan_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cell/joint_columns.hpp"
#include "plumb/runtime/chain.hpp"
#include "program/counted_words.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

constexpr std::size_t kNumbersShown = 12;
constexpr double kMostPoses = 1000.0;  // more are not suggested

Vector3 nominal_point(const Cell& cell, const Eigen::VectorXd& q) {
  ChainFrames frames;
  Chain(cell.nominal).frames({q.data(), static_cast<std::size_t>(q.size())}, frames);
  return frames.tip.p;
}

bool arrives(const PosePlan& plan) { return plan.circumstances.approach; }
bool loaded(const PosePlan& plan) { return plan.circumstances.two_payloads(); }

/// Whether the loads differ in their centre of mass as well, which the file must then state.
bool centres(const PosePlan& plan) {
  const auto& loads = plan.circumstances.payloads;
  return loaded(plan) && std::any_of(loads.begin(), loads.end(), [&](const Payload& load) {
           return load.com_m != loads.front().com_m;
         });
}

std::string header(const Cell& cell, const PosePlan& plan) {
  std::string out = "pose";
  const auto joint_unit = [&](int j) {
    return unit(slides(cell.nominal.joints[static_cast<std::size_t>(j)]));
  };
  for (int j = 0; j < cell.joints(); ++j) out += fmt::format(",q{}_{}", j + 1, joint_unit(j));
  out += ",nx_mm,ny_mm,nz_mm";
  for (int j = 0; arrives(plan) && j < cell.joints(); ++j)
    out += fmt::format(",dir_j{0},travel_j{0}_{1}", j + 1, joint_unit(j));
  if (loaded(plan)) out += ",payload_kg";
  if (centres(plan)) out += ",payload_cx_mm,payload_cy_mm,payload_cz_mm";
  return out + ",note\n";
}

std::string how_columns(const Cell& cell, const PosePlan& plan, const ReadingOption& how) {
  std::string out;
  for (int j = 0; arrives(plan) && j < cell.joints(); ++j) {
    const bool slide = slides(cell.nominal.joints[static_cast<std::size_t>(j)]);
    const double move = how.approach(j);
    out += fmt::format(",{},{:.4f}", move < 0.0 ? -1 : 1, shown(std::abs(move), slide));
  }
  if (loaded(plan)) {
    const Payload& load = plan.circumstances.payloads[static_cast<std::size_t>(how.payload)];
    out += fmt::format(",{:g}", load.mass_kg);
    for (std::size_t k = 0; centres(plan) && k < 3; ++k)
      out += fmt::format(",{:.3f}", to_mm(load.com_m[k]));
  }
  return out;
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

Json expected_json(const ExpectedDecision& expected) {
  Json out;
  if (expected.today)
    out["today_nats"] = *expected.today;
  else
    put_null(out, "today_nats", "nothing is measured yet");
  out["if_first_nats"] = expected.if_a;
  out["if_second_nats"] = expected.if_b;
  out["decided_already"] = expected.decided_already();
  out["decides"] = expected.least() >= kDecided_nats;
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

Blocks prediction_blocks(const PosePlan& plan) {
  Table table{.name = "prediction",
              .caption = "How well the fitted numbers predict a point",
              .head = {"1 sigma of a predicted point (3-D) [mm]", "mean", "worst"}};
  const auto row = [&](const std::string& name, const PredictionSigma& s) {
    table.add({name, mm(s.mean), mm(s.worst)});
  };
  if (plan.measured > 0) row(fmt::format("with the {} measured", plan.measured), plan.before);
  row(fmt::format("{}these {}", plan.measured > 0 ? "and " : "with ", plan.poses.size()),
      plan.after);
  Blocks out{std::move(table),
             Sentence{"That comes from the uncertainty of the fitted numbers alone; the error of "
                      "what the model lacks is added to it."}};
  if (plan.measured > 0)
    out.emplace_back(Sentence{fmt::format("The worst falls by {:.0f} %, the mean by {:.0f} %.",
                                          100.0 * (1.0 - plan.after.worst / plan.before.worst),
                                          100.0 * (1.0 - plan.after.mean / plan.before.mean))});
  if (plan.measured > 0 && plan.before.worst < plan.sigma_m)
    out.emplace_back(Sentence{
        "Measuring them changes little: the fitted numbers already predict a point better than "
        "one reading of the tracker."});
  return out;
}

/// By what the two are told apart, a sentence each.
Blocks contrast_blocks(const PosePlan& plan) {
  const auto contrasts = plan.circumstances.contrasts();
  if (contrasts.empty()) return {Sentence{"They are told apart by poses alone."}};
  std::vector<std::string> words;
  for (const auto contrast : contrasts) words.push_back(contrast_words(contrast));
  Blocks out{Sentence{fmt::format("They are told apart by {}.", fmt::join(words, "; "))}};
  if (loaded(plan)) {
    std::vector<std::string> kg;
    for (const auto& load : plan.circumstances.payloads)
      kg.push_back(fmt::format("{:.4g} kg", load.mass_kg));
    out.emplace_back(
        Sentence{fmt::format("Loads: {}; others: --payload 0,10.", fmt::join(kg, " and "))});
  }
  if (arrives(plan))
    out.emplace_back(
        Sentence{"Columns dir_jN and travel_jN: the last move of joint N, its side and size; start "
                 "it at qN less the one times the other."});
  return out;
}

/// How many poses like these would decide, if their evidence grows in proportion; 0: too many.
int poses_that_decide(const PosePlan& plan) {
  const double n = static_cast<double>(plan.poses.size());
  const double each = (plan.expected.least() - 1.0) / n;
  const double wanted = each > 0.0 ? kDecided_nats / each : 1e9;
  return wanted > kMostPoses ? 0 : static_cast<int>(10.0 * std::ceil(wanted / 10.0));
}

/// What the poses measured say already; empty: they cannot tell.
std::string decided_words(const PlanRequest& request, const PosePlan& plan) {
  if (!plan.expected.decided_already()) return {};
  const std::string &a = request.separate[0].name, &b = request.separate[1].name;
  const double lead = *plan.expected.today;
  return fmt::format(
      "Decided already: {} is ahead of {} by {:.0f} nats at the {} measured (ln of a Bayes factor; "
      "10 decide). To tell them apart nothing more need be measured.",
      lead < 0.0 ? b : a, lead < 0.0 ? a : b, std::abs(lead),
      counted_words(plan.measured, "pose", "poses"));
}

/// What the readings will say, or that they will not.
Blocks expected_blocks(const PlanRequest& request, const PosePlan& plan) {
  const std::string &a = request.separate[0].name, &b = request.separate[1].name;
  const auto& expected = plan.expected;
  const std::string today =
      expected.today ? fmt::format(" Today {} is ahead by {:.0f}.", *expected.today < 0.0 ? b : a,
                                   std::abs(*expected.today))
                     : " Nothing is measured yet, so both are taken to have their typical size.";
  const std::string these =
      plan.poses.size() == 1 ? "This reading" : fmt::format("These {} readings", plan.poses.size());
  if (expected.least() >= kDecided_nats)
    return {Sentence{fmt::format(
        "{} {} expected to decide between {} and {}: the wrong one would then be "
        "behind by about {:.0f} nats (ln of a Bayes factor; 10 decide) if {} is true, by {:.0f} if "
        "{} is.{}",
        these, plan.poses.size() == 1 ? "is" : "are", a, b, expected.if_a, a, expected.if_b, b,
        today)}};
  const Sentence cannot{fmt::format(
      "{} cannot decide between {} and {}: the true one is expected to be ahead by "
      "only {:.1f} nats (ln of a Bayes factor; 10 decide) if it is {}, by {:.1f} if it is {}.{}",
      these, a, b, expected.if_a, a, expected.if_b, b, today)};
  std::vector<std::string> could;
  if (plan.circumstances.load_matters && !loaded(plan))
    could.push_back("a second payload (--payload 0,10)");
  if (request.rules.joint_share < 1.0 || !request.rules.boxes.empty())
    could.push_back("a larger range (--joint-limits, --box)");
  if (const int n = poses_that_decide(plan); n > 0)
    could.push_back(fmt::format("more readings: about {} (--n)", n));
  return {cannot, Sentence{could.empty() ? "More poses of this kind would not help either."
                                         : fmt::format("What could: {}.", fmt::join(could, "; "))}};
}

Blocks numbers_blocks(const PosePlan& plan) {
  Table table{.name = "numbers",
              .caption = "How well the two are known",
              .head = {"1 sigma of its numbers", "before", "after", ""},
              .left_from = 3};
  for (std::size_t i = 0; i < std::min(kNumbersShown, plan.numbers.size()); ++i) {
    const auto& n = plan.numbers[i];
    table.add({n.name, n.before ? fmt::format("{:.3g}", *n.before) : "unknown",
               fmt::format("{:.3g}", n.after), n.unit});
  }
  Blocks out{std::move(table)};
  if (plan.numbers.size() > kNumbersShown)
    out.emplace_back(under(fmt::format("and {} more", plan.numbers.size() - kNumbersShown)));
  return out;
}

Table apart_table(const PlanRequest& request, const PosePlan& plan) {
  Table table{.name = "apart",
              .caption = "How much of one the other imitates",
              .head = {"share of its motion that the other imitates", request.separate[0].name,
                       request.separate[1].name}};
  const auto share = [](const std::optional<double>& s) {
    return s ? fmt::format("{:.0f} %", 100.0 * *s) : std::string("not shown");
  };
  const auto row = [&](const std::string& name, const Reproduction& r) {
    table.add({name, share(r.a_by_b), share(r.b_by_a)});
  };
  if (plan.measured > 0) row(fmt::format("with the {} measured", plan.measured), plan.apart_before);
  row(plan.measured > 0 ? "and these" : "with these", plan.apart_after);
  return table;
}

Blocks separating_blocks(const PlanRequest& request, const PosePlan& plan) {
  const std::string decided = decided_words(request, plan);
  Blocks out;
  if (!decided.empty()) out.emplace_back(Sentence{decided});
  out.emplace_back(Sentence{fmt::format("Planned {} to tell {} apart.",
                                        counted_words(plan.poses.size(), "reading", "readings"),
                                        pair_words(request))});
  append(out, contrast_blocks(plan));
  if (decided.empty()) append(out, expected_blocks(request, plan));
  out.emplace_back(apart_table(request, plan));
  append(out, numbers_blocks(plan));
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
    const auto q =
        values_at({pose.q.data(), static_cast<std::size_t>(pose.q.size())}, cell.nominal);
    for (std::size_t j = 0; j < q.size(); ++j)
      out += fmt::format(",{:.4f}", shown(q[j], slides(cell.nominal.joints[j])));
    const Vector3 p = nominal_point(cell, pose.q);
    for (int k = 0; k < 3; ++k) out += fmt::format(",{:.3f}", to_mm(p(k)));
    out += how_columns(cell, plan, pose.how);
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
  if (request.separate.empty()) {
    out["ln_det_gain"] = plan.ln_det;
    if (plan.measured > 0)
      out["before"] = sigma_json(plan.before);
    else
      put_null(out, "before", "nothing is measured yet");
    out["after"] = sigma_json(plan.after);
  } else {
    out["separate"] = Json::array({request.separate[0].name, request.separate[1].name});
    const auto contrasts = plan.circumstances.contrasts();
    const Contrast first = contrasts.empty() ? Contrast::kNone : contrasts.front();
    out["contrast"] = contrast_name(first);
    out["contrast_text"] = contrast_words(first);
    out["contrasts"] = Json::array();
    for (const auto contrast : contrasts) out["contrasts"].push_back(contrast_name(contrast));
    out["expected"] = expected_json(plan.expected);
    out["reproduction_before"] = reproduction_json(plan.apart_before);
    out["reproduction_after"] = reproduction_json(plan.apart_after);
    out["numbers"] = numbers_json(plan);
  }
  out["poses"] = Json::array();
  for (const auto& pose : plan.poses) {
    Json row{{"pose", pose.name}};
    const auto q =
        values_at({pose.q.data(), static_cast<std::size_t>(pose.q.size())}, cell.nominal);
    for (int j = 0; j < cell.joints(); ++j) {
      const bool slide = slides(cell.nominal.joints[static_cast<std::size_t>(j)]);
      row[fmt::format("q{}_{}", j + 1, unit(slide))] = shown(q[static_cast<std::size_t>(j)], slide);
    }
    if (!pose.note.empty()) row["note"] = pose.note;
    out["poses"].push_back(std::move(row));
  }
  return out;
}

Blocks plan_blocks(const PlanRequest& request, const PosePlan& plan) {
  if (!request.separate.empty()) return separating_blocks(request, plan);
  Blocks out{Sentence{
      fmt::format("Planned {}, chosen from {} random ones so that {} most about the {} parameters.",
                  counted_words(plan.poses.size(), "pose", "poses"), plan.pool,
                  plan.poses.size() == 1 ? "it tells" : "they tell", plan.parameters)}};
  append(out, prediction_blocks(plan));
  return out;
}

}  // namespace plumb::offline::show
