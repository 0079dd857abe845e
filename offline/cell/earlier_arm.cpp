// SPDX-License-Identifier: Apache-2.0
#include "cell/earlier_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "cell/packed_matrix.hpp"
#include "cell/run_checksum.hpp"
#include "numbers/cholesky.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/json.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

constexpr double kAxes = 3.0;
/// A larger number [SI] shows that the file was edited or damaged.
constexpr double kMost = 1e6;
/// A longer chain of earlier runs is a circle.
constexpr int kMostSteps = 1000;

[[noreturn]] void refuse(const fs::path& what, const std::string& why) {
  throw Failure(Exit::kInput,
                {.code = "E-CELL-EARLIER",
                 .message = fmt::format("{} {}", display_name(what), why),
                 .help = "name a folder of a cell that was fitted, or of one of its runs, as in "
                         "../arm1/runs/0003"});
}

/// The folder of the run that is meant.
fs::path run_in(const fs::path& place) {
  std::error_code error;
  if (fs::exists(place / "run.json", error)) return place;
  if (place.filename() == "run.json") return place.parent_path();
  if (!fs::is_directory(place, error)) refuse(place, "is no folder of a cell or of a run");
  std::optional<fs::path> last;
  for (const auto& entry : fs::directory_iterator(place / "runs", error)) {
    const std::string name = entry.path().filename().string();
    const bool number = name.find_first_not_of("0123456789") == std::string::npos;
    if (!number || !fs::exists(entry.path() / "run.json", error)) continue;
    if (!last || last->filename().string() < name) last = entry.path();
  }
  if (!last) refuse(place, "holds no run that can be read");
  return *last;
}

EarlierArm::Number number_of(const Json& estimate) {
  return {.name = estimate.at("name"),
          .value = estimate.at("value"),
          .nominal = estimate.at("nominal"),
          .of_effect = !estimate.value("unit", std::string()).empty()};
}

EarlierArm::Row row_of(const Json& joint) {
  return {.joint = joint.at("name"),
          .prismatic = joint.at("prismatic"),
          .theta = joint.at("theta"),
          .d = joint.at("d"),
          .a = joint.at("a"),
          .alpha = joint.at("alpha")};
}

/// RMS of a coordinate; of the fitted poses where none was held out.
double left_of(const Json& run) {
  const Json& held = run.at("held_out");
  const Json& stats = held.at("n") > 0 ? held : run.at("fit");
  return stats.at("rms_m").get<double>() / std::sqrt(kAxes);
}

/// The digests of readings of a run: the last column of its predictions. A run of an earlier
/// version has none.
void add_digests(const fs::path& folder, const Json& run, std::unordered_set<std::string>& out) {
  const std::string text = read_regular_file(folder / "predictions.csv", kMostFileBytes);
  if (!predictions_sum_holds(run, text))
    refuse(folder / "predictions.csv", "was changed after it was written");
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  if (!line.ends_with(",note")) return;
  while (std::getline(lines, line)) out.insert(line.substr(line.rfind(',') + 1));
}

/// Adds what a run goes back to: its own readings, and those of the runs before it.
void add_readings(const fs::path& folder, const Json& run, EarlierArm& out, int steps = 0) {
  if (steps > kMostSteps) refuse(out.run, "goes back to more runs than any arm has");
  for (const auto& input : run.at("inputs")) out.inputs.push_back(input.at("sha256"));
  std::error_code error;
  add_digests(folder, run, out.readings);
  const auto go_on = [&](const fs::path& before) {
    if (before == folder || !fs::exists(before / "run.json", error)) return;
    add_readings(before, Json::parse(read_regular_file(before / "run.json", kMostFileBytes)), out,
                 steps + 1);
  };
  if (run.contains("from")) {
    for (const auto& sum : run.at("from").at("inputs")) out.inputs.push_back(sum);
    const auto& calibration = run.at("calibration");
    if (calibration.contains("likeness"))
      go_on(fs::path(calibration.at("likeness").at("run").get<std::string>()));
  }
  if (!run.contains("recheck")) return;
  const int parent = run.at("recheck").at("parent");
  go_on(folder.parent_path() / fmt::format("{:04}", parent));
}

bool sound(const EarlierArm& arm) {
  const auto possible = [](const EarlierArm::Number& n) {
    return std::abs(n.value) < kMost && std::abs(n.nominal) < kMost;
  };
  if (!std::all_of(arm.numbers.begin(), arm.numbers.end(), possible)) return false;
  if (!(arm.left_m > 0.0) || !(arm.left_m < kMost) || !arm.covariance.allFinite()) return false;
  const Eigen::VectorXd variance = arm.covariance.diagonal();
  if (!(variance.minCoeff() > 0.0) || !(variance.maxCoeff() < kMost)) return false;
  const Eigen::VectorXd per_sigma = variance.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation =
      per_sigma.asDiagonal() * arm.covariance * per_sigma.asDiagonal();
  return Cholesky(correlation).exists();
}

}  // namespace

EarlierArm earlier_arm(const fs::path& place) {
  EarlierArm out;
  out.run = run_in(place);
  const fs::path file = out.run / "run.json";
  try {
    const std::string text = read_regular_file(file, kMostFileBytes);
    if (!json_sum_holds(text)) refuse(file, "was changed after it was written");
    out.check_sum = sha256(text);
    const Json run = Json::parse(text);
    if (run.at("schema") != "run/1") refuse(file, "is of another schema than run/1");
    if (run.value("base", "arm") != "arm")
      refuse(file, "stands on the controller's own positions, which no other arm shares");
    add_readings(out.run, run, out);
    const Json& calibration = run.at("calibration");
    out.modified = calibration.at("chain").at("modified");
    for (const auto& joint : calibration.at("chain").at("joints"))
      out.rows.push_back(row_of(joint));
    const Json& estimates = calibration.at("estimates");
    std::vector<Eigen::Index> kept;
    Eigen::Index place_in_run = 0;
    for (const auto& estimate : estimates) {
      if (estimate.at("robot")) {
        out.numbers.push_back(number_of(estimate));
        kept.push_back(place_in_run);
      }
      ++place_in_run;
    }
    if (kept.empty()) refuse(out.run, "fitted no number of the arm");
    const Eigen::MatrixXd all = unpacked(calibration.at("covariance"), place_in_run);
    out.covariance = all(kept, kept);
    out.left_m = left_of(run);
    calibration.at("target").at("p").get_to(out.target_T);
  } catch (const nlohmann::json::exception&) {
    refuse(file, "is no run of plumb fit, or was cut off");
  }
  if (!sound(out)) refuse(file, "gives numbers that no arm has");
  return out;
}

}  // namespace plumb::offline
