/* SPDX-License-Identifier: Apache-2.0 */
/* The same from C. */
#include <plumb.h>
#include <stdio.h>

int main(int count, char** arguments) {
  (void)count;
  char why[200] = "";
  plumb_robot* robot = NULL;
  const plumb_result result = plumb_load_file(arguments[0], NULL, &robot, why, sizeof why);
  printf("%s: %s\n", plumb_result_text(result), why);
  return result == PLUMB_UNREADABLE && robot == NULL ? 0 : 1;
}
