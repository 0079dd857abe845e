// SPDX-License-Identifier: Apache-2.0
// plumb-rt as the Debian package installs it: beside a program for better processors.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "program/machine_code.hpp"
#include "tests/drivers/better_code.hpp"
#include "tests/drivers/fake_machine.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

/// A copy of the program, and in the place of the other one a script that says what it was given.
class TwoPrograms {
 public:
  TwoPrograms() {
    fs::create_directories(scratch_.root() / "bin");
    fs::copy_file(PLUMB_RT_PROGRAM, scratch_.root() / "bin/plumb-rt");
    scratch_.write(kOther, "#!/bin/sh\necho \"the other one: $*\"\n");
    fs::permissions(scratch_.root() / kOther, fs::perms(0755));
  }

  fs::path other() const { return scratch_.root() / kOther; }

  std::string says(const std::string& environment) const {
    const std::string command =
        "env " + environment + " " + (scratch_.root() / "bin/plumb-rt").string() + " --version";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    std::string out;
    std::array<char, 256> part{};
    while (std::fgets(part.data(), part.size(), pipe.get()) != nullptr) out += part.data();
    return out;
  }

 private:
  static constexpr const char* kOther = "libexec/plumb/x86-64-v3/plumb-rt";
  tests::FakeMachine scratch_;
};

bool is_itself(const std::string& said) {
  return said.find(std::string("(") + machine_code() + ")") != std::string::npos;
}

TEST(ProcessorVariant, BecomesTheOtherOneWithTheSameWordsWhereTheProcessorCan) {
  const TwoPrograms programs;
  const std::string said = programs.says("");
  if (tests::could_run_better_code())
    EXPECT_EQ(said, "the other one: --version\n");
  else
    EXPECT_TRUE(is_itself(said)) << said;
}

TEST(ProcessorVariant, StaysItselfOnRequest) {
  const TwoPrograms programs;
  EXPECT_TRUE(is_itself(programs.says("PLUMB_RT_VARIANT=baseline")));
}

TEST(ProcessorVariant, StaysItselfIfTheOtherOneCannotBeStarted) {
  const TwoPrograms programs;
  fs::permissions(programs.other(), fs::perms(0644));
  EXPECT_TRUE(is_itself(programs.says("")));
  fs::remove(programs.other());
  EXPECT_TRUE(is_itself(programs.says("")));
}

}  // namespace
}  // namespace plumb
