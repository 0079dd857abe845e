// SPDX-License-Identifier: Apache-2.0
#include "rt/deployment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bus_text/layout_toml.hpp"
#include "bus_text/reach.hpp"
#include "plumb/drivers/bus_content.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/shell_word.hpp"
#include "program/sums_signature.hpp"
#include "rt/check_sums.hpp"
#include "rt/place.hpp"

namespace plumb::drivers::rt {
namespace {

void complete(Deployment& out) {
  SessionSettings& session = out.session = out.config.session;
  const double cycle_s = 1e-6 * out.config.cycle_us;
  session.robot = fingerprint(out.model.loaded->model().serial);
  session.form = out.config.sink.kind == SinkConfig::Kind::kCsv ? CorrectionForm::kPose
                                                                : out.layout.correction;
  session.sensors = sensor_places(out.layout, out.model.loaded->model());
  session.target.period_s = cycle_s;
  if (const auto* target = out.layout.find(MessageKind::kTarget))
    session.target.period_s = target->period_s;
  session.cycle_s = cycle_s;
  if (!out.config.source->has_robot()) {  // a row of the file stands for the arm until it is synced
    session.sync.distinct = 1;
    session.arm.lag_s = std::numeric_limits<double>::infinity();
  }
  session.answer_s = std::max(session.answer_s, 3.0 * cycle_s);
  if (const auto* status = out.layout.find(MessageKind::kStatus))
    session.status_s = status->period_s;
  if (const auto* signature = out.layout.find(MessageKind::kSignature))
    session.signature_s = signature->period_s;
}

/// If a trusted key signed a folder, everything in it must be what was signed.
void refuse_unlisted(const std::filesystem::path& folder, const std::string& sums,
                     const Origin& origin, Beside beside,
                     const std::vector<std::filesystem::path>& written) {
  if (!origin.key.empty() || beside == Beside::kNothing)
    check_content(folder, sums, beside, written);
}

/// The version of the place that this folder is; empty if it is none.
std::string version_in(const std::filesystem::path& folder, const std::filesystem::path& place) {
  std::error_code error;
  const auto real = std::filesystem::canonical(folder, error);
  const auto versions = std::filesystem::canonical(InstallPlace{place}.versions(), error);
  const std::string name = real.filename().string();
  return !error && real.parent_path() == versions && is_version_id(name) ? name : "";
}

}  // namespace

std::vector<LayoutFault> find_short_reach(const Deployment& deployment, const LoadedModel& model) {
  if (deployment.config.source->use() != BusUse::kCan) return {};
  return drivers::find_short_reach(deployment.layout, model.model().nominal,
                                   model.limits().max_correction_m, "bus");
}

bool sensors_come(const Deployment& deployment, const LoadedModel& model) {
  const SensorPlaces own = sensor_places(deployment.layout, model.model());
  const SensorPlaces& told = deployment.session.sensors;
  return std::equal(own.begin(), own.end(), told.begin(),
                    [](int wanted, int there) { return wanted < 0 || wanted == there; });
}

BusLayout record_layout(const Deployment& deployment) {
  BusLayout out = deployment.layout;
  if (deployment.config.source->use() != BusUse::kCan) out.can_format = CanFrame::Format::kFd;
  return out;
}

void refuse_wider(const std::filesystem::path& file, const LoadedModel& model,
                  const Ceilings& ceilings, const std::filesystem::path& folder) {
  std::vector<Problem> problems;
  for (const WiderLimit& wider : wider_limits(model.limits(), ceilings))
    problems.push_back(
        {.severity = Severity::kError,
         .code = "E-RT-CEILING",
         .message = fmt::format("{} allows {}", display_name(file), wider.text()),
         .help = fmt::format("if that is meant: {} = {:.4g} in rt.toml, then: plumb-rt seal {}",
                             wider.key, wider.model, shell_word(display_name(folder)))});
  if (!problems.empty()) throw Failure(Exit::kInput, std::move(problems));
}

Deployment load_deployment(const std::filesystem::path& folder, Sums sums,
                           const SigningRules* rules) {
  Deployment out;
  out.folder = folder;
  const Content content = find_content(folder);
  out.content = content.folder;
  const std::filesystem::path file = out.content / "rt.toml";
  // Nothing is parsed that is not what the sums list, nor, where signatures are demanded, what was
  // signed.
  const std::string text = read_regular_file(file, kMostCellBytes);
  Origin origin;
  if (sums == Sums::kVerified) {
    out.sums = sums_text(out.content);
    if (rules != nullptr) origin = find_origin(out.content, out.sums, *rules);
    refuse_other(out.content, out.sums, file, sha256(text));
  }
  TomlSource source(display_name(file), text, "E-RT");
  const toml::table parsed = source.parse();
  TomlTable top(parsed, "", source);
  out.config = read_rt_config(top, out.content, folder);
  auto bus = top.table("bus");
  top.done();
  source.stop_on_errors();
  if (sums == Sums::kVerified) verify_sums(out.content, out.sums, {file, out.config.model});
  if (sums == Sums::kVerified && rules != nullptr) {
    out.etc = rules->etc;
    out.demands_signatures = rules->demanded();
    const Beside beside = content.version.empty() ? Beside::kRunFiles : Beside::kNothing;
    refuse_unlisted(out.content, out.sums, origin, beside, written_files(out.config));
  }
  out.model = load_model(out.config.model, out.config.serial);
  if (sums == Sums::kVerified)
    refuse_other(out.content, out.sums, out.config.model, out.model.sha256);
  out.model.origin = std::move(origin);
  out.model.version = content.version;
  refuse_wider(out.config.model, *out.model.loaded, out.config.ceilings, folder);
  const BusArm arm = bus_arm(out.model.loaded->model().nominal, 1e-6 * out.config.cycle_us);
  const toml::table nothing;
  TomlTable absent(nothing, "bus", source);
  TomlTable& table = bus ? *bus : absent;
  out.layout = read_bus(table, arm, out.config.source->use(), MissingOwner::kNone);
  source.stop_on_errors();
  for (const LayoutFault& fault : find_short_reach(out, *out.model.loaded))
    report_fault(table, fault);
  source.stop_on_errors();
  complete(out);
  return out;
}

RunningModel load_next_model(const NextModel& next) {
  const SigningRules rules = read_signing_rules(next.etc);
  const std::filesystem::path folder = std::filesystem::absolute(next.file).parent_path();
  const std::string version = next.place.empty() ? "" : version_in(folder, next.place);
  if (!next.place.empty() && version.empty())
    throw Failure(Exit::kInput,
                  {.code = "E-RT-SWAP",
                   .message = fmt::format("what runs is a place, and {} is in none of its versions",
                                          display_name(next.file)),
                   .help = "plumb-rt install DIR --to " + shell_word(display_name(next.place))});
  RunningModel out = load_model(next.file, next.serial);
  if (version.empty() && !rules.demanded()) {
    out.origin.note = rules.unsigned_note();
    return out;
  }
  std::error_code ignored;
  const bool listed = std::filesystem::exists(folder / kSumsFile, ignored);
  const std::string sums = listed ? sums_text(folder) : "";
  out.origin = find_origin(folder, sums, rules);
  refuse_unlisted(folder, sums, out.origin, version.empty() ? Beside::kRunFiles : Beside::kNothing,
                  next.written);
  out.version = version;
  if (out.origin.key.empty() && version.empty()) return out;
  verify_sums(folder, sums, {next.file});
  refuse_other(folder, sums, next.file, out.sha256);
  return out;
}

}  // namespace plumb::drivers::rt
