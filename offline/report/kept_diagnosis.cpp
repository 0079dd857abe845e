// SPDX-License-Identifier: Apache-2.0
#include "report/kept_diagnosis.hpp"

#include "plumb/format/version.hpp"
#include "program/file.hpp"
#include "program/json.hpp"

namespace plumb::offline::report {
namespace {

constexpr const char* kSchema = "diagnosis/2";

std::filesystem::path kept_file(const Run& run) { return run.directory / "diagnosis.json"; }

Json stats_to(const ErrorStats& s) { return {s.n, s.mean, s.rms, s.p95, s.max}; }
ErrorStats stats_of(const Json& j) {
  return {.n = j.at(0), .mean = j.at(1), .rms = j.at(2), .p95 = j.at(3), .max = j.at(4)};
}

Json entry_to(const EffectEntry& entry) {
  Json options = Json::object();
  for (const auto& [key, value] : entry.options)
    std::visit([&, &name = key](const auto& v) { options[name] = v; }, value);
  return {{"name", entry.name}, {"joints", entry.joints}, {"options", options}};
}

EffectEntry::Value option_of(const Json& j) {
  if (j.is_boolean()) return j.get<bool>();
  if (j.is_string()) return j.get<std::string>();
  if (j.is_array()) return j.get<std::vector<std::string>>();
  return j.get<double>();
}

EffectEntry entry_of(const Json& j) {
  EffectEntry out{.name = j.at("name"), .joints = j.at("joints"), .options = {}, .place = {}};
  for (const auto& [key, value] : j.at("options").items()) out.options[key] = option_of(value);
  return out;
}

Json candidate_to(const Candidate& c) {
  Json out{{"entry", entry_to(c.entry)},  {"title", c.title},
           {"domain", c.domain},          {"ln_bayes", c.ln_bayes},
           {"gain", {c.gain, c.gain_se}}, {"alone", stats_to(c.alone)},
           {"after", stats_to(c.after)},  {"cycles", c.cycles},
           {"supported", c.supported},    {"plausible", c.plausible},
           {"explained", c.explained},    {"absorbed", c.absorbed},
           {"largest_m", c.largest_m},    {"confounded_with", c.confounded_with},
           {"separate", c.separate}};
  if (!c.peaks.empty()) out["peaks"] = c.peaks;
  for (const Move& move : c.moves) out["moves"].push_back({move.after_row, move.size_m});
  return out;
}

Candidate candidate_of(const Json& j) {
  Candidate out;
  out.entry = entry_of(j.at("entry"));
  out.title = j.at("title");
  out.domain = j.at("domain");
  out.ln_bayes = j.at("ln_bayes");
  out.gain = j.at("gain").at(0);
  out.gain_se = j.at("gain").at(1);
  out.alone = stats_of(j.at("alone"));
  out.after = stats_of(j.at("after"));
  out.cycles = j.at("cycles").get<std::vector<double>>();
  out.supported = j.at("supported");
  out.plausible = j.at("plausible");
  out.explained = j.at("explained");
  out.absorbed = j.at("absorbed");
  out.largest_m = j.at("largest_m");
  out.confounded_with = j.at("confounded_with").get<std::vector<std::string>>();
  out.separate = j.at("separate");
  out.peaks = j.value("peaks", "");
  for (const Json& move : j.value("moves", Json::array()))
    out.moves.push_back({.after_row = move.at(0), .size_m = move.at(1)});
  return out;
}

Json alternative_to(const Alternative& a) {
  return {{"entry", entry_to(a.entry)}, {"cycles", a.cycles},     {"domain", a.domain},
          {"behind", a.behind_nats},    {"compiled", a.compiled}, {"not_shown", a.not_shown},
          {"measure", a.measure}};
}

Alternative alternative_of(const Json& j) {
  return {.entry = entry_of(j.at("entry")),
          .cycles = j.at("cycles"),
          .domain = j.at("domain"),
          .behind_nats = j.at("behind"),
          .compiled = j.at("compiled"),
          .not_shown = j.at("not_shown"),
          .measure = j.at("measure")};
}

Json unknown_to(const UnknownStructure& u) {
  return {{"subject", u.pattern.subject},
          {"words", u.pattern.words},
          {"depends_on", u.pattern.depends_on},
          {"size", {u.share, u.rms_m, u.rms_rad}}};
}

UnknownStructure unknown_of(const Json& j) {
  UnknownStructure out;
  out.pattern.subject = j.at("subject");
  out.pattern.words = j.at("words");
  out.pattern.depends_on = j.at("depends_on").get<std::vector<std::string>>();
  out.share = j.at("size").at(0);
  out.rms_m = j.at("size").at(1);
  out.rms_rad = j.at("size").at(2);
  return out;
}

Json found_to(const Diagnosis& d) {
  Json out{{"finding", static_cast<int>(d.finding)},
           {"text", d.text},
           {"floor", {d.floor.sigma_m, d.floor.mean_m, d.floor.rms_m}},
           {"floor_dof", d.floor.dof},
           {"floor_source", static_cast<int>(d.floor.source)},
           {"floor_inferred_m", d.floor.inferred_m},
           {"poses", {d.poses_fit, d.poses_held, d.poses_choosing}},
           {"nested", d.nested},
           {"folds", d.folds},
           {"before", stats_to(d.before)},
           {"after", stats_to(d.after)},
           {"alternatives", Json::array()},
           {"candidates", Json::array()},
           {"not_testable", Json::array()},
           {"outliers", d.outliers}};
  if (d.tied) out["tied"] = entry_to(*d.tied);
  if (d.gravity)
    out["gravity"] = {d.gravity->stated, d.gravity->found, d.gravity->nats_ahead,
                      d.gravity->certain};
  if (d.slow_motion) out["slow_motion"] = unknown_to(*d.slow_motion);
  for (const auto& a : d.alternatives) out["alternatives"].push_back(alternative_to(a));
  for (const auto& c : d.candidates) out["candidates"].push_back(candidate_to(c));
  for (const auto& t : d.not_testable)
    out["not_testable"].push_back({static_cast<int>(t.answer), t.effect, t.why, t.measure});
  return out;
}

Diagnosis found_of(const Json& j) {
  Diagnosis d;
  d.finding = static_cast<Finding>(j.at("finding").get<int>());
  d.text = j.at("text");
  const Json& floor = j.at("floor");
  d.floor = {.sigma_m = floor.at(0),
             .mean_m = floor.at(1),
             .rms_m = floor.at(2),
             .dof = j.at("floor_dof"),
             .source = static_cast<NoiseFloor::Source>(j.at("floor_source").get<int>()),
             .inferred_m = j.value("floor_inferred_m", 0.0)};
  d.poses_fit = j.at("poses").at(0);
  d.poses_held = j.at("poses").at(1);
  d.poses_choosing = j.at("poses").at(2);
  d.nested = j.at("nested");
  d.folds = j.at("folds");
  d.before = stats_of(j.at("before"));
  d.after = stats_of(j.at("after"));
  if (j.contains("tied")) d.tied = entry_of(j.at("tied"));
  if (j.contains("gravity")) {
    const Json& gravity = j.at("gravity");
    d.gravity = {.stated = gravity.at(0),
                 .found = gravity.at(1),
                 .nats_ahead = gravity.at(2),
                 .certain = gravity.at(3)};
  }
  if (j.contains("slow_motion")) d.slow_motion = unknown_of(j.at("slow_motion"));
  for (const auto& a : j.at("alternatives")) d.alternatives.push_back(alternative_of(a));
  for (const auto& c : j.at("candidates")) d.candidates.push_back(candidate_of(c));
  for (const auto& t : j.at("not_testable"))
    d.not_testable.push_back({.answer = static_cast<Testable::Answer>(t.at(0).get<int>()),
                              .effect = t.at(1),
                              .why = t.at(2),
                              .measure = t.at(3)});
  d.outliers = j.at("outliers").get<std::vector<std::string>>();
  return d;
}

}  // namespace

void keep_diagnosis(const Run& run, const Diagnosis& found) {
  if (run.number <= 0) return;
  const std::string text = to_text(found_to(found));
  const Json file{{"schema", kSchema},
                  {"version", format::kVersion},
                  {"cell_sha256", run.cell_sha256},
                  {"sha256", sha256(text)},
                  {"found", Json::parse(text)}};
  try {
    write_file_atomically(kept_file(run), to_text(file));
  } catch (const Failure&) {
    return;  // it only saves time
  }
}

std::optional<Diagnosis> kept_diagnosis(const Run& run) {
  if (run.number <= 0 || !std::filesystem::exists(kept_file(run))) return std::nullopt;
  try {
    const Json file = Json::parse(read_file(kept_file(run)));
    if (file.at("schema") != kSchema || file.at("version") != format::kVersion ||
        file.at("cell_sha256") != run.cell_sha256 ||
        file.at("sha256") != sha256(to_text(file.at("found"))))
      return std::nullopt;
    return found_of(file.at("found"));
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  } catch (const Failure&) {
    return std::nullopt;
  }
}

}  // namespace plumb::offline::report
