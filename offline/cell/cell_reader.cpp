// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cell/cell_sections.hpp"
#include "cell/earlier_arm.hpp"
#include "cell/fleet_priors.hpp"
#include "effects/registry.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/json.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

void read_schema(TomlTable& root) {
  if (root.node("schema") == nullptr)
    return root.missing("schema", "write as the first line: schema = \"cell/1\"");
  if (const auto schema = root.text("schema"); schema && *schema != "cell/1")
    root.error("E-CELL-SCHEMA", fmt::format("schema is \"{}\"", *schema), *root.node("schema"),
               "this version reads \"cell/1\"", "schema = \"cell/1\"");
}

void read_about(TomlTable& root, Cell& cell) {
  cell.name = cell.directory.filename().string();
  auto t = root.table("cell");
  if (!t) return;
  cell.name = t->text_or("name", cell.name);
  cell.serial = t->text_or("serial", "");
  if (const auto mm = t->positive("tolerance_mm")) cell.tolerance_m = unit_of("mm")->to_si(*mm);
  t->done();
}

/// Sections that may be missing keep their defaults.
void read_section(TomlTable& root, const std::string& key, CellDraft& draft,
                  void (*read)(TomlTable&, CellDraft&)) {
  const toml::table empty;
  if (auto section = root.table(key)) return read(*section, draft);
  TomlTable nothing(empty, key, root.source());
  read(nothing, draft);
}

void read_sections(TomlTable& root, CellDraft& draft) {
  read_schema(root);
  read_about(root, draft.cell);
  if (root.node("robot") == nullptr)
    root.missing("robot", "describe the arm in a table [robot]: plumb new --help");
  else if (auto robot = root.table("robot"))
    read_robot(*robot, draft);
  draft.cell.effects.push_back(
      {.name = geometry_effect(), .joints = {}, .options = {}, .place = {}});
  read_section(root, "measurement", draft, read_measurement);
  read_section(root, "effects", draft, read_effects);
  read_section(root, "fit", draft, read_fit);
  read_section(root, "deploy", draft, read_deploy);
  root.done();
}

}  // namespace

int CellDraft::joint_index(const std::string& name) const {
  for (int i = 0; i < cell.joints(); ++i)
    if (cell.nominal.joints[i].name == name) return i;
  return -1;
}

std::vector<std::string> CellDraft::joint_names() const {
  std::vector<std::string> out;
  for (const auto& row : cell.nominal.joints) out.push_back(row.name);
  return out;
}

void unknown_joint(TomlTable& table, const std::string& name, const toml::node& node,
                   const CellDraft& draft) {
  const auto guess = did_you_mean(name, draft.joint_names());
  table.error("E-CELL-JOINT", fmt::format("there is no joint '{}'", name), node,
              guess ? fmt::format("did you mean '{}'?", *guess) : "unknown joint",
              fmt::format("joints: {}", fmt::join(draft.joint_names(), ", ")));
}

Cell parse_cell(std::string text, const fs::path& cell_toml) {
  const fs::path file = fs::absolute(cell_toml).lexically_normal();
  CellDraft draft;
  draft.cell.file = file;
  draft.cell.directory = file.parent_path();
  draft.cell.text = std::move(text);
  TomlSource source(display_name(file), draft.cell.text);
  const toml::table parsed = source.parse();
  TomlTable root(parsed, "", source);
  read_sections(root, draft);
  source.stop_on_errors();
  draft.cell.remarks = std::move(source.problems().remarks());
  return std::move(draft.cell);
}

Cell read_cell(const fs::path& cell_toml) {
  return parse_cell(read_file_up_to(cell_toml, kMostCellBytes), cell_toml);
}

namespace {

std::string taken_over(const Cell& cell) {
  return fleet_priors_text(cell.fit) + (cell.fit.earlier ? cell.fit.earlier->check_sum : "");
}

/// The same value however it is written: 5 and 5.0, tables in one line or in many, in any order.
Json canonical(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    Json out = Json::object();
    for (const auto& [key, value] : *table) out[std::string(key.str())] = canonical(value);
    return out;
  }
  if (const auto* array = node.as_array()) {
    Json out = Json::array();
    for (const auto& value : *array) out.push_back(canonical(value));
    return out;
  }
  if (const auto number = node.value<double>()) return *number;
  if (const auto truth = node.value<bool>()) return *truth;
  return node.value_or(std::string());
}

}  // namespace

std::string hash_of(const Cell& cell) { return sha256(cell.text + taken_over(cell)); }

std::string fit_hash(const Cell& cell) {
  TomlSource source(display_name(cell.file), cell.text);
  Json read = canonical(source.parse());
  for (const char* unread : {"cell", "deploy"}) read.erase(unread);
  return sha256(read.dump() + taken_over(cell));
}

fs::path find_cell(const fs::path& start) {
  const fs::path first = fs::absolute(start).lexically_normal();
  std::error_code ignored;
  for (fs::path folder = first;; folder = folder.parent_path()) {
    if (fs::exists(folder / "cell.toml", ignored)) return folder / "cell.toml";
    if (folder == folder.parent_path()) break;
  }
  throw Failure(Exit::kInput,
                {.code = "E-CELL-NONE",
                 .message = fmt::format("no cell.toml in {} or above", first.string()),
                 .help = "go to a cell's folder, name it with -C DIR, or try: plumb demo"});
}

}  // namespace plumb::offline
