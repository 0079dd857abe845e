/* SPDX-License-Identifier: Apache-2.0 */
/* The header alone, read by a C compiler as C99; an own model file is corrected once. */
#include "plumb.h"

#include <stdio.h>
#include <string.h>

static int fail(const char* what) {
  fprintf(stderr, "%s\n", what);
  return 1;
}

int main(int count, char** arguments) {
  char why[200];
  plumb_robot* robot = NULL;
  plumb_input in;
  plumb_output out = {sizeof(plumb_output), 0, 0, 0, {{0}, {0}}, {0}, 0, 0};
  if (count != 2) return fail("usage: header_test robot.plumb");
  if (plumb_load_file(arguments[1], NULL, &robot, why, sizeof why) != PLUMB_OK) return fail(why);
  if (plumb_input_init(&in) != PLUMB_OK) return fail("init");
  if (in.size != sizeof in) return fail("the library knows another plumb_input");
  in.arrived = PLUMB_TARGET | PLUMB_MEASURED | PLUMB_TEMPERATURE(7);
  in.X_BD.p_m[0] = 0.6;
  in.X_BD.p_m[1] = 0.3;
  in.q_measured[0] = 0.1;
  in.q_measured[1] = 0.9;
  if (plumb_correct(robot, &in, &out) != PLUMB_OK) return fail("correct");
  if (out.size != sizeof out) return fail("the size was changed");
  printf("%s, %d joints, %s\n", plumb_version(), plumb_joint_count(robot),
         plumb_status_text(out.status));
  if (plumb_unload(robot) != PLUMB_OK) return fail("unload");
  return 0;
}
