// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <set>

#include "rt/doctor_report.hpp"
#include "tests/drivers/fake_machine.hpp"

namespace plumb::drivers::rt {
namespace {

using tests::FakeMachine;

const std::vector<RtStep> kAllGranted = {
    {.kind = RtStepKind::kPriority, .grant = Grant::kGranted, .asked = 80},
    {.kind = RtStepKind::kMemoryLocked, .grant = Grant::kGranted},
    {.kind = RtStepKind::kIdleStates, .grant = Grant::kGranted}};

Examination examined(const FakeMachine& machine, int cycle_us = 4000,
                     const std::vector<RtStep>& steps = kAllGranted) {
  const auto can = can_interfaces(machine.files());
  return {.cycle_us = cycle_us, .checks = examine(machine.files(), steps, can), .can = can};
}

Finding finding(const Examination& seen, const std::string& id) {
  const auto it = std::find_if(seen.checks.begin(), seen.checks.end(),
                               [&](const Check& check) { return check.id == id; });
  if (it == seen.checks.end()) throw std::out_of_range(id);
  return it->finding;
}

TEST(Doctor, FindsAGoodMachineFitForEveryCycle) {
  const FakeMachine machine;
  for (const int cycle_us : {250, 1000, 4000}) {
    const Examination seen = examined(machine, cycle_us);
    EXPECT_TRUE(seen.fit()) << verdict(seen);
    for (const auto& check : seen.checks)
      EXPECT_EQ(check.finding.grant, Grant::kGranted) << check.id << ": " << check.finding.why;
  }
  EXPECT_EQ(verdict(examined(machine)), "fit for a 4 ms cycle: yes");
  EXPECT_EQ(verdict(examined(machine, 250)), "fit for a 250 us cycle: yes");
}

/// One thing wrong with a machine, and what must be said of it.
struct Defect {
  const char* file;
  const char* text;
  const char* id;
  const char* why;
  bool decides_at_4_ms;
  bool decides_at_1_ms;
};

constexpr Defect kDefects[] = {
    {"proc/version", "Linux version 6.1.0-56-amd64 (x) #1 SMP PREEMPT_DYNAMIC Debian\n", "kernel",
     "6.1.0-56-amd64 is not PREEMPT_RT", true, true},
    {"proc/cpuinfo", "flags\t\t: fpu hypervisor\n", "machine",
     "this is a virtual machine: its host may take the processor away", true, true},
    {"sys/hypervisor/type", "xen\n", "machine",
     "this is a virtual machine: its host may take the processor away", true, true},
    {"sys/devices/system/clocksource/clocksource0/current_clocksource", "hpet\n", "clocksource",
     "hpet as clock source: every reading is slow", false, true},
    {"proc/sys/kernel/sched_rt_runtime_us", "950000\n", "rt_throttling",
     "real-time threads stop after 950000 of 1000000 us", false, false},
    {"sys/kernel/mm/transparent_hugepage/enabled", "[always] madvise never\n", "huge_pages",
     "huge pages are made in the background, which moves pages", false, true},
    {"sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave\n", "governor",
     "performance, powersave: the clock frequency changes, and takes its time", false, true},
    {"sys/devices/system/cpu/isolated", "\n", "isolated",
     "no CPU is isolated: the cycle shares its own with others; nohz_full 1", false, true},
    {"sys/devices/system/cpu/smt/active", "1\n", "hyper_threading",
     "hyper-threading: CPUs ? share a core", false, true},
};

TEST(Doctor, SaysWhatIsWrongAndLetsItDecideWhereItMatters) {
  for (const auto& defect : kDefects) {
    const FakeMachine machine;
    machine.write(defect.file, defect.text);
    EXPECT_EQ(finding(examined(machine), defect.id).grant, Grant::kDenied) << defect.id;
    EXPECT_EQ(finding(examined(machine), defect.id).why, defect.why);
    EXPECT_EQ(examined(machine, 4000).fit(), !defect.decides_at_4_ms) << defect.id;
    EXPECT_EQ(examined(machine, 1000).fit(), !defect.decides_at_1_ms) << defect.id;
    const auto reason = std::string("no, because ") + defect.why;
    EXPECT_EQ(verdict(examined(machine, 1000)),
              "fit for a 1 ms cycle: " + (defect.decides_at_1_ms ? reason : "yes"));
  }
}

TEST(Doctor, GivesARemedyForEveryDefectButAVirtualMachine) {
  for (const auto& defect : kDefects) {
    const FakeMachine machine;
    machine.write(defect.file, defect.text);
    const Finding seen = finding(examined(machine), defect.id);
    EXPECT_EQ(seen.remedy.empty(), std::string(defect.id) == "machine") << defect.id;
    EXPECT_EQ(seen.remedy.find('\n'), std::string::npos);
  }
}

TEST(Doctor, IsUnfitForAnyCycleWhereNoPriorityOrNoLockedMemoryIsGranted) {
  const FakeMachine machine;
  machine.write_limits("0", "8388608");
  for (const std::size_t denied : {0U, 1U}) {
    auto steps = kAllGranted;
    steps[denied].grant = Grant::kDenied;
    steps[denied].error = EPERM;
    const Examination seen = examined(machine, 100'000, steps);
    EXPECT_FALSE(seen.fit());
    EXPECT_NE(verdict(seen).find("Operation not permitted"), std::string::npos) << verdict(seen);
    const Finding limit = finding(seen, denied == 0 ? "rlimit_rtprio" : "rlimit_memlock");
    EXPECT_EQ(limit.grant, Grant::kDenied);
    EXPECT_EQ(limit.why, denied == 0 ? "0: too little" : "8192 kB: too little");
    EXPECT_FALSE(limit.remedy.empty());
  }
}

TEST(Doctor, TakesALimitLightlyWhenWhatItLimitsWasGranted) {
  const FakeMachine machine;
  machine.write_limits("0", "8388608");
  const Examination seen = examined(machine);
  EXPECT_TRUE(seen.fit());
  EXPECT_EQ(finding(seen, "rlimit_rtprio").why, "0, yet what it limits was granted");
  EXPECT_EQ(finding(seen, "rlimit_memlock").why, "8192 kB, yet what it limits was granted");
}

TEST(Doctor, ReadsOfAnotherMachineEveryCanInterfaceAndNothingElse) {
  const FakeMachine machine;
  machine.write_can("can1", "0x40080", "16", "0");
  machine.write_can("can2", "0x40041", "16", "0");
  machine.write("sys/class/net/canal/type", "1\n");
  const Examination seen = examined(machine);
  ASSERT_EQ(seen.can.size(), 3U);
  EXPECT_EQ(finding(seen, "can:can0").why, "up, CAN FD, bit rate unknown");
  EXPECT_EQ(finding(seen, "can:can1").why, "down, classic CAN, bit rate unknown");
  EXPECT_EQ(finding(seen, "can:can2").why, "bus-off, classic CAN, bit rate unknown");
  EXPECT_TRUE(seen.fit()) << "no interface decides";
  machine.remove("sys/class/net");
  EXPECT_EQ(finding(examined(machine), "can").grant, Grant::kSkipped);
}

/// As the kernel tells of them.
const std::vector<CanInterface> kInterfaces = {
    {.name = "can0",
     .kind = "can",
     .up = true,
     .carrier = true,
     .fd = true,
     .bit_rate = 500'000,
     .data_bit_rate = 2'000'000,
     .restart_ms = 100},
    {.name = "can1", .kind = "can"},
    {.name = "can2", .kind = "can", .up = true, .bit_rate = 125'000, .restart_ms = 0},
    {.name = "vcan0", .kind = "vcan", .up = true, .carrier = true, .fd = true}};

TEST(Doctor, SaysOfEveryCanInterfaceItsStateFramesAndBitRates) {
  const auto checks = can_checks(kInterfaces);
  ASSERT_EQ(checks.size(), 4U);
  const auto is = [&](std::size_t i, Grant grant, const char* why, const char* remedy) {
    EXPECT_EQ(checks[i].finding.grant, grant) << i;
    EXPECT_EQ(checks[i].finding.why, why);
    EXPECT_EQ(checks[i].finding.remedy, remedy);
    EXPECT_EQ(checks[i].need, Need::kAdvice);
  };
  is(0, Grant::kGranted,
     "up, CAN FD, 500000 bit/s, data 2000000 bit/s, restarts 100 ms after bus-off", "");
  is(1, Grant::kDenied, "down, classic CAN, no bit rate set",
     "sudo ip link set can1 down && sudo ip link set can1 up type can bitrate 1000000 restart-ms "
     "100");
  is(2, Grant::kDenied,
     "bus-off, classic CAN, 125000 bit/s, stays bus-off until someone restarts it",
     "sudo ip link set can2 type can restart");
  is(3, Grant::kGranted, "up, CAN FD, vcan, without a bit rate", "");
}

TEST(Doctor, ShowsCanInterfacesInTextAndJson) {
  const Examination seen{.checks = can_checks(kInterfaces), .can = kInterfaces};
  EXPECT_NE(to_text(seen).find("granted  can0            up, CAN FD, 500000 bit/s, data 2000000"),
            std::string::npos)
      << to_text(seen);
  const Json json = to_json(seen)["can_interfaces"];
  EXPECT_EQ(json[0], (Json{{"name", "can0"},
                           {"kind", "can"},
                           {"state", "up"},
                           {"fd", true},
                           {"bit_rate", 500'000},
                           {"data_bit_rate", 2'000'000},
                           {"restart_ms", 100}}));
  EXPECT_EQ(json[1]["state"], "down");
  EXPECT_EQ(json[2]["state"], "bus-off");
  EXPECT_EQ(json[3]["bit_rate"], nullptr);
  EXPECT_EQ(json[3]["bit_rate_reason"], "a virtual interface has none");
}

TEST(Doctor, DoesNotCallAMachineFitOfWhichItSawNothing) {
  const FakeMachine machine;
  machine.remove("proc");
  machine.remove("sys");
  const Examination seen = examined(machine, 4000, {});
  EXPECT_FALSE(seen.fit());
  for (const auto& check : seen.checks) EXPECT_NE(check.finding.grant, Grant::kGranted) << check.id;
}

TEST(Doctor, PutsNoNewLineOrEmptyWordsIntoItsReport) {
  const FakeMachine machine;
  const Json json = to_json(examined(machine));
  std::set<std::string> ids;
  for (const auto& check : json["checks"]) {
    EXPECT_TRUE(ids.insert(check["check"]).second) << check;
    EXPECT_FALSE(check["why"].get<std::string>().empty()) << check;
    EXPECT_EQ(check["why"].get<std::string>().find('\n'), std::string::npos) << check;
  }
}

}  // namespace
}  // namespace plumb::drivers::rt
