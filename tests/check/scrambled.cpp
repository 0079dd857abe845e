// SPDX-License-Identifier: Apache-2.0
#include "tests/check/scrambled.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>

#include "cell/measurement_reader.hpp"
#include "fit/cell_data.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline::scrambled {
namespace {

namespace fs = std::filesystem;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// Every data cell of the column whose heading begins with `column` goes through `change`.
std::string with_column(const std::string& csv, const std::string& column,
                        const std::function<std::string(const std::string&)>& change) {
  std::istringstream in(csv);
  std::string out;
  int index = -1;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') {
      out += line + "\n";
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream parts(line);
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    if (index < 0) {
      while (cells[++index].rfind(column, 0) != 0) {
      }
    } else {
      cells[index] = change(cells[index]);
    }
    for (std::size_t i = 0; i < cells.size(); ++i) out += (i > 0 ? "," : "") + cells[i];
    out += "\n";
  }
  return out;
}

std::string minus(const std::string& number) {
  return number[0] == '-' ? number.substr(1) : "-" + number;
}

int joints_of(const Files& files) {
  int n = 0;
  while (files.csv.find("q" + std::to_string(n + 1) + "_") != std::string::npos) ++n;
  return n;
}

/// Each takes files without that mistake.
void other_convention(Files& f) {
  const bool standard = f.cell.find("dh_convention = \"standard\"") != std::string::npos;
  f.cell =
      replaced(f.cell, standard ? "dh_convention = \"standard\"" : "dh_convention = \"modified\"",
               standard ? "dh_convention = \"modified\"" : "dh_convention = \"standard\"");
}

void other_length_unit(Files& f, tests::Random& random) {
  f.cell = replaced(f.cell, "length_unit = \"mm\"",
                    random.below(2) == 0 ? "length_unit = \"m\"" : "length_unit = \"in\"");
}

void other_point_unit(Files& f, tests::Random& random) {
  const std::string unit = random.below(3) == 0 ? "in" : "m";
  for (const std::string axis : {"x", "y", "z"})
    f.csv = replaced(f.csv, "," + axis + "_mm", "," + axis + "_" + unit);
}

void other_turn_unit(Files& f) {
  for (int j = 1; j <= joints_of(f); ++j) {
    const std::string q = ",q" + std::to_string(j);
    f.csv = replaced(f.csv, q + "_deg", q + "_rad");
  }
}

void other_table_angles(Files& f) {
  f.cell = replaced(f.cell, "angle_unit = \"deg\"", "angle_unit = \"rad\"");
}

void reverse_joints(Files& f, tests::Random& random) {
  const int n = joints_of(f);
  const int wanted = 1 + random.below(2);
  std::vector<int> reversed;
  while (static_cast<int>(reversed.size()) < wanted) {
    const int j = 1 + random.below(n);
    if (std::find(reversed.begin(), reversed.end(), j) == reversed.end()) reversed.push_back(j);
  }
  for (const int j : reversed) {
    f.csv = with_column(f.csv, "q" + std::to_string(j) + "_", minus);
    f.done.push_back("J" + std::to_string(j) + " reversed");
  }
}

void mirror(Files& f, tests::Random& random) {
  const int kind = random.below(4);
  if (kind < 3) {
    f.csv = with_column(f.csv, std::string(1, "xyz"[kind]) + "_", minus);
  } else {
    f.csv = replaced(f.csv, ",x_", ",w_");
    f.csv = replaced(f.csv, ",y_", ",x_");
    f.csv = replaced(f.csv, ",w_", ",y_");
  }
}

}  // namespace

Files random_files(tests::Random& random) {
  const bool scara = random.below(5) == 0;
  const auto convention =
      random.below(2) == 0 ? format::Convention::kStandard : format::Convention::kModified;
  const Cell cell = random_cell(random.bits(), scara ? 4 : 4 + random.below(4), convention,
                                scara ? ArmKind::kScara : ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = 30 + random.below(121);
  plan.noise_m = random.uniform(10e-6, 50e-6);
  plan.seed = random.bits();
  plan.truth.geometry_m = 0.5e-3;
  plan.truth.geometry_rad = 0.5e-3;
  return {write_cell(cell), simulated_csv(cell, simulate(cell, plan)), {}};
}

Files six_joints(std::uint64_t seed) {
  const auto convention =
      seed % 2 == 0 ? format::Convention::kStandard : format::Convention::kModified;
  const Cell cell = random_cell(seed, 6, convention, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = 80;
  plan.noise_m = 20e-6;
  plan.seed = seed;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
  return {write_cell(cell), simulated_csv(cell, simulate(cell, plan)), {}};
}

Files scramble(const Files& files, tests::Random& random) {
  Files out = files;
  const int wanted = 1 + random.below(3);
  std::vector<int> kinds{0, 1, 2, 3, 4, 5, 5, 6};
  for (int i = 0; i < wanted; ++i) {
    const int pick = random.below(static_cast<int>(kinds.size()));
    const int kind = kinds[pick];
    std::erase(kinds, kind);
    static const char* const kNames[] = {"convention",   "table lengths", "points", "joint angles",
                                         "table angles", "directions",    "mirror"};
    if (kind != 5) out.done.emplace_back(kNames[kind]);
    if (kind == 0) other_convention(out);
    if (kind == 1) other_length_unit(out, random);
    if (kind == 2) other_point_unit(out, random);
    if (kind == 3) other_turn_unit(out);
    if (kind == 4) other_table_angles(out);
    if (kind == 5) reverse_joints(out, random);
    if (kind == 6) mirror(out, random);
  }
  return out;
}

Case opened(const Files& files, const fs::path& folder) {
  std::ofstream(folder / "cell.toml") << files.cell;
  std::ofstream(folder / "measurements.csv") << files.csv;
  Case out{read_cell(folder / "cell.toml"), {}};
  out.measured =
      read_measurements({folder / "measurements.csv"}, out.cell.nominal, Needs::kJointsAndPosition);
  return out;
}

Folder::Folder() {
  static int count = 0;
  path_ = fs::temp_directory_path() /
          ("plumb-check-" + std::to_string(::getpid()) + "-" + std::to_string(++count));
  fs::create_directories(path_);
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace plumb::offline::scrambled
