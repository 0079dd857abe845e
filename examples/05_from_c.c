/* SPDX-License-Identifier: Apache-2.0 */
/* The same from C: load, correct once a cycle, count: 05_from_c robot.plumb */
#include <stdio.h>

#include "plumb.h"

int main(int count, char** arguments) {
  char why[200];
  plumb_robot* robot = NULL;
  plumb_input in;
  plumb_output out;
  plumb_counters counters;
  plumb_joints joints = {sizeof(plumb_joints), 0, {0.3, 0.8}};
  plumb_prediction arm;
  int k;
  if (count != 2) {
    fprintf(stderr, "usage: 05_from_c robot.plumb\n");
    return 2;
  }

  /* Load: slow, may allocate, may fail. A serial instead of NULL binds to one robot. */
  if (plumb_load_file(arguments[1], NULL, &robot, why, sizeof why) != PLUMB_OK) {
    fprintf(stderr, "%s: %s\n", arguments[1], why);
    return 3;
  }
  printf("Plumb %s, %d joints\n", plumb_version(), plumb_joint_count(robot));

  /* The target: where the arm is at these joints; so the correction must find them. */
  arm.size = sizeof arm;
  if (plumb_predict(robot, &joints, &arm) != PLUMB_OK) return 1;

  /* Cycle: fixed cost, never allocates, always returns. */
  plumb_input_init(&in);
  in.arrived = PLUMB_TARGET | PLUMB_MEASURED;
  in.X_BD = arm.X_BT;
  for (k = 0; k < 2; ++k) in.q_measured[k] = joints.q[k] + 0.01;
  out.size = sizeof out;
  for (k = 0; k < 1000; ++k) {
    in.now_ns += 4000000;
    if (plumb_correct(robot, &in, &out) != PLUMB_OK) return 1;
  }
  printf("status %s, joints %.6f %.6f, sent x %+.4f mm, y %+.4f mm\n",
         plumb_status_text(out.status), out.q[0], out.q[1],
         1e3 * (out.X_BC.p_m[0] - in.X_BD.p_m[0]), 1e3 * (out.X_BC.p_m[1] - in.X_BD.p_m[1]));

  counters.size = sizeof counters;
  plumb_read_counters(robot, &counters);
  printf("%u cycles, %u refused\n", (unsigned)counters.steps, (unsigned)counters.refused);
  return plumb_unload(robot) == PLUMB_OK && out.has_output ? 0 : 1;
}
