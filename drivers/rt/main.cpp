// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_doctor.hpp"

int main(int argc, char** argv) {
  plumb::drivers::rt::Program program;
  plumb::drivers::rt::add_doctor(program);
  return program.run(argc, argv);
}
