// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "cell/cell.hpp"
#include "cell/file.hpp"
#include "cell/toml_table.hpp"
#include "cell/units.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

constexpr double kDefaultTurn = 2.0 * M_PI;  // joint limits where none are given [rad]
constexpr double kDefaultTravel_m = 10.0;    // and of a sliding joint

class CellReader {
 public:
  CellReader(const toml::table& root, const fs::path& file, const std::string& text)
      : source_(file.string(), text), root_(root, "", source_) {
    cell_.file = file;
    cell_.directory = file.parent_path();
    cell_.text = text;
  }

  Cell read() {
    read_schema();
    read_about();
    read_robot();
    read_measurement();
    read_effects();
    read_fit();
    read_deploy();
    root_.done();
    if (!source_.problems().empty()) throw Failure(Exit::kInput, source_.problems());
    cell_.remarks = source_.remarks();
    return std::move(cell_);
  }

 private:
  using Values = std::array<double, 3>;

  void read_schema() {
    const auto schema = root_.text("schema");
    if (!schema)
      root_.missing("schema", "write as the first line: schema = \"cell/1\"");
    else if (*schema != "cell/1")
      root_.wrong("schema", fmt::format("is '{}', not 'cell/1'", *schema), "unknown schema",
                  "schema = \"cell/1\"");
  }

  void read_about() {
    auto t = root_.table("cell");
    if (!t) return root_.missing("cell", "add a table [cell] with name, serial and tolerance_mm");
    cell_.name = t->text_or("name", cell_.directory.filename().string());
    cell_.serial = t->text_or("serial", "");
    cell_.tolerance_m = t->number_or("tolerance_mm", 0.1) * 1e-3;
    t->range("tolerance_mm", cell_.tolerance_m > 0, "greater than 0");
    t->done();
  }

  void read_robot() {
    auto t = root_.table("robot");
    if (!t) return root_.missing("robot", "describe the arm: plumb new --help");
    cell_.robot_name = t->text_or("name", "");
    read_units(*t);
    read_convention(*t);
    read_joints(*t);
    if (const auto g = t->vector3("gravity")) cell_.gravity = *g;
    cell_.nominal.base = read_pose(*t, "base");
    cell_.nominal.tool = read_pose(*t, "tool");
    read_payload(*t);
    read_links(*t);
    t->done();
  }

  void read_units(TomlTable& t) {
    cell_.length_unit = t.text_or("length_unit", "mm");
    cell_.angle_unit = t.text_or("angle_unit", "deg");
    const auto length = unit_of(cell_.length_unit), angle = unit_of(cell_.angle_unit);
    t.range("length_unit", length && length->quantity == Quantity::kLength, "mm, m, um or in");
    t.range("angle_unit", angle && angle->quantity == Quantity::kAngle, "deg, rad or mrad");
    length_ = length ? length->scale : 1e-3;
    angle_ = angle ? angle->scale : M_PI / 180.0;
  }

  void read_convention(TomlTable& t) {
    const auto text = t.text("dh_convention");
    if (!text)
      return t.missing("dh_convention",
                       "dh_convention = \"standard\" (distal) or \"modified\" (Craig)");
    t.range("dh_convention", *text == "standard" || *text == "modified",
            "\"standard\" (distal) or \"modified\" (Craig)");
    cell_.nominal.convention =
        *text == "modified" ? format::Convention::kModified : format::Convention::kStandard;
  }

  void read_joints(TomlTable& t) {
    auto joints = t.tables("joints");
    if (joints.empty()) return t.missing("joints", "list the joints: plumb new --help");
    t.range("joints", static_cast<int>(joints.size()) <= format::kMaxJoints,
            fmt::format("at most {} joints", format::kMaxJoints));
    std::set<std::string> names;
    for (auto& joint : joints) {
      read_joint(joint);
      joint.range("name", names.insert(cell_.nominal.joints.back().name).second, "unique");
    }
  }

  void read_joint(TomlTable& t) {
    format::JointRow row;
    row.name = t.text_or("name", fmt::format("J{}", cell_.nominal.joints.size() + 1));
    const std::string type = t.text_or("type", "revolute");
    t.range("type", type == "revolute" || type == "prismatic", "\"revolute\" or \"prismatic\"");
    const bool slides = type == "prismatic";
    row.type = slides ? format::JointType::kPrismatic : format::JointType::kRevolute;
    const double own = slides ? length_ : angle_;
    row.alpha = t.number_or("alpha", 0.0) * angle_;
    row.a = t.number_or("a", 0.0) * length_;
    row.d = t.number_or("d", 0.0) * length_;
    row.theta = t.number_or("theta", 0.0) * angle_;
    row.beta = t.number_or("beta", 0.0) * angle_;
    row.offset = t.number_or("offset", 0.0) * own;
    row.scale = t.number_or("scale", 1.0);
    t.range("scale", row.scale >= 0.5 && row.scale <= 2.0, "between 0.5 and 2");
    const double span = slides ? kDefaultTravel_m : kDefaultTurn;
    const auto q = t.pair("q");
    row.q_min = q ? (*q)[0] * own : -span;
    row.q_max = q ? (*q)[1] * own : span;
    t.range("q", row.q_min < row.q_max, "[min, max] with min below max");
    cell_.nominal.joints.push_back(row);
    read_mechanics(t);
  }

  void read_mechanics(TomlTable& t) {
    JointMechanics m;
    m.parallel_next = t.boolean("parallel_next").value_or(false);
    m.gear_ratio = t.number("gear_ratio");
    m.stiffness_Nm_per_rad = t.number("stiffness_Nm_per_rad");
    for (const char* key : {"gear_ratio", "stiffness_Nm_per_rad"})
      if (const auto value = t.number(key)) t.range(key, *value > 0, "greater than 0");
    cell_.mechanics.push_back(m);
    t.done();
  }

  void read_links(TomlTable& t) {
    for (auto& link : t.tables("links")) {
      const std::string joint = link.text_or("joint", "");
      const int index = joint_index(joint);
      if (index < 0) {
        link.wrong("joint", fmt::format("names '{}', which is no joint", joint), "no such joint",
                   "name one of: " + joint_list());
        continue;
      }
      JointMechanics& m = cell_.mechanics[index];
      m.link_mass_kg = link.number("mass_kg");
      if (const auto com = link.vector3("com_mm")) m.link_com_m = scaled(*com, 1e-3);
      if (const auto length = link.number("length_mm")) m.length_m = *length * 1e-3;
      m.EI_Nm2 = link.number("EI_Nm2");
      m.GJ_Nm2 = link.number("GJ_Nm2");
      m.kg_per_m = link.number("kg_per_m");
      link.done();
    }
  }

  void read_payload(TomlTable& t) {
    auto payload = t.table("payload");
    if (!payload) return;
    cell_.payload.mass_kg = payload->number_or("mass_kg", 0.0);
    payload->range("mass_kg", cell_.payload.mass_kg >= 0, "0 or more");
    if (const auto com = payload->vector3("com_mm")) cell_.payload.com_m = scaled(*com, 1e-3);
    payload->done();
  }

  static Values scaled(Values v, double by) {
    for (double& x : v) x *= by;
    return v;
  }

  /// { xyz, rpy } in the file's units; R = Rz(yaw) Ry(pitch) Rx(roll).
  format::Pose pose_from(TomlTable& t) {
    format::Pose out;
    if (const auto xyz = t.vector3("xyz")) out.p = scaled(*xyz, length_);
    if (const auto rpy = t.vector3("rpy")) {
      const Values half = scaled(*rpy, 0.5 * angle_);
      const double cr = std::cos(half[0]), sr = std::sin(half[0]);
      const double cp = std::cos(half[1]), sp = std::sin(half[1]);
      const double cy = std::cos(half[2]), sy = std::sin(half[2]);
      out.q = {cy * cp * cr + sy * sp * sr, cy * cp * sr - sy * sp * cr,
               cy * sp * cr + sy * cp * sr, sy * cp * cr - cy * sp * sr};
      if (out.q[0] < 0)
        for (double& x : out.q) x = -x;
    }
    t.done();
    return out;
  }

  format::Pose read_pose(TomlTable& t, const std::string& key) {
    auto pose = t.table(key);
    return pose ? pose_from(*pose) : format::Pose{};
  }

  bool says_fit(TomlTable& t, const std::string& key) {
    const toml::node* n = t.node(key);
    return n == nullptr || (n->is_string() && *n->value<std::string>() == "fit");
  }

  void read_measurement() {
    auto t = root_.table("measurement");
    if (!t)
      return root_.missing("measurement", "add [measurement] with files = [\"measurements.csv\"]");
    MeasurementSettings& m = cell_.measurement;
    for (const auto& file : t->texts("files")) m.files.push_back(cell_.directory / file);
    if (m.files.empty()) t->missing("files", "files = [\"measurements.csv\"]");
    m.fit_frame = says_fit(*t, "frame");
    if (!m.fit_frame) m.X_MB = read_pose(*t, "frame");
    m.fit_target = says_fit(*t, "target");
    if (!m.fit_target)
      if (const auto target = t->vector3("target")) m.target_T = scaled(*target, length_);
    if (const auto sigma = t->number("sigma_um")) m.sigma_m = *sigma * 1e-6;
    if (const auto sigma = t->number("sigma_urad")) m.sigma_rad = *sigma * 1e-6;
    t->range("sigma_um", !m.sigma_m || *m.sigma_m > 0, "greater than 0");
    t->range("sigma_urad", !m.sigma_rad || *m.sigma_rad > 0, "greater than 0");
    read_held_out(*t);
    const double seed = t->number_or("seed", 1.0);
    t->range("seed", seed >= 0 && seed == std::floor(seed) && seed < 1e15,
             "a whole number, 0 or more");
    m.seed = static_cast<std::uint64_t>(std::max(0.0, seed));
    t->done();
  }

  void read_held_out(TomlTable& t) {
    const std::string text = t.text_or("held_out", "auto");
    const auto rule = parse_held_out(text, cell_.directory);
    if (rule)
      cell_.measurement.held_out = *rule;
    else
      t.wrong("held_out", fmt::format("is '{}'", text), "not a rule",
              "write \"auto\", \"20%\", \"kfold:5\", \"column:set\" or \"file:verify.csv\"");
  }

  void read_effects() {
    EffectEntry geometry;
    geometry.name = "geometry";
    auto t = root_.table("effects");
    if (!t || t->boolean("geometry").value_or(true)) cell_.effects.push_back(geometry);
    if (!t) return;
    for (const auto& name : t->keys()) {
      if (name == "geometry") continue;
      const toml::node* n = t->node(name);
      if (!is_known(name, *n)) continue;
      if (n->is_array())
        for (auto& entry : t->tables(name)) read_effect(name, entry, *n);
      else if (auto entry = t->table(name))
        read_effect(name, *entry, *n);
    }
  }

  bool is_known(const std::string& name, const toml::node& node) {
    const auto& known = known_effects();
    if (std::find(known.begin(), known.end(), name) != known.end()) return true;
    const auto& planned = planned_effects();
    const bool later = std::find(planned.begin(), planned.end(), name) != planned.end();
    std::vector<std::string> all = known;
    all.insert(all.end(), planned.begin(), planned.end());
    const auto guess = did_you_mean(name, all);
    source_.add("E-CELL-EFFECT",
                later ? fmt::format("effect '{}' is not in this version", name)
                      : fmt::format("unknown effect '{}'", name),
                node.source(),
                later   ? "cannot be fitted yet"
                : guess ? fmt::format("did you mean '{}'?", *guess)
                        : "not in the catalogue",
                later || !guess ? fmt::format("delete [effects.{}]", name)
                                : fmt::format("rename it to [effects.{}]", *guess));
    return false;
  }

  void read_effect(const std::string& name, TomlTable& t, const toml::node& node) {
    EffectEntry entry;
    entry.name = name;
    entry.place = source_.place(node.source(), "");
    for (const auto& joint : t.texts("joints")) {
      entry.joints.push_back(joint_index(joint));
      t.range("joints", entry.joints.back() >= 0, "names of joints: " + joint_list());
    }
    if (name == "local_tree") read_tree_options(t, entry);
    t.done();
    cell_.effects.push_back(std::move(entry));
  }

  void read_tree_options(TomlTable& t, EffectEntry& entry) {
    const toml::node* n = t.node("min_gain");
    if (n == nullptr) return;
    double gain = -1.0;
    if (n->is_string()) gain = parse_percent(*n->value<std::string>()).value_or(-1.0);
    if (n->is_number()) gain = *n->value<double>();
    t.range("min_gain", gain >= 0.0 && gain < 1.0, "a share like \"2%\"");
    entry.options["min_gain"] = gain;
  }

  void read_fit() {
    auto t = root_.table("fit");
    if (!t) return;
    cell_.fit.fixed = t->texts("fixed");
    for (const auto& name : cell_.fit.fixed)
      t->range(
          "fixed",
          joint_index(name.substr(0, name.find('.'))) >= 0 && name.find('.') != std::string::npos,
          "parameter names like \"J2.d\"");
    const std::string model = t->text_or("model", "dh");
    t->range("model", model == "dh" || model == "complete", "\"dh\" or \"complete\"");
    cell_.fit.model = model == "complete" ? FitSettings::Model::kComplete : FitSettings::Model::kDh;
    t->done();
  }

  void read_deploy() {
    auto t = root_.table("deploy");
    if (!t) return;
    cell_.deploy.cycle_s = t->number_or("cycle_us", 4000.0) * 1e-6;
    t->range("cycle_us", cell_.deploy.cycle_s >= 100e-6 && cell_.deploy.cycle_s <= 1.0,
             "between 100 and 1000000");
    cell_.deploy.max_correction_m = t->number_or("max_correction_mm", 3.0) * 1e-3;
    t->range("max_correction_mm",
             cell_.deploy.max_correction_m > 0 && cell_.deploy.max_correction_m <= 0.05,
             "greater than 0, at most 50");
    t->done();
  }

  int joint_index(const std::string& name) const {
    for (std::size_t i = 0; i < cell_.nominal.joints.size(); ++i)
      if (cell_.nominal.joints[i].name == name) return static_cast<int>(i);
    return -1;
  }

  std::string joint_list() const {
    std::string out;
    for (const auto& row : cell_.nominal.joints) out += (out.empty() ? "" : ", ") + row.name;
    return out;
  }

  TomlSource source_;
  TomlTable root_;
  Cell cell_;
  double length_ = 1e-3;
  double angle_ = M_PI / 180.0;
};

}  // namespace

std::optional<double> parse_percent(std::string_view text) {
  if (!text.ends_with('%')) return std::nullopt;
  text.remove_suffix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value / 100.0;
}

std::optional<HeldOutRule> parse_held_out(std::string_view text, const fs::path& directory) {
  HeldOutRule rule;
  using Kind = HeldOutRule::Kind;
  const auto rest = [&](std::string_view prefix) {
    return std::string(text.substr(prefix.size()));
  };
  if (text == "auto") return rule;
  if (const auto share = parse_percent(text)) {
    rule.kind = Kind::kShare;
    rule.share = *share;
    return *share > 0.0 && *share < 1.0 ? std::optional(rule) : std::nullopt;
  }
  if (text.starts_with("kfold:")) {
    const std::string number = rest("kfold:");
    rule.kind = Kind::kFolds;
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), rule.folds);
    const bool ok = error == std::errc{} && end == number.data() + number.size();
    return ok && rule.folds >= 2 && rule.folds <= 100 ? std::optional(rule) : std::nullopt;
  }
  if (text == "column:set") {
    rule.kind = Kind::kColumn;
    return rule;
  }
  if (text.starts_with("file:") && text.size() > 5) {
    rule.kind = Kind::kFile;
    rule.file = directory / rest("file:");
    return rule;
  }
  return std::nullopt;
}

Cell read_cell(const fs::path& cell_toml) {
  const fs::path file = fs::absolute(cell_toml).lexically_normal();
  const std::string text = read_file(file);
  try {
    return CellReader(toml::parse(text, file.string()), file, text).read();
  } catch (const toml::parse_error& e) {
    TomlSource source(file.string(), text);
    source.add("E-TOML", std::string(e.description()), e.source(), "here",
               "correct the line; strings need quotes, tables need [brackets]");
    throw Failure(Exit::kInput, source.problems());
  }
}

fs::path find_cell(const fs::path& start) {
  for (fs::path folder = fs::absolute(start).lexically_normal();; folder = folder.parent_path()) {
    if (fs::exists(folder / "cell.toml")) return folder / "cell.toml";
    if (folder == folder.parent_path()) break;
  }
  throw Failure(
      Exit::kInput,
      {.code = "E-CELL-NONE",
       .message = fmt::format("no cell.toml in {} or above", fs::absolute(start).string()),
       .help = "go to a cell's folder, name it with -C DIR, or try: plumb demo"});
}

}  // namespace plumb::offline
