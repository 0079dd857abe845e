// SPDX-License-Identifier: Apache-2.0
// Loads what is no model: the error must say so.
#include <cstdio>
#include <plumb/robot.hpp>

int main(int, char** arguments) {
  const auto loaded = plumb::Robot::load(arguments[0]);
  if (loaded.robot) return 1;
  std::printf("%s: %s\n", to_string(loaded.error->fault), loaded.error->text.c_str());
  return 0;
}
