// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cell/cell_sections.hpp"

namespace plumb::offline {
namespace {

constexpr double kMostSeed = 9007199254740992.0;  // 2^53: every whole number below is a double

/// True if absent or "fit".
bool says_fit(TomlTable& t, const std::string& key, const std::string& otherwise) {
  const toml::node* node = t.node(key);
  if (node == nullptr) return true;
  if (!node->is_string()) return false;
  if (*node->value<std::string>() != "fit") t.out_of_range(key, "\"fit\" or " + otherwise);
  return true;
}

void read_files(TomlTable& t, CellDraft& draft) {
  auto& files = draft.cell.measurement.files;
  const auto& setups = draft.cell.measurement.setups;
  const bool named =
      !setups.empty() &&
      std::all_of(setups.begin(), setups.end(), [](const Setup& s) { return !s.files.empty(); });
  if (t.node("files") == nullptr && !named)
    files.push_back(draft.cell.directory / "measurements.csv");
  for (const auto& [text, node] : t.texts("files")) {
    const auto file = (draft.cell.directory / text).lexically_normal();
    if (text.empty())
      t.error("E-CELL-RANGE", fmt::format("'{}' names no file", t.name("files")), *node, "empty",
              "files = [\"measurements.csv\"]");
    else if (std::find(files.begin(), files.end(), file) != files.end())
      t.error("E-CELL-RANGE", fmt::format("'{}' names '{}' twice", t.name("files"), text), *node,
              "second one", "delete one: every reading would count double");
    else {
      files.push_back(file);
      draft.cell.measurement.named_at.push_back(t.source().place(node->source(), "named here"));
    }
  }
}

void read_held_out(TomlTable& t, CellDraft& draft) {
  const auto text = t.text("held_out");
  if (!text) return;
  if (auto rule = parse_held_out(*text, draft.cell.directory)) {
    rule->named_at = t.source().place(t.node("held_out")->source(), "named here");
    draft.cell.measurement.held_out = *std::move(rule);
  } else {
    t.error("E-CELL-HELD", fmt::format("'{}' is \"{}\"", t.name("held_out"), *text),
            *t.node("held_out"), "not a rule",
            "write \"auto\", \"20%\", \"kfold:5\", \"column:set\" or \"file:verify.csv\"");
  }
}

void read_seed(TomlTable& t, MeasurementSettings& m) {
  const double seed = t.number_or("seed", 1.0);
  if (seed < 0.0 || seed > kMostSeed || seed != std::floor(seed))
    return t.out_of_range("seed", "a whole number from 0 to 2^53");
  m.seed = static_cast<std::uint64_t>(seed);
}

}  // namespace

void read_measurement(TomlTable& t, CellDraft& draft) {
  MeasurementSettings& m = draft.cell.measurement;
  m.fit_frame = says_fit(t, "frame", "{ xyz, rpy }");
  if (!m.fit_frame)
    if (auto frame = t.table("frame")) m.X_MB = read_pose(*frame, draft);
  m.fit_target = says_fit(t, "target", "[x, y, z]");
  if (!m.fit_target)
    if (const auto target = t.vector3("target"))
      for (int k = 0; k < 3; ++k) m.target_T[k] = draft.length.to_si((*target)[k]);
  if (const auto sigma = t.positive("sigma_um")) m.sigma_m = unit_of("um")->to_si(*sigma);
  if (const auto sigma = t.positive("sigma_urad")) m.sigma_rad = unit_of("urad")->to_si(*sigma);
  if (const auto sigma = t.positive("sigma_touch_um"))
    m.sigma_touch_m = unit_of("um")->to_si(*sigma);
  if (const auto sigma = t.positive("sigma_distance_um"))
    m.sigma_length_m = unit_of("um")->to_si(*sigma);
  read_held_out(t, draft);
  read_seed(t, m);
  read_setups(t, draft);
  read_files(t, draft);
  t.done();
}

}  // namespace plumb::offline
