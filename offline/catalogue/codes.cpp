// SPDX-License-Identifier: Apache-2.0
#include "catalogue/explanation.hpp"

namespace plumb::offline {
namespace {

constexpr Explanation kCodes[] = {
    {"E-USAGE", "The command line is not right. plumb VERB --help begins with two examples."},
    {"E-USAGE-VERB", "There is no such verb. plumb --help lists them in the order of work."},
    {"E-GATE-RMS",
     "The held-out RMS exceeds --max-rms. No run was kept; plumb compare shows where it fails."},
    {"E-GATE",
     "compile --gate: the audit has a warning, or 95 % of the held-out poses are not within the "
     "cell's tolerance. No model was written."},
    {"E-GATE-TIME",
     "bench --max-us: a whole step of the cycle takes longer in the median. On a machine that is "
     "not representative that says little: the same gate on the controller's own PC counts."},
    {"W-BENCH-HEAP",
     "While the cycle was timed, it took memory from the heap. It must not: an allocation can take "
     "any time. The tests of the runtime would have failed, so report it with the model file."},
    {"E-RUN-BASE",
     "The run was made with fit --base controller, and the controller's positions are not those of "
     "the arm in cell.toml: it has values of its own. On the bus plumb-rt computes where the "
     "controller believes to be with the arm of the cell, and would refuse. With the controller's "
     "own DH values in [robot] joints both are the same."},
    {"E-RUN-DATA",
     "The run was made from other measurement files than the cell has now, so its predictions "
     "belong to other poses. Fit again, or put the old files back."},
    {"E-RUN-DAMAGED",
     "run.json or predictions.csv of a run cannot be read. Runs are never changed by plumb: delete "
     "the damaged folder and fit again."},
    {"E-RUN-MISSING", "There is no run of that number under runs/. plumb runs lists them."},
    {"N-RUN-NEW",
     "compare, compile and predict fit first if no run belongs to the present cell file and data."},
    {"W-RUN-NODATA",
     "The history was read, but not the cell's measurements; so it is not known which run is the "
     "current one."},
    {"E-ADD-TWICE",
     "The model already has that effect at these joints, with the same settings; nothing was "
     "changed. [effects] in cell.toml lists what it has. An effect may stand there a second time "
     "at "
     "other joints or with other settings."},
    {"E-DROP-NONE",
     "The model does not have that effect, or not at these joints or with these settings; nothing "
     "was changed. Geometry cannot be dropped: hold its parameters with [fit] fixed instead."},
    {"E-PLAN-BOX",
     "plan draws random poses within the joint limits and keeps those whose reflector lies in the "
     "box. None did: the box is out of reach, in another frame than the base, or in another unit "
     "than mm."},
    {"E-PLAN-EFFECT",
     "plan --separate takes two effects of the library by name, each with its joints joined by '+' "
     "and its numbers: gear_ripple:J2@cycles_per_turn=20,gear_harmonics:J2."},
    {"N-PLAN-NOMINAL",
     "There are no measurements yet, or too few for a fit, so the poses were chosen for the "
     "nominal "
     "arm. That makes little difference: derivatives hardly depend on errors of a millimetre."},
    {"E-CHECK-CONVENTION",
     "The files are not meant as they are labelled: another DH convention, unit, joint direction "
     "or "
     "handedness explains the points far better. plumb check lists every reading with what it "
     "leaves; --fix writes the best one."},
    {"E-CHECK-NOFIT",
     "Neither the labels nor any other reading of units, conventions and directions explains the "
     "points. Look for joints in another order, joints coupled by a linkage, rows that belong to "
     "another arm, or a wrong DH table."},
    {"E-CHECK-LIMITS",
     "Joint readings lie outside the limits in cell.toml, which a real arm cannot do. Either the "
     "limits are too narrow, or the readings are in another unit, direction or turn."},
    {"E-CHECK-EQUAL",
     "Every row has the same joint positions, so nothing about the arm can be learnt. Repeats of "
     "one pose give the noise only."},
    {"E-CHECK-NOTHING",
     "Not one number of the arm can be told from these poses better than it is known already."},
    {"E-CHECK-FEW",
     "The distinct poses give no more coordinates than there are numbers to find. Repeats do not "
     "count: they tell of the noise only."},
    {"W-CHECK-FEW",
     "The distinct poses give hardly more coordinates than there are numbers to find, so that the "
     "fit can follow the noise."},
    {"W-CHECK-COPY",
     "Readings that agree to the last digit are copies: a tracker never repeats itself like that. "
     "They make the noise look smaller than it is."},
    {"W-CHECK-OUTLIER",
     "Readings lie farther from where all others put them than noise or an unknown effect "
     "explains: "
     "a wrong row, a broken beam, a reflector that slipped. The fit leaves them out and lists "
     "them."},
    {"W-CHECK-STILL",
     "A joint that never moves shows nothing of itself, and what is behind it looks like one "
     "link."},
    {"N-CHECK-CONSTANT",
     "A context column that never changes cannot explain anything; the effects that need it are "
     "listed as not testable."},
    {"W-CHECK-COVERAGE",
     "The poses use less than half of the limits of a joint. A calibration is trusted where it was "
     "measured, so predictions far from there are guesses."},
    {"W-CHECK-ROUNDED",
     "The digits of the joint columns tell that they were rounded, by so much that it shows beside "
     "the noise. Commanded values that the controller meets exactly may be round; readings not."},
    {"W-CHECK-SEPARATE",
     "Two or more numbers of the arm move the measured point in the same way at all these poses, "
     "though not at others. One is held at nominal. Poses that move the named joint separate "
     "them."},
    {"W-CHECK-DIRECTION",
     "check --fix wrote measurements whose joints count the way the DH table does. The targets of "
     "correct and the controller must count the same way, or the DH table must be turned instead."},
    {"N-CHECK-CONVENTION",
     "There are too few different poses or axes to tell conventions apart, so the labels were "
     "believed."},
    {"N-CHECK-UNDECIDED",
     "A reading that differs from the labels in one thing predicts the same points, so that these "
     "measurements say nothing about it: the direction of a last joint whose axis runs through the "
     "reflector, say. The label was kept."},
    {"N-CHECK-NOISE",
     "Without repeats and without a stated sigma nothing can be compared with the noise floor."},
    {"E-URDF",
     "The file is no URDF, or not whole: an element or attribute that every robot needs lacks."},
    {"E-URDF-TIP",
     "The arm goes from the file's root to one link. If several links end the tree, name one: "
     "--tip."},
    {"E-URDF-JOINT",
     "plumb calibrates serial arms of 1 to 9 revolute or sliding joints. Mimicking, floating and "
     "planar "
     "joints on the way to the tip are not of that kind."},
    {"N-NEW-CONVENTION",
     "The same arm can be written in both DH conventions. From a URDF either is computed; choose "
     "the "
     "one your controller's documents use."},
    {"W-EXPORT-LOST",
     "URDF says where joints and links are, and nothing about elasticity, gear errors or trees. "
     "The "
     "model file of plumb compile holds them all."},
    {"E-IMPORT-BINARY",
     "import reads text. Export the measurements as text (CSV) from the program they come from."},
    {"E-IMPORT-EMPTY", "There is nothing in the file."},
    {"E-IMPORT-HEADER",
     "No line names the columns, or none of the names is known. Name them yourself: --header "
     "\"pose,q1_deg,...,x_mm,y_mm,z_mm\"."},
    {"E-IMPORT-RAGGED",
     "A row has more or fewer cells than the header. Often the last line was cut off while "
     "copying, "
     "or the separator was not recognised: --separator."},
    {"E-IMPORT-ROWS", "The file has a header, and nothing below it."},
    {"E-IMPORT-DECIMAL",
     "Every comma of the file has three digits behind it: it may divide thousands or decimals. Say "
     "which with --decimal."},
    {"E-IMPORT-NUMBER", "A column of numbers holds something else. NaN and infinity are none."},
    {"E-IMPORT-UNIT",
     "A recognised column does not say its unit. Name it: --map \"X=x_mm\". A wrong unit is the "
     "commonest cause of a wrong calibration, so none is assumed. Units that plumb does not know, "
     "cm "
     "for example, are not converted: do that where the file comes from."},
    {"W-IMPORT-UNIT",
     "The same of a preview, which shows the rest of the file all the same. Without --preview it "
     "is "
     "an error."},
    {"E-IMPORT-MAP",
     "--map names a column that the file has not, a new name without a unit, or one column twice."},
    {"E-IMPORT-TWICE", "Two columns would become the same one. Leave one out with --map OLD=-."},
    {"E-IMPORT-ROT",
     "The order of three turns: xyz-fixed is R = Rz Ry Rx, xyz-moving is R = Rx Ry Rz, and so on "
     "for every order of axes."},
    {"E-IMPORT-JOIN", "The two files cannot be laid side by side in the way asked for."},
    {"N-IMPORT-ENCODING", "The file was not UTF-8 and was converted."},
    {"N-IMPORT-PREAMBLE",
     "Lines above the header that are neither comments nor data were skipped."},
    {"N-IMPORT-MIDNIGHT", "A clock without a date jumped back: a day was added from there on."},
    {"N-IMPORT-ROT",
     "Three angles say nothing without the order of the turns. State it with --rot, or they are "
     "left out."},
    {"N-IMPORT-LEFT",
     "These columns mean nothing to plumb. --map keeps them under a name of yours."},
    {"W-IMPORT-TIME",
     "A spreadsheet has rewritten the time stamps so that they cannot be recovered. Export again "
     "and do not open the file in between."},
    {"W-IMPORT-SHIFT",
     "Joined by order, the files fit the arm only if one is shifted: a row is missing or too "
     "many."},
    {"W-IMPORT-PARTNERS", "Rows that have no partner in the other file were dropped."},
    {"E-FIT-CONVERGE",
     "The calibration did not settle. Most often a unit, the sign or zero of a joint, or the DH "
     "convention is wrong, so that no small change of the arm explains the measurements."},
    {"E-FIT-FEW",
     "There are fewer measured coordinates than parameters. Measure more poses, or "
     "hold parameters with [fit] fixed."},
    {"E-FIT-ONE-POSE",
     "The arm hardly moves between the poses, so nothing tells its numbers apart. Units are not to "
     "blame: measure poses all over the workspace; plumb plan chooses them."},
    {"E-FIT-FORMULA",
     "A formula divides by zero, takes the root or logarithm of a negative number or is otherwise "
     "no number at one of the poses, or its value is beyond 1 m or 1 rad or its slope infinite, so "
     "it cannot be fitted. In the cycle it then moves nothing, "
     "and the status is context-fallback."},
    {"E-FIT-MISS",
     "The calibration settled, but the points are still missed by more than 1 % of the length of "
     "all links. No error of an arm is that large: a unit, the sign or zero of a joint, the DH "
     "convention or the order of the columns is wrong. plumb check tries them."},
    {"E-FIT-FAR",
     "The fit meets the points only by bending the nominal arm by more than 100 mm or 10 deg. Then "
     "cell.toml describes another arm, or the same one in the other DH convention."},
    {"E-FIT-BASE",
     "fit --base controller calibrates on top of the positions that the controller itself computes "
     "at each pose. They belong into the measurements: nx_mm, ny_mm, nz_mm, one for each measured "
     "axis."},
    {"E-FIT-BASE-FAR",
     "The positions nx, ny, nz differ from those of the nominal arm by more than 1 % of the length "
     "of all links, even with the best base frame and tool. A unit, the order of columns or rows, "
     "or the arm in cell.toml is wrong."},
    {"W-FIT-AMBIGUOUS",
     "Two positions of the tracker explain these poses almost equally well, for example one turned "
     "by 180 deg when all points lie in a plane. State the frame, or measure poses that differ."},
    {"W-FIT-FAR",
     "A fitted number of the arm ended far from its nominal value, farther than arms are built "
     "wrong. Often the nominal value is mistyped, or belongs to another variant of the robot."},
    {"W-FIT-IMPOSSIBLE",
     "A number of an effect ended where its law cannot be, by more than three sigma: a spring that "
     "pushes the wrong way, say. The effect imitates another one that the model lacks, or masses "
     "or "
     "signs are wrong."},
    {"W-FIT-OUTLIERS",
     "Some poses lie farther from what all others predict than six times their usual scatter: a "
     "bumped reflector, a broken beam, a mistyped number. They were not fitted. Held-out poses are "
     "never left out of the held-out error; a second figure without the outliers stands beside."},
    {"W-FIT-HELD-OUTLIERS",
     "Some held-out poses lie farther off than six times the usual scatter of the others: bad "
     "readings, or places where the model fails. Held-out figures are never trimmed, so they "
     "count; "
     "a second line shows the rest."},
    {"W-FIT-HELD-TWICE",
     "Rows of the fit repeat poses that are held out: the same joints or the same name. Held-out "
     "poses must have no say, so these rows were not fitted."},
    {"W-FIT-STILL",
     "A joint stood still in every pose of the fit. What is wrong behind it looks like something "
     "else, and held-out poses that are alike do not show it: the figures hold for that position "
     "only."},
    {"W-CSV-AXES",
     "One or two of x, y, z are missing although the arm moves in space. The fit goes on with what "
     "there is, and every error is of the given axes only: smaller than that of the point."},
    {"N-FIT-ORIENTATION",
     "The file holds orientations, but the cell does not say how good they are: they were left "
     "out. State [measurement] sigma_urad to use them."},
    {"E-SPLIT",
     "The rule for the held-out poses cannot be met by these measurements: too few poses, or marks "
     "in column set that leave nothing to fit or to hold out."},
    {"W-AUDIT-LIMIT",
     "Somewhere in the trained domain the correction is larger than the guard allows and would be "
     "cut there. Either the limit [deploy] max_correction_mm is too small for this arm, or the "
     "calibration is wrong."},
    {"W-AUDIT-JUMP",
     "Two neighbouring leaves of the tree disagree by more than a tenth of the guard's limit at "
     "their border, so a path across it gets a step that the guard has to spread over time. More "
     "poses near the border, or the missing physical effect, make it smaller."},
    {"W-AUDIT-SIGMA",
     "From the scatter of the fit follows how well the tool's place is known all over the trained "
     "range: there it is known worse than a third of the largest correction. Poses are too few, "
     "too "
     "alike, or two numbers of the model imitate each other."},
    {"W-AUDIT-STILL",
     "A joint never moved in the fitted poses. Elsewhere the model corrects blindly: measure poses "
     "all over the range that the robot will use."},
    {"W-COMPILE-TOLERANCE",
     "The model was compiled, but its held-out error does not keep [cell] tolerance_mm: at 95 % of "
     "the poses, or three times over at the worst. With --gate nothing would have been written."},
    {"N-COMPILE-LEFT",
     "Effects of the measurement or of the procedure (drift, step, tracker, settling_lag) clean "
     "the "
     "other numbers of the fit. They are not the robot's, and are not compiled."},
    {"W-AUDIT-HELD",
     "The model was fitted on every pose, so no pose is left to measure its accuracy with."},
    {"E-EMIT-NO-TREE",
     "compile --emit-c writes the tree alone, and this model has none: [effects] in cell.toml does "
     "not list local_tree, or no tree lowered the cross-validated error, which plumb fit says. No "
     "model was written either."},
    {"E-MODEL-OPEN", "The model file is missing, a folder, or not readable."},
    {"E-MODEL-SIZE", "The file is larger than any model file can be."},
    {"E-MODEL-TRUNCATED", "The file is shorter than it says: a copy was cut off."},
    {"E-MODEL-KIND", "The file is not a model file of plumb."},
    {"E-MODEL-CHECKSUM", "The bytes of the file changed since it was written."},
    {"E-MODEL-NEWER", "The file was written by a newer plumb with a schema this one cannot read."},
    {"E-MODEL-EFFECT",
     "The file lists a physical effect that this program cannot evaluate: a law it does not know, "
     "a "
     "newer version of one, or numbers of another count."},
    {"E-EFFECT-MANY",
     "The cycle reserves room for a fixed number of effects, every wave of a gear being one. Keep "
     "the strongest, and let a local tree learn the rest: [effects.local_tree]."},
    {"E-EFFECT-DATA",
     "A listed effect needs something that these measurements do not hold: the direction from "
     "which "
     "joints came, a temperature, the row after which something moved."},
    {"E-EFFECT-OPTION",
     "add or drop was told something of an effect that it has no option for, or a value or joints "
     "that make no sense. --set takes KEY=VALUE as [effects] in cell.toml does; "
     "cycles_per_turn=7.91,17.49 is two effects at once."},
    {"E-MODEL-MALFORMED", "The structure of the file is broken."},
    {"E-MODEL-INCONSISTENT",
     "The file is whole, but its content makes no sense: a number out of range, a tree that points "
     "outside itself, or parts that do not fit together."},
    {"E-MODEL-UNSOUND",
     "What the compiler made would not pass the reader's own check; nothing was "
     "written. The message names the number."},
    {"E-TARGET-SEED",
     "Each target needs a joint state near it to start from: columns q1_deg ..., or qc1_deg ... "
     "for commanded joints, or --start for the first one."},
    {"E-TARGET-COMMANDED",
     "An arm of more than six joints can reach a pose in many ways; only the commanded joints say "
     "which one is meant. Add columns qc1_deg ..."},
    {"N-TARGET-ORIENTATION",
     "Targets without quaternion: the orientation that the nominal arm has at the seed is kept."},
    {"W-CORRECT-REFUSED",
     "Some targets were refused; column status says why, and the command is the target itself. "
     "plumb explain STATUS tells what each one means."},
    {"N-CSV-REPLACED",
     "The input already had a column of that name, perhaps from an earlier predict; it was "
     "replaced."},
    {"E-DH-COLUMN", "The DH table needs alpha_deg, a_mm, d_mm and theta_deg (or rad, m, in)."},
    {"E-DH-JOINTS", "The DH table has more joints than a model can have."},
    {"E-DH-LIMITS", "A joint's lower limit is not below its upper limit."},
    {"E-DH-TYPE", "A joint is revolute or prismatic."},
    {"N-DH-LIMITS", "The DH table does not give all joint limits; wide ones were taken."},
    {"E-DEMO-NAME", "There is no sample cell of that name. plumb demo --list shows them."},
    {"E-SIM-PLAN", "The simulation that was asked for makes no sense; the message says why."},
    {"E-SIM-EFFECT", "The simulator does not know that effect. plumb simulate --list shows them."},
    {"E-SIM-SIZE",
     "A hidden effect cannot get the size that was asked for: no noise to measure it by, or "
     "nothing "
     "of it is left when geometry has been fitted."},
    {"E-SIM-JOINT", "A joint of a hidden effect does not exist in this cell, or has no size."},
    {"E-CELL-BUS",
     "The bus layout of [deploy.bus], or the default one with this cycle_us, cannot be used: "
     "identifiers or registers out of range or shared, a scale, period or bit rate of 0, a period "
     "so long that its sender counts as silent (50 ms for target, joints, controller and status, "
     "500 ms for actual and robot), a number too small for the arm, or more than 70 % of the bus "
     "at worst. Nothing was written."},
    {"W-DEPLOY-TEMPERATURES",
     "The compiled model listens to temperatures that message context does not bring, so in the "
     "cycle it goes by their declared fallbacks. [deploy.bus] temperatures = [\"temp\", ...] names "
     "those that the controller sends, in any order; a bare number of them is in the order in "
     "which the effects name theirs."},
    {"E-ROOT",
     "plumb-rt doctor --root takes a folder that holds a machine's /proc and /sys; this one holds "
     "no proc."},
    {"E-UNFIT",
     "plumb-rt doctor --strict: the machine denies something that a cycle of this period needs. "
     "Without --strict the checks are listed with what to change."},
    {"E-RT-KEY",
     "rt.toml has a key that plumb-rt does not know; nothing was sent. Rename it as proposed."},
    {"E-RT-TYPE", "A value of rt.toml is of the wrong type. The message says what is expected."},
    {"E-RT-RANGE", "A value of rt.toml is out of its range. The message says which is allowed."},
    {"E-RT-MISSING",
     "rt.toml lacks a key without which plumb-rt does not start; plumb deploy writes a complete "
     "one."},
    {"E-RT-BUS",
     "The bus layout in rt.toml cannot be used, for the same reasons as E-CELL-BUS. Nothing was "
     "sent."},
    {"E-RT-MODEL",
     "The model file is damaged, is none, or needs an effect that this plumb-rt does not know. "
     "Nothing was sent; plumb inspect says more."},
    {"E-RT-SERIAL",
     "The model was made for another robot than rt.toml or the running model names. A correction "
     "of one arm makes another worse, so it is refused."},
    {"E-RT-SUMS",
     "A file of the folder is not what SHA256SUMS lists. Deploy again, or find out who changed "
     "it."},
    {"E-RT-CSV",
     "The file of targets has a wrong column or number. It is read as plumb correct reads its "
     "targets."},
    {"E-RT-LINK",
     "The bus cannot be opened: interface, port, device or rights. Nothing was sent. plumb-rt "
     "doctor lists the CAN interfaces."},
    {"E-RT-RIGHTS",
     "The machine denies SCHED_FIFO or the processor that rt.toml asks for. plumb-rt doctor says "
     "how to grant it; priority = 0 runs without, for trying only."},
    {"W-RT-RIGHTS",
     "The machine denies something that a real-time process should have; cycles may be missed. "
     "plumb-rt doctor says how to grant it."},
    {"W-RT-SENSORS",
     "The model reads a temperature that message context of this bus does not bring; what depends "
     "on it goes by its fallback. Name the sensors in [deploy.bus] temperatures and deploy again."},
    {"E-RT-RUNNING",
     "Another plumb-rt runs from this folder; two would be two senders of one identifier. plumb-rt "
     "status shows it."},
    {"E-RT-NOT-RUNNING", "No plumb-rt runs from this folder, so there is none to ask."},
    {"E-RT-CONTROL",
     "There is no place for the socket over which status, monitor and swap speak to plumb-rt, or "
     "what came over it was no answer."},
    {"E-RT-METRICS",
     "The port for the metrics cannot be listened on; it is taken, or needs a right. It is on the "
     "loopback address only."},
    {"E-RT-RECORD", "The record cannot be made: folder, space or rights."},
    {"E-RT-SINK", "The file of answers cannot be made: folder, space or rights."},
    {"E-RT-SWAP",
     "The new model has another nominal arm or other sensors than the running one, or wants larger "
     "numbers than the layout of the bus has, or a swap is under way. The running model runs on."},
    {"E-RT-LOST",
     "The bus was down for longer than give_up_s of rt.toml; without that key plumb-rt waits for "
     "ever."},
    {"E-RT-CLOCK", "The system's clock cannot sleep, so there is no cycle."},
    {"E-RT-REPLAY", "The file holds no cycle that plumb-rt recorded."},
    {"E-RT-REPLAY-DIFFERS",
     "With this folder the session decides otherwise than it did when it was recorded: another "
     "model, other limits, or another version of plumb-rt."},
    {"E-TWIN-BUS",
     "The bus of the twin cannot be opened, or its layout cannot be used. The message gives the "
     "system's reason."},
    {"E-TWIN-KEY", "twin.toml has a key that plumb-twin does not know."},
    {"E-TWIN-TYPE", "A value of twin.toml is of the wrong type."},
    {"E-TWIN-RANGE", "A value of twin.toml is out of its range."},
    {"E-TWIN-MISSING", "twin.toml lacks a key; plumb-twin new writes a complete one."},
    {"E-TWIN-SILENT",
     "Nothing was heard of plumb-rt in time. Is it running, on the same bus and layout? plumb-rt "
     "status shows it."},
    {"E-TWIN-INACTIVE",
     "plumb-rt answers, but sent no correction in time: rt.toml says mode = \"shadow\", or its "
     "state is not active. plumb-rt status says why."},
    {"E-TWIN-PATH",
     "A station of the path cannot be reached by the nominal arm, or too few lie away from "
     "singular poses."},
    {"E-TWIN-FRAME",
     "The cell fits the tracker's frame or target, so an absolute error has no frame to be stated "
     "in. Give both, as plumb-twin new does."},
    {"E-TWIN-SENSOR",
     "twin.toml lists a temperature that the simulated arm does not measure. It has temp, "
     "temp_room and temp_elbow."},
    {"E-TWIN-FAULT",
     "--fault names no fault, or gives it no size or time. plumb-twin run --list-faults shows "
     "them."},
    {"E-EXPLAIN",
     "plumb explain knows messages, effects, status texts and terms; without a word it lists "
     "them."},
    {"E-FILES", "The operating system refused a file operation: permissions, space, or a path."},
    {"E-MEMORY", "There was not enough memory."},
    {"E-INTERRUPTED", "You stopped the command. Files are written all or nothing."},
};

}  // namespace

std::span<const Explanation> code_explanations() { return kCodes; }

}  // namespace plumb::offline
