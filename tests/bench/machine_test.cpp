// SPDX-License-Identifier: Apache-2.0
// When a machine may judge a controller: a made-up /proc and /sys, one thing wrong at a time.
#include "bench/machine.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace plumb::offline::bench {
namespace {

namespace fs = std::filesystem;

const Build kGoodBuild{.instructions = {}, .compiler = {}, .optimised = true};

/// Bare metal, isolated, at full clock, at rest.
class MadeUpMachine : public testing::Test {
 protected:
  void SetUp() override {
    write("proc/version", "Linux version 6.1.0-31-rt-amd64 (x) #1 SMP PREEMPT_RT Debian\n");
    write("proc/cpuinfo", "processor\t: 0\nmodel name\t: Some CPU\nflags\t\t: fpu avx2\n");
    write("proc/loadavg", "0.10 0.2 0.3 1/100 1\n");
    write("sys/devices/system/cpu/online", "0-3\n");
    write("sys/devices/system/cpu/isolated", "0-1023\n");
    for (const int cpu : look_at_machine().allowed) {
      write(core(cpu) + "cpufreq/scaling_governor", "performance\n");
      write(core(cpu) + "topology/thread_siblings_list", std::to_string(cpu) + "\n");
    }
  }
  void TearDown() override { fs::remove_all(root_); }

  static std::string core(int cpu) {
    return "sys/devices/system/cpu/cpu" + std::to_string(cpu) + "/";
  }
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  Machine machine() const { return look_at_machine(root_); }
  static int some_cpu() { return *look_at_machine().allowed.begin(); }

  /// The only reason, or all of them.
  std::string why(const Build& build = kGoodBuild) const {
    std::string out;
    for (const auto& reason : why_not_representative(machine(), build)) out += reason + "|";
    return out;
  }

  fs::path root_ = fs::temp_directory_path() / ("plumb_machine_" + std::to_string(::getpid()));
};

TEST_F(MadeUpMachine, IsRepresentativeWhenNothingIsWrong) {
  EXPECT_EQ(why(), "");
  EXPECT_EQ(machine().kernel, "6.1.0-31-rt-amd64");
  EXPECT_TRUE(machine().preempt_rt);
  EXPECT_EQ(machine().cpu, "Some CPU");
  EXPECT_EQ(machine().cpus, 4);
}

TEST_F(MadeUpMachine, IsNotWhenVirtual) {
  write("proc/cpuinfo", "model name: X\nflags : fpu hypervisor avx2\n");
  EXPECT_EQ(why(), "virtual machine|");
  write("proc/cpuinfo", "model name: X\nflags : fpu nohypervisor\n");
  EXPECT_EQ(why(), "");
}

TEST_F(MadeUpMachine, IsNotWhenItDoesNotSayWhetherItIsVirtual) {
  write("proc/cpuinfo", "processor: 0\n");
  EXPECT_EQ(why(), "it cannot be told whether this is a virtual machine|");
}

TEST_F(MadeUpMachine, IsNotWithoutAnIsolatedCpuUnderIt) {
  write("sys/devices/system/cpu/isolated", "\n");
  EXPECT_EQ(why(), "no isolated CPU|");
  write("sys/devices/system/cpu/isolated", "1000-1023\n");
  EXPECT_EQ(why(), "runs on CPU " + cpu_list(machine().allowed) + ", isolated is 1000-1023|");
}

TEST_F(MadeUpMachine, IsNotAtAnotherGovernorOrAnUnknownOne) {
  write(core(some_cpu()) + "cpufreq/scaling_governor", "powersave\n");
  EXPECT_NE(why().find("powersave|"), std::string::npos) << why();
  for (const int cpu : machine().allowed)
    fs::remove(root_ / core(cpu) / "cpufreq/scaling_governor");
  EXPECT_EQ(why(), "no CPU governor to be seen|");
}

TEST_F(MadeUpMachine, IsNotOnACoreThatIsShared) {
  const int cpu = some_cpu();
  write(core(cpu) + "topology/thread_siblings_list", std::to_string(cpu) + ",900\n");
  EXPECT_EQ(why(), "the core is shared with CPU 900|");
}

TEST_F(MadeUpMachine, IsNotUnderLoad) {
  write("proc/loadavg", "1.01 0 0 1/1 1\n");
  EXPECT_EQ(why(), "load average 1.01 on 4 CPUs|");
  write("proc/loadavg", "nan 0 0\n");
  EXPECT_NE(why(), "");
  fs::remove(root_ / "proc/loadavg");
  EXPECT_EQ(why(), "the load is not known|");
}

TEST_F(MadeUpMachine, IsNotWithABuildThatIsNotOptimised) {
  EXPECT_EQ(why({.instructions = {}, .compiler = {}, .optimised = false}),
            "this build is not optimised|");
}

TEST(Machine, OfWhichNothingIsKnownIsNotRepresentative) {
  const Machine machine = look_at_machine("/nonexistent");
  EXPECT_EQ(why_not_representative(machine, kGoodBuild).size(), 4U);
}

TEST(CpuList, ReadsWhatTheKernelWritesAndWritesItAgain) {
  for (const auto* list : {"", "0", "0-3", "0-2,5", "1,3,5-6"})
    EXPECT_EQ(cpu_list(parse_cpus(list)), list);
  EXPECT_TRUE(parse_cpus("nonsense").empty());
  EXPECT_LE(parse_cpus("0-2000000000").size(), 1025U + 1U);
}

}  // namespace
}  // namespace plumb::offline::bench
