// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "plumb/format/writer.hpp"
#include "plumb/runtime/chain.hpp"
#include "program/file.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb::tests {

/// A folder as `plumb deploy` leaves it, with a file of targets, removed at the end.
class Deployed {
 public:
  Deployed() : Deployed(csv("")) {}
  explicit Deployed(const std::string& toml) {
    std::string name = (std::filesystem::temp_directory_path() / "plumb-rt-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder = name;
    write("rt.toml", toml);
    write_model("robot.plumb", arm());
    std::ostringstream targets;
    targets.precision(12);
    targets << "x_mm,y_mm,z_mm,qw,qx,qy,qz,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n";
    for (int i = 0; i < kTargets; ++i) write_target(targets, 1e-4 * i);
    write("targets.csv", targets.str());
  }
  ~Deployed() {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  Deployed(const Deployed&) = delete;
  Deployed& operator=(const Deployed&) = delete;

  static constexpr int kTargets = 20;
  static constexpr const char* kSums = "SHA256SUMS";

  static format::Model arm() {
    format::Model out = one_arm();
    out.serial = "UR-1";
    out.guard.ramp_s = 0.1;
    return out;
  }

  static std::string csv(const std::string& more) {
    return "schema = \"rt/1\"\n[cycle]\ncycle_us = 1000\npriority = 0\n"
           "[source]\nkind = \"csv\"\nfile = \"targets.csv\"\n"
           "[sink]\nkind = \"csv\"\nfile = \"corrected.csv\"\n"
           "[limits]\nmax_change_mm = 5\nmode = \"full\"\n" +
           more;
  }

  /// plumb-rt as a Modbus server for a controller on this machine.
  static std::string modbus_server(int port) {
    return "schema = \"rt/1\"\n[cycle]\npriority = 0\n[source]\nkind = \"modbus\"\n"
           "role = \"server\"\npeers = [\"127.0.0.1\"]\nport = " +
           std::to_string(port) + "\n";
  }

  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder / file) << text;
    if (file != kSums) seal();
  }
  void write_model(const std::string& file, const format::Model& model) const {
    const auto bytes = format::write_model(model);
    std::ofstream(folder / file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    seal();
  }
  /// Lists the configuration and the models in SHA256SUMS, as an operator who edited them would.
  void seal() const {
    std::string text;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      const bool summed =
          name == "rt.toml" || entry.path().extension() == ".plumb" || name == "targets.csv";
      if (summed) text += sha256(read_file(entry.path())) + "  " + name + "\n";
    }
    std::ofstream(folder / kSums) << text;
  }
  std::string text(const std::string& file) const {
    std::ifstream in(folder / file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  std::filesystem::path folder;

 private:
  /// Writes a target at the nominal pose of its joints.
  static void write_target(std::ostream& out, double swing) {
    const std::vector<double> q{0.3 + swing, -1.0, 1.2, -0.4, 1.1 - swing, 0.2};
    const format::Pose pose = to_pose(Chain(arm().nominal).forward(q));
    for (const double x : pose.p) out << 1e3 * x << ",";
    for (const double x : pose.q) out << x << ",";
    for (std::size_t i = 0; i < q.size(); ++i) out << q[i] << (i + 1 < q.size() ? "," : "\n");
  }
};

}  // namespace plumb::tests
