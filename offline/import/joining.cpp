// SPDX-License-Identifier: Apache-2.0
#include "import/joining.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "arm/predicted_points.hpp"
#include "cell/units.hpp"
#include "fit/calibrate.hpp"
#include "import/words.hpp"

namespace plumb::offline {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

/// Rows by which one file may be shifted against the other.
constexpr int kMostShift = 5;
/// A shift must lower the residual below this share of that without one.
constexpr double kClearlyBetter = 0.2;
/// Shifts that leave fewer pairs are not tried.
constexpr int kFewPairs = 8;

[[noreturn]] void refuse(const Imported& file, std::string message, std::string help) {
  throw Failure(Exit::kInput, {.code = "E-IMPORT-JOIN",
                               .message = std::move(message),
                               .place = Place{.file = file.file, .line = 1},
                               .help = std::move(help)});
}

using Names = std::vector<std::string>;

/// The name without what people write differently: "A::robot::P01" is "p1".
std::string plain_name(const std::string& name) {
  const auto digit_at = [&](std::size_t i) {
    return i < name.size() && std::isdigit(static_cast<unsigned char>(name[i])) != 0;
  };
  const auto colons = name.rfind("::");
  std::string kept;
  for (std::size_t i = colons == name.npos ? 0 : colons + 2; i < name.size(); ++i) {
    const bool between = i > 0 && digit_at(i - 1) && digit_at(i + 1) && !digit_at(i);
    kept += between ? 'x' : name[i];  // "1-1" is not "11"
  }
  const std::string text = folded(kept);
  std::string out;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    const bool zero = !out.empty() && out.back() == '0' &&
                      (out.size() == 1 || out[out.size() - 2] < '0' || out[out.size() - 2] > '9');
    if (digit && zero) out.pop_back();
    out += c;
  }
  return out;
}

/// True if no two different names become one.
bool stay_apart(const Names& names) {
  std::map<std::string, std::string> seen;
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    const std::string plain = plain_name(name);
    return !plain.empty() && seen.emplace(plain, name).first->second == name;
  });
}

/// Compares names by what is common to the two ways of writing them, if nothing is lost thereby,
/// and says so.
void compare_plainly(const Imported& b, Names& in_a, Names& in_b, std::vector<Problem>& remarks) {
  const std::set<std::string> exact(in_b.begin(), in_b.end());
  if (std::all_of(in_a.begin(), in_a.end(), [&](const auto& name) { return exact.contains(name); }))
    return;
  if (!stay_apart(in_a) || !stay_apart(in_b)) return;
  std::map<std::string, std::string> plain;
  for (const auto& name : in_b) plain[plain_name(name)] = name;
  std::string example;
  std::size_t differ = 0;
  for (auto& name : in_a) {
    const auto at = plain.find(plain_name(name));
    if (at == plain.end() || at->second == name) continue;
    if (++differ == 1) example = fmt::format("'{}' is taken for '{}'", name, at->second);
    name = at->second;
  }
  if (differ > 0)
    remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-IMPORT-NAMES",
         .message = fmt::format("{} of the poses are written differently in the two files: {}",
                                differ, example),
         .place = Place{.file = b.file, .line = 1},
         .help = "if they are different poses, give them different names"});
}

Pairs pairs_by_pose(const Imported& a, const Imported& b, std::vector<Problem>& remarks) {
  for (const auto* file : {&a, &b})
    if (file->find("pose") == nullptr)
      refuse(*file, "no column names the poses", "--join order, or: --map \"Point=pose\"");
  const CellColumn &of_a = a.find("pose")->text, &of_b = b.find("pose")->text;
  Names in_a(of_a.begin(), of_a.end()), in_b(of_b.begin(), of_b.end());
  compare_plainly(b, in_a, in_b, remarks);
  std::map<std::string, std::vector<int>> rows;
  for (int i = 0; i < b.rows(); ++i) rows[in_b[i]].push_back(i);
  std::map<std::string, std::size_t> used;
  Pairs out;
  for (int i = 0; i < a.rows(); ++i) {
    const auto& name = in_a[i];
    const auto at = rows.find(name);
    if (at == rows.end()) continue;
    // Poses measured several times: one row of joints may stand for all of them.
    if (std::count(in_a.begin(), in_a.end(), name) == 1)
      for (int k : at->second) out.emplace_back(i, k);
    else if (used[name] < at->second.size())
      out.emplace_back(i, at->second[used[name]++]);
  }
  return out;
}

Pairs pairs_by_time(const Imported& a, const Imported& b, double max_gap_s) {
  const ImportedColumn *in_a = a.find("t"), *in_b = b.find("t");
  if (in_a == nullptr || in_b == nullptr)
    refuse(in_a == nullptr ? a : b, "no column tells the time", "--map \"Clock=t_s\"");
  const auto t_a = si_values(*in_a);
  auto t_b = si_values(*in_b);
  // Each file counts from its own first row.
  if (!a.start.empty() && a.start == b.start)
    for (double& t : t_b) t += b.start_s - a.start_s;
  Pairs out;
  for (int k = 0; k < b.rows(); ++k) {
    int best = -1;
    for (int i = 0; i < a.rows(); ++i)
      if (best < 0 || std::abs(t_a[i] - t_b[k]) < std::abs(t_a[best] - t_b[k])) best = i;
    if (best >= 0 && std::abs(t_a[best] - t_b[k]) <= max_gap_s) out.emplace_back(best, k);
  }
  return out;
}

Pairs shifted(const Imported& a, const Imported& b, int shift) {
  Pairs out;
  for (int i = 0; i < a.rows(); ++i)
    if (i + shift >= 0 && i + shift < b.rows()) out.emplace_back(i, i + shift);
  return out;
}

const ImportedColumn* either(const Imported& a, const Imported& b, const std::string& name,
                             bool& in_first) {
  const ImportedColumn* found = a.find(name);
  in_first = found != nullptr;
  return found != nullptr ? found : b.find(name);
}

/// RMS distance [m] of the measured points from the nominal arm, with frame and target fitted;
/// nothing if the files lack joints or points.
std::optional<double> residual(const Imported& a, const Imported& b, const Pairs& pairs,
                               const Cell& cell) {
  Measurements m;
  const auto n = static_cast<Eigen::Index>(pairs.size());
  m.q.resize(n, cell.joints());
  m.p_M = Rows3::Zero(n, 3);
  const auto fill = [&](const std::string& name, auto set) {
    bool in_first = false;
    const ImportedColumn* column = either(a, b, name, in_first);
    if (column == nullptr) return false;
    const auto values = si_values(*column);
    for (Eigen::Index i = 0; i < n; ++i)
      set(i, values[in_first ? pairs[i].first : pairs[i].second]);
    return true;
  };
  for (int j = 0; j < cell.joints(); ++j)
    if (!fill("q" + std::to_string(j + 1), [&](Eigen::Index i, double v) { m.q(i, j) = v; }))
      return std::nullopt;
  for (int k = 0; k < 3; ++k)
    m.has_axis[k] =
        fill(std::string(1, "xyz"[k]), [&](Eigen::Index i, double v) { m.p_M(i, k) = v; });
  if (!m.has_axis[0] && !m.has_axis[1]) return std::nullopt;
  m.pose.resize(pairs.size());
  m.set.assign(pairs.size(), SetMark::kUnmarked);
  std::vector<int> rows(pairs.size());
  std::iota(rows.begin(), rows.end(), 0);
  const ArmState placed = place_nominal(cell, m, rows);
  return std::sqrt(residuals(m, predict_points(placed, m)).squaredNorm() / static_cast<double>(n));
}

Pairs pairs_by_order(const Imported& a, const Imported& b, const Cell* cell,
                     std::vector<Problem>& remarks) {
  const bool equal = a.rows() == b.rows();
  if (cell == nullptr) {
    if (equal) return shifted(a, b, 0);
    refuse(b, fmt::format("{} rows here, {} in {}", b.rows(), a.rows(), a.file),
           "--join pose; or make the cell first (plumb new), so that its arm tells the shift");
  }
  double best = std::numeric_limits<double>::infinity(), unshifted = best;
  int shift = 0;
  for (int s = -kMostShift; s <= kMostShift; ++s) {
    const Pairs pairs = shifted(a, b, s);
    if (static_cast<int>(pairs.size()) < kFewPairs) continue;
    const auto rms = residual(a, b, pairs, *cell);
    if (!rms) break;
    if (s == 0) unshifted = *rms;
    if (*rms < best) best = *rms, shift = s;
  }
  if (shift == 0 || (equal && best > kClearlyBetter * unshifted)) return shifted(a, b, 0);
  remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-IMPORT-SHIFT",
       .message = fmt::format("{} is shifted by {} row{} against {}: residual {:.2f} mm, {:.2f} mm "
                              "without the shift",
                              b.file, shift, std::abs(shift) == 1 ? "" : "s", a.file, best * 1e3,
                              unshifted * 1e3),
       .place = Place{.file = b.file, .line = 1},
       .help = "look for a missing or extra row at the beginning of one of the files"});
  return shifted(a, b, shift);
}

/// The first name of each file, if rows are joined by names.
std::string first_names(const Imported& a, const Imported& b, const JoinWishes& wishes) {
  if (wishes.by != JoinBy::kPose || a.rows() == 0 || b.rows() == 0) return {};
  return fmt::format(": its poses are called '{}', ..., here '{}', ...",
                     a.find("pose")->text.front(), b.find("pose")->text.front());
}

}  // namespace

Imported join(const Imported& first, const Imported& second, const JoinWishes& wishes) {
  Imported out;
  out.file = first.file;
  out.inputs = {first.inputs.front(), second.inputs.front()};
  out.separator = first.separator;
  out.decimal = first.decimal;
  out.comments = first.comments;
  out.remarks = first.remarks;
  out.remarks.insert(out.remarks.end(), second.remarks.begin(), second.remarks.end());
  out.left_out = first.left_out;
  out.left_out.insert(out.left_out.end(), second.left_out.begin(), second.left_out.end());
  out.unused = first.unused;
  out.unused.insert(out.unused.end(), second.unused.begin(), second.unused.end());
  Pairs pairs;
  switch (wishes.by) {
    case JoinBy::kPose:
      pairs = pairs_by_pose(first, second, out.remarks);
      break;
    case JoinBy::kTime:
      pairs = pairs_by_time(first, second, wishes.max_gap_s);
      break;
    default:
      pairs = pairs_by_order(first, second, wishes.cell, out.remarks);
  }
  if (pairs.empty())
    refuse(second,
           fmt::format("no row belongs to a row of {}{}", first.file,
                       first_names(first, second, wishes)),
           "--join pose, --join time --max-gap 5, or --join order");
  std::vector<int> in_first, in_second;
  for (const auto& [i, k] : pairs) {
    in_first.push_back(i);
    in_second.push_back(k);
    out.lines.push_back(first.lines[i]);
  }
  for (const auto& [from, name, unit, text] : first.columns)
    out.columns.push_back({from, name, unit, text.of_rows(in_first)});
  for (const auto& [from, name, unit, text] : second.columns)
    if (first.find(name) == nullptr)
      out.columns.push_back({from, name, unit, text.of_rows(in_second)});
  const auto lost = static_cast<std::size_t>(std::max(first.rows(), second.rows())) - pairs.size();
  if (lost > 0)
    out.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-IMPORT-PARTNERS",
         .message = fmt::format("{} rows have no partner in the other file and were dropped", lost),
         .place = Place{.file = second.file, .line = 1},
         .help = "compare the two files; --max-gap widens what counts as the same time"});
  return out;
}

}  // namespace plumb::offline
