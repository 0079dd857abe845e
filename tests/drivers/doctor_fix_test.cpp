// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "program/problem.hpp"
#include "rt/machine_settings.hpp"
#include "tests/drivers/fake_machine.hpp"

namespace plumb::drivers::rt {
namespace {

using tests::FakeMachine;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

std::vector<MachineSetting> settings(const FakeMachine& machine) {
  return machine_settings(machine.files());
}

std::string command_line(const FakeMachine& machine) {
  for (const MachineSetting& setting : settings(machine))
    if (setting.file.filename() == "90-plumb.cfg.review") return setting.text;
  return "";
}

std::string code_of_refusal(const FakeMachine& machine, FixMode mode) {
  try {
    write_settings(machine.root(), settings(machine), mode);
  } catch (const Failure& failure) {
    return failure.problems().front().code;
  }
  return "";
}

TEST(DoctorFix, WritesEverySettingAndNothingTheSecondTime) {
  const FakeMachine machine;
  for (const auto& file : write_settings(machine.root(), settings(machine), FixMode::kWrite))
    EXPECT_EQ(file.state, Fix::State::kWritten) << file.path;
  for (const MachineSetting& setting : settings(machine)) {
    EXPECT_EQ(text_of(machine.root() / setting.file), setting.text);
    EXPECT_EQ(setting.text.rfind("# Written by plumb-rt doctor --fix", 0), 0U);  // as postrm asks
  }
  for (const auto& file : write_settings(machine.root(), settings(machine), FixMode::kWrite))
    EXPECT_EQ(file.state, Fix::State::kThereAlready) << file.path;
}

TEST(DoctorFix, WritesNothingInADryRun) {
  const FakeMachine machine;
  for (const auto& file : write_settings(machine.root(), settings(machine), FixMode::kDryRun))
    EXPECT_EQ(file.state, Fix::State::kWouldWrite) << file.path;
  EXPECT_FALSE(std::filesystem::exists(machine.root() / "etc"));
}

TEST(DoctorFix, LeavesEveryFileAloneIfOneOfThemIsSomebodyElses) {
  const FakeMachine machine;
  machine.write("etc/security/limits.d/90-plumb.conf", "@plumb - rtprio 50\n");
  EXPECT_EQ(code_of_refusal(machine, FixMode::kWrite), "E-EXISTS");
  EXPECT_EQ(code_of_refusal(machine, FixMode::kDryRun), "E-EXISTS");
  EXPECT_FALSE(std::filesystem::exists(machine.root() / "etc/sysctl.d"));
  EXPECT_EQ(code_of_refusal(machine, FixMode::kForce), "");
  EXPECT_EQ(text_of(machine.root() / "etc/security/limits.d/90-plumb.conf"),
            settings(machine)[1].text);
}

TEST(DoctorFix, TheCommandLineIsNotActiveAndIsolatesTheLastCore) {
  const FakeMachine machine;
  EXPECT_NE(command_line(machine).find("isolcpus=managed_irq,domain,1 nohz_full=1 rcu_nocbs=1 "
                                       "irqaffinity=0\""),
            std::string::npos)
      << command_line(machine);
  EXPECT_EQ(command_line(machine).find("nosmt"), command_line(machine).npos);
}

TEST(DoctorFix, OfTwoProcessorsOfACoreItIsolatesTheOneThatStays) {
  const FakeMachine machine;
  machine.write("sys/devices/system/cpu/smt/active", "1\n");
  const char* const cores[] = {"0,2", "1,3", "0,2", "1,3"};
  for (int i = 0; i < 4; ++i)
    machine.write(
        "sys/devices/system/cpu/cpu" + std::to_string(i) + "/topology/thread_siblings_list",
        std::string(cores[i]) + "\n");
  EXPECT_NE(command_line(machine).find("isolcpus=managed_irq,domain,1 "), std::string::npos);
  EXPECT_NE(command_line(machine).find("irqaffinity=0 nosmt\"\n"), std::string::npos);
}

TEST(DoctorFix, SaysWhatNoFileCanChange) {
  const FakeMachine machine;
  const std::vector<Check> good = kernel_checks(machine.files());
  EXPECT_EQ(beyond_settings(machine.files(), good).size(), 1U);  // the firmware
  machine.write("proc/version", "Linux version 6.1.0-56-amd64 (x) #1 SMP PREEMPT_DYNAMIC Debian\n");
  const std::vector<Check> poor = kernel_checks(machine.files());
  ASSERT_EQ(beyond_settings(machine.files(), poor).size(), 2U);
  EXPECT_NE(beyond_settings(machine.files(), poor)[0].find("linux-image-rt-"), std::string::npos);
}

TEST(DoctorFix, SaysThatOneCoreCannotBeIsolated) {
  const FakeMachine machine;
  machine.remove("sys/devices/system/cpu/cpu1");
  EXPECT_EQ(command_line(machine), "");
  EXPECT_EQ(beyond_settings(machine.files(), {}).size(), 2U);
}

}  // namespace
}  // namespace plumb::drivers::rt
