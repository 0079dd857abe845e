// SPDX-License-Identifier: Apache-2.0
#include "cell/measurements.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>

namespace plumb::offline {
namespace {

constexpr double kQuaternionSlack = 1e-3;
constexpr double kSamePose = 1e-9;  // [rad] or [m]

class Assembler {
 public:
  Assembler(std::vector<bool> joint_is_angle, Needs needs)
      : is_angle_(std::move(joint_is_angle)), needs_(needs) {}

  void add(const std::filesystem::path& file) {
    try {
      tables_.push_back(read_table(file));
    } catch (const Failure& failure) {
      problems_.insert(problems_.end(), failure.problems().begin(), failure.problems().end());
      return;
    }
    check_joints(tables_.back());
    check_position(tables_.back());
  }

  Measurements finish() {
    if (!problems_.empty()) throw Failure(Exit::kInput, std::move(problems_));
    int rows = 0;
    for (const auto& t : tables_) rows += t.rows();
    const bool quat = everywhere("qw"), sigma = everywhere("sx"), nominal = everywhere("nx");
    const bool turns = everywhere("rx");
    m_.q.resize(rows, static_cast<Eigen::Index>(is_angle_.size()));
    m_.p_M = Rows3::Zero(rows, 3);
    m_.quat_M.resize(quat || turns ? rows : 0, 4);
    m_.sigma_m = Rows3::Zero(sigma ? rows : 0, 3);
    m_.nominal_B = Rows3::Zero(nominal ? rows : 0, 3);
    for (int k = 0; k < 3; ++k) m_.has_axis[k] = everywhere(kAxes[k]);
    int first = 0;
    for (const auto& t : tables_) {
      fill(t, first, quat, turns);
      first += t.rows();
    }
    if (!problems_.empty()) throw Failure(Exit::kInput, std::move(problems_));
    group_replicates();
    m_.tables = std::move(tables_);
    return std::move(m_);
  }

 private:
  static constexpr const char* kAxes[] = {"x", "y", "z"};

  bool everywhere(const std::string& name) const {
    for (const auto& t : tables_)
      if (t.find(name) == nullptr) return false;
    return !tables_.empty();
  }

  void problem(const Table& t, std::string code, std::string message, std::string help,
               int row = -1, Severity severity = Severity::kError) {
    Place place{.file = t.file};
    if (row >= 0) place.line = t.lines[row];
    Problem p{severity, std::move(code), std::move(message), place, std::move(help)};
    if (severity == Severity::kError)
      problems_.push_back(std::move(p));
    else
      tables_.back().remarks.push_back(std::move(p));
  }

  void check_joints(const Table& t) {
    const int n = static_cast<int>(is_angle_.size());
    for (int i = 0; i < n; ++i) {
      const std::string name = fmt::format("q{}", i + 1);
      const Column* column = t.find(name);
      const auto wanted = is_angle_[i] ? Quantity::kAngle : Quantity::kLength;
      const char* unit = is_angle_[i] ? "deg" : "mm";
      if (column == nullptr)
        problem(
            t, "E-CSV-JOINT",
            fmt::format("joint column '{}_{}' is missing: the arm has {} joints", name, unit, n),
            "give every joint a column q1 … in deg or rad, or in mm if it slides");
      else if (column->quantity != wanted)
        problem(t, "E-CSV-KIND",
                fmt::format("column '{}' is in {}, but that joint {}", column->header, column->unit,
                            is_angle_[i] ? "turns" : "slides"),
                fmt::format("rename it to '{}_{}' if the numbers are, or correct cell.toml", name,
                            unit));
    }
    if (t.find(fmt::format("q{}", n + 1)) != nullptr)
      problem(t, "E-CSV-JOINT",
              fmt::format("column 'q{}' is one too many: the arm has {} joints", n + 1, n),
              "check [robot] joints in cell.toml");
  }

  void check_position(const Table& t) {
    int axes = 0;
    for (const char* name : kAxes) {
      const Column* column = t.find(name);
      if (column == nullptr) continue;
      ++axes;
      if (column->quantity != Quantity::kLength)
        problem(t, "E-CSV-KIND", fmt::format("column '{}' is not a length", column->header),
                fmt::format("rename it to '{}_mm'", name));
    }
    if (axes == 0 && needs_ == Needs::kJointsAndPosition)
      problem(t, "E-CSV-POSITION", "no measured position: columns x_mm, y_mm, z_mm are missing",
              "rename the tracker's columns to x_mm, y_mm, z_mm");
    if (t.find("rx") != nullptr && !named_rotation(t))
      problem(t, "E-CSV-ROTATION", "columns rx, ry, rz: the order of the three turns is not named",
              "add the line '# rot: xyz-fixed' (R = Rz Ry Rx), or give qw, qx, qy, qz");
  }

  static bool named_rotation(const Table& t) {
    for (const auto& [key, value] : t.comments)
      if (key == "rot" && value == "xyz-fixed") return true;
    return false;
  }

  static double at(const Table& t, const std::string& name, int row) {
    const Column* column = t.find(name);
    return column == nullptr ? 0.0 : column->values[row];
  }

  void fill(const Table& t, int first, bool quat, bool turns) {
    std::vector<const Column*> joints;
    for (std::size_t i = 0; i < is_angle_.size(); ++i)
      joints.push_back(t.find(fmt::format("q{}", i + 1)));
    const Column* pose = t.find("pose");
    const Column* set = t.find("set");
    const std::array<const Column*, 3> p{t.find("x"), t.find("y"), t.find("z")};
    for (int r = 0; r < t.rows(); ++r) {
      const int i = first + r;
      for (std::size_t k = 0; k < joints.size(); ++k) m_.q(i, k) = joints[k]->values[r];
      for (int k = 0; k < 3; ++k)
        if (m_.has_axis[k]) m_.p_M(i, k) = p[k]->values[r];
      m_.pose.push_back(pose != nullptr ? pose->text[r] : std::to_string(i + 1));
      m_.set.push_back(mark(t, set, r));
      if (quat || turns) m_.quat_M.row(i) = quat ? quaternion(t, r) : from_turns(t, r);
      if (m_.sigma_m.rows() > 0)
        m_.sigma_m.row(i) << at(t, "sx", r), at(t, "sy", r), at(t, "sz", r);
      if (m_.nominal_B.rows() > 0)
        m_.nominal_B.row(i) << at(t, "nx", r), at(t, "ny", r), at(t, "nz", r);
    }
  }

  SetMark mark(const Table& t, const Column* set, int row) {
    if (set == nullptr || set->text[row].empty()) return SetMark::kUnmarked;
    const std::string& text = set->text[row];
    if (text == "fit") return SetMark::kFit;
    if (text == "held") return SetMark::kHeld;
    if (text == "ignore") return SetMark::kIgnore;
    problem(t, "E-CSV-SET", fmt::format("column 'set' holds '{}'", text),
            "write fit, held or ignore", row);
    return SetMark::kUnmarked;
  }

  Eigen::RowVector4d quaternion(const Table& t, int row) {
    Eigen::RowVector4d q(at(t, "qw", row), at(t, "qx", row), at(t, "qy", row), at(t, "qz", row));
    if (std::abs(q.norm() - 1.0) > kQuaternionSlack)
      problem(t, "E-CSV-QUATERNION",
              fmt::format("the quaternion has length {:.6g}, not 1", q.norm()),
              "check the order qw, qx, qy, qz and the decimals", row);
    return q.norm() > 0 ? Eigen::RowVector4d(q / q.norm()) : Eigen::RowVector4d(1, 0, 0, 0);
  }

  /// R = Rz(rz) Ry(ry) Rx(rx).
  static Eigen::RowVector4d from_turns(const Table& t, int row) {
    const double a = at(t, "rx", row) / 2, b = at(t, "ry", row) / 2, c = at(t, "rz", row) / 2;
    const double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b);
    const double cc = std::cos(c), sc = std::sin(c);
    return {cc * cb * ca + sc * sb * sa, cc * cb * sa - sc * sb * ca, cc * sb * ca + sc * cb * sa,
            sc * cb * ca - cc * sb * sa};
  }

  /// Rows with one pose id or one joint state are repeats of each other.
  void group_replicates() {
    std::map<std::string, int> by_pose;
    std::map<std::vector<long long>, int> by_joints;
    std::vector<long long> key(is_angle_.size());
    m_.replicate_group.resize(m_.size());
    int groups = 0;
    for (int i = 0; i < m_.size(); ++i) {
      for (std::size_t k = 0; k < key.size(); ++k) key[k] = std::llround(m_.q(i, k) / kSamePose);
      const auto pose = by_pose.find(m_.pose[i]);
      const auto joints = by_joints.find(key);
      const int group = pose != by_pose.end()       ? pose->second
                        : joints != by_joints.end() ? joints->second
                                                    : groups++;
      by_pose.emplace(m_.pose[i], group);
      by_joints.emplace(key, group);
      m_.replicate_group[i] = group;
    }
  }

  std::vector<bool> is_angle_;
  Needs needs_;
  std::vector<Table> tables_;
  std::vector<Problem> problems_;
  Measurements m_;
};

}  // namespace

Measurements read_measurements(const std::vector<std::filesystem::path>& files,
                               const std::vector<bool>& joint_is_angle, Needs needs) {
  Assembler assembler(joint_is_angle, needs);
  for (const auto& file : files) assembler.add(file);
  return assembler.finish();
}

Measurements pick(const Measurements& all, const std::vector<int>& rows) {
  Measurements out;
  const auto some = [&](const auto& m) {
    return m.rows() > 0 ? std::remove_cvref_t<decltype(m)>(m(rows, Eigen::all))
                        : std::remove_cvref_t<decltype(m)>(m);
  };
  for (int i : rows) {
    out.pose.push_back(all.pose[i]);
    out.replicate_group.push_back(all.replicate_group[i]);
    out.set.push_back(all.set[i]);
  }
  out.q = some(all.q);
  out.p_M = some(all.p_M);
  out.has_axis = all.has_axis;
  out.quat_M = some(all.quat_M);
  out.sigma_m = some(all.sigma_m);
  out.nominal_B = some(all.nominal_B);
  return out;
}

}  // namespace plumb::offline
