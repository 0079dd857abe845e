// SPDX-License-Identifier: Apache-2.0
#include "rt/rt_config.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rt/bus_kinds.hpp"
#include "rt/can_source.hpp"
#include "rt/screen_units.hpp"
#include "rt/utc.hpp"
#include "rt/whole_number.hpp"

namespace plumb::drivers::rt {
namespace {

void read_positive(TomlTable& table, const char* key, double unit, double& out) {
  if (const auto value = table.positive(key)) out = *value * unit;
}

void read_number_of(TomlTable& table, const char* key, std::optional<std::uint8_t>& out) {
  int value = -1;
  read_whole(table, key, {0, 255}, value);
  if (value >= 0) out = static_cast<std::uint8_t>(value);
}

std::filesystem::path in(const std::filesystem::path& folder, const std::string& file) {
  return file.empty() ? std::filesystem::path{} : folder / file;
}

void read_model(TomlTable table, const std::filesystem::path& folder, RtConfig& out) {
  out.model = in(folder, table.text_or("file", "robot.plumb"));
  out.serial = table.text_or("serial", "");
  out.made = table.text_or("made", "");
  if (!out.made.empty() && !is_utc_second(out.made))
    table.out_of_range("made", "a time in UTC, such as 2026-11-25T15:00:00Z");
  table.done();
}

void read_cycle(TomlTable table, RtConfig& out) {
  read_whole(table, "cycle_us", {100, 1'000'000}, out.cycle_us);
  read_whole(table, "priority", {0, 99}, out.priority);
  read_whole(table, "cpu", {-1, 1023}, out.cpu);
  if (const auto seconds = table.not_negative("give_up_s")) out.give_up_s = *seconds;
  table.done();
}

std::shared_ptr<const BusSource> read_source(TomlTable table, const std::filesystem::path& folder) {
  std::vector<std::string> words;
  for (const BusKind& kind : bus_kinds()) words.emplace_back(kind.word);
  const std::string word = table.choice("kind", words);
  const auto kind = std::find_if(bus_kinds().begin(), bus_kinds().end(),
                                 [&](const BusKind& one) { return one.word == word; });
  auto out = kind->read(table, folder);
  table.done();
  return out;
}

SinkConfig read_sink(TomlTable table, const std::filesystem::path& folder) {
  SinkConfig out;
  if (table.choice("kind", {"same", "csv"}) == "csv") {
    out.kind = SinkConfig::Kind::kCsv;
    out.file = in(folder, table.text_or("file", ""));
    if (out.file.empty()) table.missing("file", "file = \"corrected.csv\"");
  }
  table.done();
  return out;
}

void read_limits(TomlTable table, SessionSettings& out, Ceilings& ceilings) {
  read_ceilings(table, ceilings);
  const std::string mode = table.choice("mode", {"shadow", "limited", "full"});
  out.mode = mode == "full"      ? CorrectionMode::kFull
             : mode == "limited" ? CorrectionMode::kLimited
                                 : CorrectionMode::kShadow;
  read_positive(table, "target_speed_mm_s", kMilli, out.target.speed_m_s);
  read_positive(table, "target_speed_deg_s", kDegree, out.target.speed_rad_s);
  read_positive(table, "target_step_mm", kMilli, out.target.step_m);
  read_positive(table, "target_step_deg", kDegree, out.target.step_rad);
  read_positive(table, "limited_mm", kMilli, out.share.limited_m);
  read_positive(table, "limited_scale", 1.0, out.share.limited_scale);
  read_positive(table, "arm_distance_mm", kMilli, out.arm.distance_m);
  read_positive(table, "arm_distance_deg", kDegree, out.arm.angle_rad);
  read_positive(table, "arm_lag_s", 1.0, out.arm.lag_s);
  if (out.share.limited_scale > 1.0)
    table.out_of_range("limited_scale", "greater than 0, 1 at most");
  table.done();
}

void read_expect(TomlTable table, InputSettings& out) {
  read_number_of(table, "tool", out.tool);
  read_number_of(table, "frame", out.frame);
  read_number_of(table, "payload", out.payload);
  table.done();
}

/// Wider limits of comparison would not see another tool, frame or arm, which is what the
/// comparison is for. A controller that shows poses in steps of 0.1 mm needs 100 um.
constexpr double kMostSync_um = 500.0, kMostSync_urad = 1000.0;

void read_sync_limit(TomlTable& table, const char* key, double most, double& out) {
  const auto value = table.positive(key);
  if (!value) return;
  out = *value * kMicro;
  if (*value > most)
    table.out_of_range(key, fmt::format("greater than 0, {:g} at most: beyond it another tool, "
                                        "frame or arm would pass as the nominal one",
                                        most));
}

void read_sync(TomlTable table, SyncSettings& out) {
  read_whole(table, "poses", {1, 100'000}, out.poses);
  read_sync_limit(table, "position_um", kMostSync_um, out.position_m);
  read_sync_limit(table, "rotation_urad", kMostSync_urad, out.rotation_rad);
  read_whole(table, "distinct", {1, kMostDistinct}, out.distinct);
  read_positive(table, "silence_s", 1.0, out.silence_s);
  table.done();
}

constexpr int kMostRecord_mb = 1'000'000;

void read_seconds(TomlTable& table, const char* key, double most, double& out) {
  const auto value = table.positive(key);
  if (!value) return;
  out = *value;
  if (*value > most)
    table.out_of_range(key,
                       fmt::format("greater than 0, {:g} at most: it is kept in memory", most));
}

void read_record(TomlTable table, RecordSettings& out) {
  read_whole(table, "max_file_mb", {1, 10'000}, out.max_file_mb);
  read_whole(table, "max_total_mb", {0, kMostRecord_mb}, out.max_total_mb);
  read_whole(table, "max_age_days", {0, 36'500}, out.max_age_days);
  read_whole(table, "free_space_floor_mb", {0, kMostRecord_mb}, out.free_space_floor_mb);
  read_whole(table, "snapshots", {0, 1000}, out.snapshots);
  read_seconds(table, "before_s", 60.0, out.before_s);
  read_seconds(table, "after_s", 60.0, out.after_s);
  table.done();
}

void read_log(TomlTable table, const std::filesystem::path& folder, RtConfig& out) {
  out.record.file = in(folder, table.text_or("record", ""));
  // The older name of [record] max_total_mb, in the rt.toml of folders that were deployed before.
  read_whole(table, "record_max_mb", {0, kMostRecord_mb}, out.record.max_total_mb);
  out.events = in(folder, table.text_or("events", ""));
  read_whole(table, "metrics_port", {0, 65535}, out.metrics_port);
  table.done();
}

}  // namespace

std::vector<std::filesystem::path> written_files(const RtConfig& config) {
  return {config.record.file, config.sink.file, config.events};
}

RtConfig read_rt_config(TomlTable& top, const std::filesystem::path& folder,
                        const std::filesystem::path& written) {
  const std::filesystem::path& outputs = written.empty() ? folder : written;
  RtConfig out;
  out.model = folder / out.model;
  out.source = std::make_shared<CanSource>();
  if (!top.text("schema")) top.missing("schema", "schema = \"rt/1\"");
  top.choice("schema", {"rt/1"});
  if (auto table = top.table("model")) read_model(*table, folder, out);
  if (auto table = top.table("cycle")) read_cycle(*table, out);
  if (auto table = top.table("source")) out.source = read_source(*table, folder);
  if (auto table = top.table("sink")) out.sink = read_sink(*table, outputs);
  if (auto table = top.table("limits")) read_limits(*table, out.session, out.ceilings);
  if (auto table = top.table("expect")) read_expect(*table, out.session.inputs);
  if (auto table = top.table("sync")) read_sync(*table, out.session.sync);
  if (auto table = top.table("log")) read_log(*table, outputs, out);
  if (auto table = top.table("record")) read_record(*table, out.record);
  return out;
}

}  // namespace plumb::drivers::rt
