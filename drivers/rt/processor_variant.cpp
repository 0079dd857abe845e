// SPDX-License-Identifier: Apache-2.0
#include "rt/processor_variant.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "program/machine_code.hpp"

namespace plumb::drivers::rt {
namespace {

/// The whole set of x86-64-v3, and that the operating system keeps the wide registers.
bool processor_runs_v3() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  __builtin_cpu_init();
  return __builtin_cpu_supports("x86-64-v3") != 0;
#else
  return false;  // clang 14 does not know the name of the set
#endif
}

bool is_v3() { return std::string_view(machine_code()) == "x86-64-v3"; }

bool baseline_is_asked_for() {
  const char* const variant = std::getenv("PLUMB_RT_VARIANT");
  return variant != nullptr && std::string_view(variant) == "baseline";
}

}  // namespace

std::filesystem::path v3_program() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return {};
  return self.parent_path().parent_path() / "libexec/plumb/x86-64-v3/plumb-rt";
}

void become_best_variant(char** arguments) {
  if (is_v3() || baseline_is_asked_for() || !processor_runs_v3()) return;
  const auto program = v3_program();
  if (!program.empty()) ::execv(program.c_str(), arguments);
}

Check machine_code_check() {
  Check out{.id = "machine_code", .finding = {.what = "machine code"}};
  const bool could_be_faster = !is_v3() && processor_runs_v3();
  out.finding.grant = could_be_faster ? Grant::kDenied : Grant::kGranted;
  out.finding.why = machine_code();
  if (!could_be_faster) return out;
  out.finding.why +=
      baseline_is_asked_for()
          ? ", since PLUMB_RT_VARIANT=baseline is set: the processor could run x86-64-v3"
          : fmt::format(": the processor could run x86-64-v3, but there is no {}",
                        v3_program().string());
  if (baseline_is_asked_for())
    out.finding.remedy = "unset PLUMB_RT_VARIANT";
  else if (v3_program().string().starts_with("/usr/"))  // it came as a package
    out.finding.remedy = "sudo apt-get install --reinstall plumb-rt";
  return out;
}

}  // namespace plumb::drivers::rt
