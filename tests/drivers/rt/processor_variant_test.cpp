// SPDX-License-Identifier: Apache-2.0
// What is said of the machine code that runs. That the better one is started is seen with two
// programs: tests/drivers/processor_variant_test.cpp.
#include "rt/processor_variant.hpp"

#include <errno.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "program/machine_code.hpp"
#include "tests/drivers/better_code.hpp"
#include "tests/drivers/child.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

/// With this value of PLUMB_RT_VARIANT, which it removes at the end.
Check check_with(const char* variant) {
  if (variant != nullptr) ::setenv("PLUMB_RT_VARIANT", variant, 1);
  Check out = machine_code_check();
  ::unsetenv("PLUMB_RT_VARIANT");
  return out;
}

TEST(MachineCodeChecks, TheBetterProgramIsLookedForBesideTheFolderOfTheOneThatRuns) {
  const fs::path own = fs::absolute(::program_invocation_name);
  const fs::path beside = own.parent_path() / "../libexec/plumb/x86-64-v3/plumb-rt";
  EXPECT_EQ(fs::weakly_canonical(v3_program()), fs::weakly_canonical(beside));
}

TEST(MachineCodeChecks, IsDeniedOnlyWhereTheProcessorCanDoMoreAndNeverMakesAMachineUnfit) {
  for (const char* const variant : {static_cast<const char*>(nullptr), "baseline", "other"}) {
    const Check check = check_with(variant);
    EXPECT_EQ(check.id, "machine_code");
    EXPECT_EQ(check.finding.grant,
              tests::could_run_better_code() ? Grant::kDenied : Grant::kGranted);
    EXPECT_TRUE(check.finding.why.starts_with(machine_code())) << check.finding.why;
    for (const int cycle_us : {125, 1000, 4000})
      EXPECT_TRUE(obstacles({check}, cycle_us).empty()) << cycle_us;
  }
}

TEST(MachineCodeChecks, SaysWhetherSomebodyAskedForItOrTheOtherProgramIsMissing) {
  if (!tests::could_run_better_code()) {
    EXPECT_EQ(check_with("baseline").finding.remedy, "") << "nothing to mend";
    return;
  }
  const Finding asked = check_with("baseline").finding, missing = check_with(nullptr).finding;
  EXPECT_NE(asked.why.find("PLUMB_RT_VARIANT"), std::string::npos) << asked.why;
  EXPECT_EQ(asked.remedy, "unset PLUMB_RT_VARIANT");
  EXPECT_NE(missing.why.find(v3_program().string()), std::string::npos) << missing.why;
  EXPECT_EQ(missing.remedy.find("unset"), std::string::npos) << missing.remedy;
}

/// The caller goes on as it is where there is no other program, and where none is wanted.
TEST(MachineCodeChecks, WhereThereIsNoBetterProgramThisOneGoesOn) {
  ASSERT_FALSE(fs::exists(v3_program()));
  for (const char* const variant : {"", "baseline"})
    EXPECT_EQ(tests::in_child([&] {
                ::setenv("PLUMB_RT_VARIANT", variant, 1);
                std::string word = "never-run";
                char* arguments[] = {word.data(), nullptr};
                become_best_variant(arguments);
                return 7;
              }),
              7);
}

}  // namespace
}  // namespace plumb::drivers::rt
