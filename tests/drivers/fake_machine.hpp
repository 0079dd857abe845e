// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "rt/machine_files.hpp"

namespace plumb::tests {

/// A folder with files as in /proc and /sys, removed at the end. It begins as a machine that is fit
/// for every cycle.
class FakeMachine {
 public:
  FakeMachine() {
    std::string name = (std::filesystem::temp_directory_path() / "plumb-machine-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    root_ = name;
    write("proc/version", "Linux version 6.1.0-56-rt-amd64 (x) #1 SMP PREEMPT_RT Debian\n");
    write("proc/cpuinfo", "processor\t: 0\nflags\t\t: fpu vme sse2\n");
    write("proc/sys/kernel/sched_rt_runtime_us", "-1\n");
    write_limits("99", "unlimited");
    write("sys/devices/system/clocksource/clocksource0/current_clocksource", "tsc\n");
    write("sys/kernel/mm/transparent_hugepage/enabled", "always [madvise] never\n");
    for (const char* cpu : {"cpu0", "cpu1"})
      write("sys/devices/system/cpu/" + std::string(cpu) + "/cpufreq/scaling_governor",
            "performance\n");
    write("sys/devices/system/cpu/isolated", "1\n");
    write("sys/devices/system/cpu/nohz_full", "1\n");
    write("sys/devices/system/cpu/smt/active", "0\n");
    write_can("can0", "0x40041", "72");
    write("sys/class/net/eth0/type", "1\n");
  }
  ~FakeMachine() {
    std::error_code ignored;
    std::filesystem::remove_all(root_, ignored);
  }
  FakeMachine(const FakeMachine&) = delete;
  FakeMachine& operator=(const FakeMachine&) = delete;

  void write(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  void write_limits(const std::string& priority, const std::string& memory) const {
    write("proc/self/limits",
          "Limit                     Soft Limit           Hard Limit           Units     \n"
          "Max locked memory         " +
              memory + "              " + memory +
              "              bytes     \n"
              "Max realtime priority     " +
              priority + "                    " + priority + "                    \n");
  }
  /// A CAN interface: flags as ifconfig has them (0x40041: up), and 72 bytes a frame for CAN FD.
  void write_can(const std::string& name, const std::string& flags, const std::string& mtu,
                 const std::string& carrier = "1") const {
    const std::string folder = "sys/class/net/" + name;
    write(folder + "/type", "280\n");
    write(folder + "/flags", flags + "\n");
    write(folder + "/carrier", carrier + "\n");
    write(folder + "/mtu", mtu + "\n");
  }
  void remove(const std::string& file) const { std::filesystem::remove_all(root_ / file); }

  const std::filesystem::path& root() const { return root_; }
  drivers::rt::MachineFiles files() const { return drivers::rt::MachineFiles(root_); }

 private:
  std::filesystem::path root_;
};

}  // namespace plumb::tests
