// SPDX-License-Identifier: Apache-2.0
#include "rt/processor_variant.hpp"
#include "rt/verb_control.hpp"
#include "rt/verb_doctor.hpp"
#include "rt/verb_events.hpp"
#include "rt/verb_install.hpp"
#include "rt/verb_replay.hpp"
#include "rt/verb_run.hpp"
#include "rt/verb_seal.hpp"
#include "rt/verb_versions.hpp"

int main(int argc, char** argv) {
  using namespace plumb::drivers;
  rt::become_best_variant(argv);
  plumb::Program program(
      {.name = "plumb-rt",
       .about = "The controller-side program: the real-time cycle between a target source and the "
                "robot controller.",
       .examples = "  plumb-rt doctor --cycle-us 1000   # is this machine fit for 1 kHz?\n"
                   "  plumb-rt run mycell/deploy        # what plumb deploy wrote, until SIGTERM",
       .first = "plumb-rt doctor",
       .manual = {.files = {{"robot.plumb", "the model, in the folder that plumb deploy wrote"},
                            {"rt.toml", "the bus, the cycle and the limits, in the same folder"},
                            {"/etc/plumb/keys.d/", "the keys that may sign deploy folders here"},
                            {"/etc/plumb/plumb-rt.toml",
                             "unsigned = \"allowed\" lets unsigned folders run all the same"},
                            {"/var/lib/plumb/NAME/", "a place: what install has put there"}},
                  .exits = plumb::ExitRow::Of::kBusPrograms,
                  .see_also = {"plumb", "plumb-twin"}}},
      plumb::WorksIn::kAnywhere);
  rt::add_run(program);
  rt::add_status(program);
  rt::add_monitor(program);
  rt::add_swap(program);
  rt::add_install(program);
  rt::add_rollback(program);
  rt::add_list(program);
  rt::add_verify(program);
  rt::add_events(program);
  rt::add_seal(program);
  rt::add_replay(program);
  rt::add_doctor(program);
  return program.run(argc, argv);
}
