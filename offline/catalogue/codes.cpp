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
     "run.json or predictions.csv of a run cannot be read, or its check sum says that it was "
     "edited "
     "or cut off after it was written. Runs are never changed by plumb: fit again, or delete the "
     "damaged folder."},
    {"N-RUN-NOSUM",
     "The run was made by an earlier version, which wrote no check sums: an edited file would go "
     "unnoticed. plumb fit makes a run with them."},
    {"E-CELL-BUSY",
     "Only one plumb at a time changes a cell; add, drop, diagnose --apply, check --fix and "
     "whatever "
     "keeps a run wait up to 10 minutes for the other one. Nothing was written."},
    {"E-CELL-CHANGED",
     "cell.toml was edited, by hand perhaps, after this plumb had read it. What was written there "
     "would have been lost, so nothing was changed. Give the command again."},
    {"E-RUN-MISSING", "There is no run of that number under runs/. plumb runs lists them."},
    {"E-FLEET-NONE",
     "plumb fleet takes a folder whose subfolders are cells, each with a cell.toml. There is none, "
     "or "
     "none of them could be fitted."},
    {"W-FLEET-COPY",
     "Two cells of the fleet have the same measurements, so they are one arm. Counted twice, it "
     "would make arms look alike that are not. Were the files of another arm meant?"},
    {"N-FLEET-OTHER",
     "plumb fleet takes the folders that hold a cell.toml. Others are left out, which is a mistake "
     "only if one of them was meant to be a cell."},
    {"E-FLEET-CELL",
     "The process that fitted this cell ended without a result: it was killed, ran out of memory, "
     "or gave numbers that are not finite. The other cells are not affected. plumb -C CELL fit "
     "says "
     "more."},
    {"W-FLEET-CELL",
     "A cell of a fleet could not be fitted. The others are not affected; it is in the table with "
     "its "
     "reason, and is tried again as soon as its files change."},
    {"E-FILTER-LANGUAGE",
     "plumb filter tells the language of a program from the ending of its name: RAPID .mod .prg, "
     "Fanuc .ls (not the binary .tp), KRL .src with its .dat, URScript .script. They are text, of "
     "one byte a character or UTF-8. Nothing was written."},
    {"E-FILTER-NONE",
     "No target of the programs can be corrected; each is listed with its line, why, and what to "
     "do. Mostly a tool or a work frame is not known, which --tool and --frame say, or where the "
     "joints are, which --start says. Nothing was written."},
    {"E-FILTER-TWICE",
     "The program says in a comment that its targets are corrected already. Corrected twice it "
     "would be wrong by as much as it was at first. Filter the program as it was before."},
    {"N-FILTER-DIGITS",
     "Targets are written with as many decimals as the program has, and these leave a part of the "
     "corrections out. --decimals writes more, if the controller reads them."},
    {"W-FILTER-EMPTY",
     "Nothing of a robot program is found in the file, so that it is written as it was. If it has "
     "targets, its lines may end as no controller ends them (a carriage return alone), or it is in "
     "another language than the ending of its name says."},
    {"W-FILTER-TOOL",
     "The program moves another tool than that of the model. Both poses are counted from the "
     "flange; if the model's Denavit-Hartenberg rows end in a flange that is turned or moved "
     "against that of the controller, the targets are wrong. Compare with the controller's own "
     "display at one pose: plumb predict gives the pose of the model's tool. Or say that the tool "
     "is the model's: --tool NAME=model."},
    {"E-FIT-EARLIER",
     "A run from which numbers of the arm are to be taken over must be of an arm of the same "
     "model, "
     "with a number in common, and must not go back to the readings that are fitted now: these "
     "would count twice, and the errors would look smaller than they are."},
    {"N-FIT-EARLIER",
     "The run from which numbers were taken over has effects that this cell does not list. What "
     "they explained there is missing here: list them too, plumb add EFFECT."},
    {"W-FIT-EARLIER",
     "The readings say that the arm has little in common with the one whose run was named. The "
     "result is then much like that of the readings alone, though not exactly so."},
    {"W-FIT-SISTERS",
     "The numbers of this arm are farther from those of its sisters than theirs differ among each "
     "other: it may be of another batch, was repaired, or its data are wrong. What the fleet "
     "taught "
     "then weighs less, so that the arm is calibrated much as it would be alone."},
    {"E-RECHECK-OWN",
     "recheck compares new readings with the calibration, and was given the calibration's own "
     "file. "
     "Measure some of its poses again: plumb plan --recheck proposes them."},
    {"E-RECHECK-NONE",
     "Every reading of the file has 'ignore' in its column set, so there is nothing to compare."},
    {"E-RECHECK-POINT",
     "plumb recheck compares measured positions with those that the run predicts. Where the tool "
     "touches a fixed point or a plane, or a wire is read, nobody knows where these are but the "
     "fit. Fit new readings together with the earlier ones."},
    {"E-RECHECK-RUN",
     "This run cannot be rechecked: cell.toml no longer has the numbers that it fitted, or it "
     "stands "
     "on the controller's own positions (fit --base controller). Fit again."},
    {"N-RECHECK-SOME",
     "A recheck is for 8 to 30 readings. Of a larger file 100 are taken, evenly spread; with that "
     "many, a new calibration says more."},
    {"W-RECHECK-ODD",
     "A single reading contradicts all others: no part of the arm or the measurement could have "
     "moved so that one pose alone sees it. It was left out; at most a fifth of the readings can "
     "be."},
    {"W-IMPORT-SKIPPED",
     "--skip-bad left out the rows in which a cell should be a number and is none, as trackers "
     "write --- or NaN for a point that was not measured."},
    {"W-COMPILE-RECHECK",
     "A recheck found that the arm had changed, and what is compiled does not know it: the model "
     "was changed and fitted again since, or --refit-all asks for the calibration alone. The model "
     "is that of the arm before the change. Recheck the new run with the same readings: plumb "
     "recheck --data FILE."},
    {"N-COMPILE-RECHECK",
     "The arm has been rechecked since it was calibrated, so what is compiled is the latest "
     "recheck: "
     "the calibration with what had changed refitted. Its held-out error is that of the recheck's "
     "few readings, each predicted by a refit without it."},
    {"E-PLOT-NAME",
     "plumb plot draws the figures that plumb plot --list names. Where a name ends with JN, a "
     "joint "
     "of the arm takes its place: joint-J2. Nothing was written."},
    {"E-SERVE-PORT",
     "plumb serve cannot listen on that port of this machine: another program has it, or it needs "
     "rights. Without --port the system chooses a free one."},
    {"E-SERVE-OFF",
     "This plumb was built without the workbench, because node, npm or Boost.Beast were missing. "
     "Every verb works without it; docs/workbench.md says how to build it."},
    {"E-SERVE-HOST",
     "The workbench answers only requests to this machine by its own name. A page of another "
     "server that was made to lead here is refused."},
    {"E-SERVE-ORIGIN", "The workbench answers its own page only, not the page of another server."},
    {"E-SERVE-TOKEN",
     "What changes a cell needs the token that plumb serve printed with its address. A new server "
     "has a new token: open the new address."},
    {"E-SERVE-REQUEST",
     "The workbench could not make sense of a request. docs/workbench.md lists what it answers."},
    {"E-SERVE-METHOD", "This path of the workbench does not take that HTTP method."},
    {"E-SERVE-PATH", "The workbench has nothing at this path, or was built without its page."},
    {"E-SERVE-MISSING",
     "There is no such job or file any more: jobs are forgotten when the server is started again."},
    {"E-SERVE-SIZE",
     "Headers may have 16 kB, a file 16 MB and any other body 1 MB. Copy a larger file into the "
     "folder of the cell."},
    {"E-SERVE-BUSY", "The workbench serves 32 connections at a time. Close some of its pages."},
    {"E-SERVE-QUEUE", "Up to 32 jobs of the workbench wait for the one that runs."},
    {"E-SERVE-JOB",
     "The page may give the verbs that work in its cell, on files in the folder of the cell. "
     "Everything else is for a shell; the page shows what changed."},
    {"E-SERVE-STATE",
     "cell.toml, a measurement file or a run was changed, from a shell perhaps, after the page had "
     "read it. Nothing was written."},
    {"E-SERVE-OUTSIDE",
     "The page cannot make a cell read files outside its folder. Copy the file, or edit cell.toml "
     "in a shell."},
    {"E-SERVE-CHILD",
     "The workbench could not run a program, or it did not end in time. plumb-rt and plumb-twin "
     "are looked for beside plumb."},
    {"E-SERVE-RANDOM", "The system gave no random numbers for the token; nothing was served."},
    {"E-SERVE-DEPLOYED",
     "There is no folder with an rt.toml of that name. plumb deploy makes one."},
    {"E-SERVE-RT", "The plumb-rt that the workbench started has ended; the message says why."},
    {"E-SERVE-TWIN",
     "The simulated robot cannot be driven: the cell has no twin.toml, its bus is none that "
     "plumb-twin speaks, or plumb-twin has ended."},
    {"E-PLOT-RUN",
     "A figure shows a run, and there is none of the present cell file and data. plumb fit makes "
     "one; --run N draws an earlier one of the same data."},
    {"E-REPORT-BROWSER",
     "plumb report --pdf lets Chromium or Chrome print the report, and none of them is on PATH. "
     "Nothing was written. Any browser prints the HTML file to A4 as well."},
    {"E-REPORT-PDF",
     "The browser that plumb report --pdf starts made no PDF: it failed, or was not ready after "
     "two "
     "minutes. Nothing was written. The report without --pdf can be printed by hand."},
    {"N-RUN-NEW",
     "compare, compile, predict and report fit first if no run belongs to the present cell file "
     "and data."},
    {"W-RUN-DAMAGED",
     "A run under runs/ cannot be read: a file of it lacks, was cut short or was edited. The other "
     "runs are listed. plumb fit makes a new one; the damaged folder may be deleted."},
    {"W-RUN-NODATA",
     "The history was read, but not the cell's measurements; so it is not known which run is the "
     "current one."},
    {"E-ADD-TWICE",
     "The model already has that effect at these joints, with the same settings; nothing was "
     "changed. [effects] in cell.toml lists what it has. An effect may stand there a second time "
     "at other joints or with other settings."},
    {"E-DROP-NONE",
     "The model does not have that effect, or not at these joints or with these settings; nothing "
     "was changed. Geometry cannot be dropped: hold its parameters with [fit] fixed instead."},
    {"E-PLAN-POINT",
     "plumb plan chooses poses anywhere in the limits, for an instrument that measures where the "
     "target is. The readings of this cell are about fixed points, planes or anchors, whose places "
     "are not planned yet."},
    {"E-PLAN-BOX",
     "plan draws random poses within the joint limits and keeps those whose reflector lies in the "
     "box. None did: the box is out of reach, in another frame than the base, or in another unit "
     "than mm."},
    {"E-PLAN-EFFECT",
     "plan --separate takes two effects of the library by name, each with its joints joined by '+' "
     "and its numbers: gear_ripple:J2@cycles_per_turn=20,gear_harmonics:J2."},
    {"N-PLAN-NOMINAL",
     "There are no measurements yet, or too few for a fit, so the poses were chosen for the "
     "nominal arm. That makes little difference: derivatives hardly depend on errors of a "
     "millimetre."},
    {"E-PLAN-SAME",
     "Whatever the pose, and whatever of load, side of arrival or temperature can be chosen, the "
     "two "
     "effects move the measured point in the same way, so that no reading of the point can tell "
     "which of them it is. For the correction it does not matter: add either of them."},
    {"N-PLAN-PAYLOAD",
     "One of the two effects grows with the load and the other one does not, or differently, so "
     "readings with two loads tell them apart. Which loads can be mounted is taken from --payload, "
     "else from the measurements if they were made with several, else from [robot] payload and the "
     "arm without it. None of these states a second one."},
    {"N-PLAN-SETUP",
     "New poses are chosen for one set-up, the first of the cell; what was measured in the others "
     "counts as known. The choice hardly depends on the set-up: what matters is the arm."},
    {"N-SIMULATE-SETUP",
     "plumb simulate measures in one set-up at a time, the first of the cell. The others have no "
     "rows until they are measured, or simulated from a cell of their own."},
    {"E-CHECK-CONVENTION",
     "The files are not meant as they are labelled: another DH convention, unit, joint direction, "
     "joint zero or handedness explains the points far better. plumb check lists every reading "
     "with "
     "what it leaves; --fix writes the best one, a zero as the joint's offset. The zero of the "
     "first "
     "joint is part of the tracker's frame, that of the last one part of the target."},
    {"E-CHECK-ORIENTATION",
     "The orientation columns hold something else than their labels say: an arm fitted to the "
     "points alone does not meet them as labelled, and does as the message says. --fix writes "
     "files with the right labels: columns renamed, signs turned, or the line '# rot:' put right."},
    {"W-CHECK-ORIENTATION",
     "The measured orientations do not fit the arm that the points show, or scatter by more than "
     "sigma_urad. fit gives them the weight that they deserve, or none; positions are not "
     "affected."},
    {"E-CHECK-FIX-SETUPS",
     "The convention was told from one of several set-ups, and each may have files of its own; "
     "--fix "
     "changes none of them. plumb check says what is wrong: correct cell.toml and the headings of "
     "the files by hand."},
    {"E-CHECK-FRAME",
     "[measurement] frame says where the base stands, and the points say that it stands elsewhere: "
     "the nominal arm explains them there ten times better. The message says how the two differ. A "
     "turn by 180 deg about z is often that between a controller's base and base_link."},
    {"E-CHECK-NOFIT",
     "Neither the labels nor any other reading of units, conventions and directions explains the "
     "points. Look for joints in another order, joints coupled by a linkage, rows that belong to "
     "another arm, or a wrong DH table."},
    {"W-CHECK-LIMITS",
     "Joint readings lie outside the limits in cell.toml, which a real arm cannot do. Either the "
     "limits are too narrow, or the readings are in another unit, direction or turn. The fit uses "
     "no limits, and a whole turn of a joint moves nothing; but coverage, plans and the range "
     "in which corrections are trusted depend on them."},
    {"N-CHECK-LIMITS",
     "The cell file does not say how far this joint may turn, so that limits were "
     "assumed, and the readings go farther. That is no error. State the limits with q = [min, max] "
     "so that coverage and plans are right."},
    {"E-CHECK-EQUAL",
     "Every row has the same joint positions, so nothing about the arm can be learnt. Repeats of "
     "one pose give the noise only. If the points are far apart all the same, the arm moved and "
     "the joint columns were not recorded with them."},
    {"W-CHECK-NOTHING",
     "Not one number of the arm can be told from these poses: another place of the tracker or of "
     "the reflector would show the same points. That is so for an arm of one joint, and for poses "
     "that move one joint only. The fit then calibrates frame and target and leaves the arm "
     "nominal."},
    {"E-CHECK-FEW",
     "The distinct poses give no more coordinates than there are numbers to find, or those that "
     "are left when some are held out do not. Repeats do not count: they tell of the noise only."},
    {"W-CHECK-FEW",
     "The distinct poses give hardly more coordinates than there are numbers to find, so that the "
     "fit can follow the noise."},
    {"W-CHECK-COPY",
     "Readings that agree to the last digit are copies, unless the file was rounded to steps as "
     "coarse as the noise: then some true repeats agree too. Only more than rounding explains are "
     "called copies. They make the noise look smaller than it is."},
    {"W-CHECK-OUTLIER",
     "Readings lie farther from where all others put them than noise or an unknown effect "
     "explains: a wrong row, a broken beam, a reflector that slipped. The fit leaves them out and "
     "lists them. Neighbours that are off by one vector were measured with the reflector, or the "
     "tracker, in another place."},
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
    {"W-CHECK-COARSE",
     "All measured coordinates are multiples of one step, which is coarse beside the noise: a "
     "report or a screen has rounded them. An error of up to half a step has a standard deviation "
     "of step / sqrt(12), which no model removes. Export the points with all their digits."},
    {"W-CHECK-PATTERN",
     "The errors of the readings repeat from row to row: every second or every n-th one is off by "
     "one vector. An instrument read in two faces that are not adjusted, or two stations in turn, "
     "do so in the tracker's axes; two reflectors measured in turn do so in the tool's. A fit of "
     "all rows lies between the two and is wrong for both. Nothing is said where joint positions, "
     "directions, payload or temperature follow the same pattern, because they may be the cause."},
    {"W-CHECK-SCALE",
     "One factor on all points would make them fit the lengths of the DH table. A large factor is "
     "a unit; a small one is the scale of the tracker or its correction for temperature, because "
     "arms are hardly built longer everywhere by one factor. Of steel 12 ppm and of aluminium 24 "
     "ppm belong to a kelvin, so a warm arm does it too. If it is the tracker's scale, the "
     "calibrated lengths carry its error."},
    {"W-CHECK-ROWS",
     "Rows, one after another, fit the arm like all others once one slip is put right in them: a "
     "joint that counts the other way, joint angles or points in another unit than the heading "
     "says, or points that stand one or two rows away from their joint positions. Each of these "
     "was tried on every row, and the repaired rows were fitted with the others. Correct these "
     "lines of the file; plumb changes nothing by itself."},
    {"W-CHECK-MOVED",
     "From one row on all measured points are shifted, in the way in which they are when the "
     "tracker or the base was pushed, the reflector was seated anew, or the zero of a joint was "
     "lost. It is judged as plumb compare judges it: chance makes such a jump less than once in a "
     "thousand, and it causes at least 30 % of the squared error that the fit leaves. A drift is "
     "no jump. Put it into the model with plumb add step, or give the rows before and behind it "
     "set-ups of their own, or measure again."},
    {"W-CHECK-CONTRADICT",
     "An arm fits most readings well and misses the others by far, with nothing between: these "
     "belong to another arm, another target or another set of joint positions. They are too many "
     "to be outliers that are simply left out, so they are used, and spoil the fit, until they are "
     "marked with set = ignore."},
    {"W-CHECK-SAME",
     "A set-up is said to stand where another one stands, or to carry its reflector: frame or "
     "target = { same_as = \"day 1\" }. With a frame or reflector of its own the points fit far "
     "better, so it was moved between the two, or it was another one. Left as it is, the error "
     "looks like one of the arm."},
    {"W-CHECK-REPEATS",
     "Rows of one pose name are taken for repeats, and what they differ by is taken for noise. "
     "They differ by far more than the stated standard deviation of one reading: they were not "
     "the same pose, something changed between them, or the stated number is too small. Or they "
     "differ by far less, so that the stated number is too large and hides what is missing."},
    {"W-CHECK-EFFECT",
     "A number of an effect is far beyond what arms have: a reference temperature in kelvin, a "
     "reversal that takes half a turn, or an effect that moves the measured point by more than 2 % "
     "of the arm's length. Either it is in another unit, or the effect imitates wrong readings."},
    {"W-CHECK-GRAVITY",
     "What the geometry leaves looks like joints that yield under gravity, but under another "
     "direction of it than the vector 'gravity' of [robot] says. That vector is in the base frame "
     "of the DH table: [0, 0, -9.81] for an arm that stands upright on the floor, [0, 0, 9.81] for "
     "one that hangs from a ceiling. With a wrong direction every effect of gravity is wrong."},
    {"N-CHECK-GRAVITY",
     "Gravity is switched off, so that nothing of weight can be judged; or it does not point along "
     "-z of the base, so the arm hangs, leans or is mounted on a "
     "wall. That is right for many arms; the note says it because a slip of sign looks the same."},
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
    {"E-URDF-BASE", "The arm begins at a link on the way from the file's root to its tip: --base."},
    {"W-URDF-UNITS",
     "URDF is in metres and radians. These numbers are too large for radians: they look like "
     "degrees."},
    {"W-NEW-REACH",
     "The links of the arm add up to more than 25 m or less than 5 cm, so the unit of its lengths "
     "is "
     "doubtful."},
    {"E-URDF-TIP",
     "The arm goes from the file's root to one link. If several links end the tree, name one: "
     "--tip."},
    {"E-URDF-JOINT",
     "plumb calibrates serial arms of 1 to 9 revolute or sliding joints. Floating and planar "
     "joints "
     "on the way to the tip are not of that kind. A joint that mimics another can be read where it "
     "moves about the axis of a joint with a value of its own that lies directly before or behind "
     "it: both motions are then one DH row with a coupling. Elsewhere it needs a row, and so a "
     "column of readings, of its own."},
    {"N-URDF-MIMIC",
     "A <mimic> joint of the file has no readings of its own. It moves about the axis of its "
     "neighbour, so that both motions are one DH row: coupling of [robot] says what is added, in "
     "values of the URDF's joints. A controller may show the sum instead; plumb check compares "
     "both with the data."},
    {"E-URDF-SIZE",
     "The file has elements nested more than 100 deep, or more than 2000 links. No robot has: it "
     "is "
     "damaged, or was made to break programs that read it."},
    {"N-NEW-JOINT",
     "Parameters are called JOINT.PARAMETER, J2.d for example, so names of joints are different "
     "words without dots and blanks. The names of the file were changed where they are not."},
    {"N-NEW-CONVENTION",
     "The same arm can be written in both DH conventions. From a URDF either is computed; choose "
     "the one your controller's documents use."},
    {"W-EXPORT-LOST",
     "URDF says where joints and links are, and nothing about elasticity, gear errors or trees. "
     "The model file of plumb compile holds them all."},
    {"E-IMPORT-BINARY",
     "import reads text. Export the measurements as text (CSV) from the program they come from."},
    {"E-IMPORT-ENCODING",
     "The letters of the file are coded in a way that import does not read: Shift-JIS, or one for "
     "Chinese, Korean or Cyrillic text. Read as Latin-1 its headings would be nonsense. Save the "
     "file as UTF-8 where it comes from, or convert it with iconv."},
    {"E-IMPORT-EMPTY", "There is nothing in the file."},
    {"E-IMPORT-HEADER",
     "No line names the columns, or none of the names is known. Name them yourself: --header "
     "\"pose,q1_deg,...,x_mm,y_mm,z_mm\"."},
    {"E-IMPORT-RAGGED",
     "A row has more or fewer cells than the header. Often the last line was cut off while "
     "copying, or the separator was not recognised: --separator."},
    {"E-IMPORT-ROWS", "The file has a header, and nothing below it."},
    {"E-IMPORT-DECIMAL",
     "Every comma of the file has three digits behind it: it may divide thousands or decimals. Say "
     "which with --decimal."},
    {"N-IMPORT-JOINTS",
     "Columns that bear the names of the cell's joints, or those that a robot's ROS driver gives "
     "them, are the positions of these joints, whatever their order in the file."},
    {"N-IMPORT-STATES",
     "Joint states of ROS (sensor_msgs/JointState) hold the names of the joints beside their "
     "positions, in an order of their own, often that of the alphabet."},
    {"N-IMPORT-PAIRS",
     "Each line names its numbers, as in \"X= 729.06 Y= -1748.77\". The names are those of the "
     "columns."},
    {"N-IMPORT-MATRIX",
     "Twelve or sixteen columns are a rotation and a position in every row: they became x, y, z "
     "and "
     "the quaternion qw, qx, qy, qz."},
    {"N-IMPORT-PROGRAM",
     "The file is a program of the controller. Its joint positions are where the arm was sent; "
     "where "
     "it really stood is what the controller logs."},
    {"E-IMPORT-PROGRAM",
     "The file is a program of the controller, and its positions are Cartesian or in pulses of the "
     "motors. A calibration needs the angles of the joints: the message says how to get them."},
    {"E-IMPORT-FORMAT",
     "XML, JSON and YAML hold trees and no tables. Lines such as {\"x_mm\": 1, \"y_mm\": 2}, one a "
     "pose, are read."},
    {"E-IMPORT-TRANSPOSED",
     "Quantities stand in the rows and poses in the columns. plumb needs one row a pose."},
    {"E-IMPORT-CELLS",
     "The cells of a column state their unit, and do not agree with each other or with the "
     "heading. "
     "Nothing is converted cell by cell: write one unit, and once."},
    {"N-IMPORT-CELLS",
     "The unit stands in every cell of these columns, \"729.06 mm\", and was taken from there. "
     "Angles in degrees, minutes and seconds became degrees."},
    {"N-IMPORT-STATED",
     "The headings of these columns say no unit, but a line above the table does, as in \"Units: "
     "mm, deg\"."},
    {"N-IMPORT-THOUSANDS",
     "Points, commas, apostrophes or blanks between the thousands of a number were taken out."},
    {"N-IMPORT-VECTOR",
     "A cell such as \"[0.1, 0.2, 0.3]\" holds several numbers: each became a column of its own."},
    {"N-IMPORT-LINES",
     "A header that stands again between the rows, and lines without any number, are no "
     "measurements and were left out. Their line numbers are named."},
    {"N-IMPORT-STATISTICS",
     "The last rows are called mean, standard deviation, minimum, maximum or the like: they state "
     "something of the measurements above them, and were left out."},
    {"N-IMPORT-NAMED",
     "The file names no columns, but what stands in its rows tells them. See that it is right."},
    {"E-IMPORT-NUMBER", "A column of numbers holds something else. NaN and infinity are none."},
    {"E-IMPORT-UNIT",
     "A recognised column does not say its unit. Name it: --map \"X=x_mm\". A wrong unit is the "
     "commonest cause of a wrong calibration, so none is assumed. Units that plumb does not know, "
     "cm for example, are not converted: do that where the file comes from."},
    {"W-IMPORT-UNIT",
     "The same of a preview, which shows the rest of the file all the same. Without --preview it "
     "is an error."},
    {"E-IMPORT-MAP",
     "--map names a column that the file has not, a new name without a unit, or one column twice."},
    {"E-IMPORT-MISSING",
     "A calibration needs the positions of all joints and at least one measured coordinate, and no "
     "column of the file holds them, or none that plumb recognises. Nothing was written. Columns "
     "of "
     "numbers that were not used are named; say with --map which of them are meant. If joints and "
     "points are in two files, import both at once with --join."},
    {"W-IMPORT-MISSING",
     "The same of a preview, which shows the rest of the file all the same. Without --preview it "
     "is an error."},
    {"E-IMPORT-DATE",
     "In dates such as 03/04/2022 the day stands first in some countries and the month in others. "
     "plumb decides by numbers beyond 12 in the whole column; where there are none, and the two "
     "readings differ by more than a constant, say which with --date."},
    {"N-IMPORT-TIME",
     "How the time stamps were read. They become seconds from the first row, in the column t_s."},
    {"N-IMPORT-ZERO",
     "The file counts the joints from 0, plumb from 1: each number was raised by one."},
    {"N-IMPORT-QUAT",
     "Four numbered columns whose squares add up to 1 in every row are a unit quaternion and no "
     "joints. With numbers from 0 the first is the scalar part, as is usual."},
    {"W-IMPORT-QUAT",
     "These numbered columns are a quaternion and no joints, but which of them is the scalar part "
     "cannot be told from the numbers: some programs put it first, some last. Say it with --map, "
     "for example \"Q1=qw,Q2=qx,Q3=qy,Q4=qz\"."},
    {"N-IMPORT-EXPANDED",
     "An expanded uncertainty, U(95) or with a coverage factor k = 2, is two standard deviations. "
     "plumb weighs measurements by one, so the numbers were divided by the factor."},
    {"W-IMPORT-RADIANS",
     "The headings of the joint columns say degrees, but the numbers are as small as radians, and "
     "the measured points are farther apart than so few degrees can move a tool. Nothing was "
     "changed: if the numbers are radians, say so with --map."},
    {"N-IMPORT-SLIDE",
     "Positions of a joint that turns are angles, of one that slides lengths. The file alone "
     "cannot "
     "tell which it is; plumb check compares with the cell."},
    {"W-IMPORT-UNCERTAINTY",
     "A column of uncertainties that says neither 1 sigma nor 95 % may be either; taking the wrong "
     "one would double or halve the weight of the readings. Map it to sx_um (one standard "
     "deviation) or u95x_um (two, which are halved), with the unit of the file, and so for y and "
     "z."},
    {"N-IMPORT-EMPTY",
     "Every line ends with separators behind which nothing stands, as some programs write them."},
    {"E-IMPORT-TWICE", "Two columns would become the same one. Leave one out with --map OLD=-."},
    {"E-IMPORT-ROT",
     "The order of three turns: xyz-fixed is R = Rz Ry Rx, xyz-moving is R = Rx Ry Rz, and so on "
     "for every order of axes."},
    {"N-IMPORT-NAMES",
     "Names of poses differ in case, signs, leading zeros or the collection before '::' between "
     "the "
     "two files, and are the same otherwise. They are taken for the same, which they are unless "
     "the "
     "note names two that are not."},
    {"E-IMPORT-JOIN", "The two files cannot be laid side by side in the way asked for."},
    {"N-IMPORT-ENCODING", "The file was not UTF-8 and was converted."},
    {"N-IMPORT-PREAMBLE",
     "Lines above the table that are neither comments nor data were skipped. Their line numbers "
     "are "
     "named."},
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
     "The calibration did not settle: the predicted points still moved by more than a share of the "
     "noise. Most often a unit, the sign or zero of a joint, or the DH convention is wrong, so "
     "that "
     "no small change of the arm explains the measurements; plumb check finds that. If it finds "
     "nothing, an effect was added that these poses do not show: drop it, or measure poses all "
     "over the joint limits."},
    {"N-FIT-PRIOR",
     "Some combinations of the arm's numbers hardly move the measured points in these poses: the "
     "poses lie along a path or on a surface, or the wrist turns little. Arms are built to some "
     "tenths of a millimetre and milliradian, so these combinations are held near their nominal "
     "values by [fit] prior_mm and prior_mrad (1 sigma; unless stated, 0.5 each, or up to 16 "
     "times as much where what the poses clearly tell of this arm says so; 0 to switch it off). "
     "What the poses show clearly is not touched. Where such poses are, the model is as good "
     "as its held-out error says; elsewhere it is a guess that stays near nominal."},
    {"N-FIT-MARKED",
     "[measurement] held_out is \"auto\" or not stated, and the files mark rows as held in column "
     "'set': those are the held-out poses. Delete the marks, or state another rule, to have the "
     "program choose."},
    {"W-DIAGNOSE-UNJUDGED",
     "The model with this effect could not be refitted, so that nothing is known for or against "
     "it: the verdict is about the others. Put it in by hand with plumb add, which says what the "
     "fit ran into, or measure poses that show more."},
    {"E-FIT-FEW",
     "There are fewer measured coordinates than parameters. Measure more poses, or "
     "hold parameters with [fit] fixed."},
    {"E-FIT-ONE-POSE",
     "The joint positions hardly change between the poses, so nothing tells the numbers of the arm "
     "apart. If the points hardly change either, measure poses all over the workspace; plumb plan "
     "chooses them. If the points are far apart, the joint columns are in another unit than their "
     "headings say, or were not recorded with these points."},
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
     "cell.toml describes the arm with another joint zero or in the other DH convention, or "
     "another "
     "arm."},
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
     "A number of an effect ended where its law cannot be, by more than three sigma: a spring "
     "that pushes the wrong way, say. The effect imitates another one that the model lacks, or "
     "masses or signs are wrong."},
    {"W-FIT-LENGTH",
     "A distance between two touched points that the columns to_point and distance_mm state lies "
     "more than three of its standard deviations from what the fit found, which took it into "
     "account: it is wrong, in another unit, or a point moved half-way."},
    {"W-FIT-SCALE",
     "Lengths of an arm are built wrong one by one, some longer and some shorter. Here all of them "
     "grew or shrank by one factor. A tracker at another temperature, inches for millimetres in a "
     "stated length, or the nominal table of an arm of another size do that, and no residual shows "
     "it: the corrected robot is then wrong by this factor."},
    {"W-FIT-UNIT",
     "Distances from a fixed anchor tell the size of the arm. These fit the nominal one only if "
     "all "
     "of them are larger or smaller by a factor that is that of another unit. The fit takes them "
     "as "
     "they are written."},
    {"W-FIT-PLACES",
     "Whole placements of sockets, planes, spheres or anchors are held out where there are four or "
     "more. Here there are fewer, so that single readings are held out: their neighbours at the "
     "same place were fitted, and the arm may be far off elsewhere."},
    {"W-FIT-POINT-MOVED",
     "From some row on the tool meets a touched point or a plane elsewhere: it was bumped, or it "
     "is "
     "another one. Its residuals are the evidence, earlier ones against later ones."},
    {"W-FIT-POINT-SAME",
     "Two labels of touched points end at one place. As one point their readings would say more "
     "about the arm."},
    {"W-FIT-OUTLIERS",
     "Some poses lie farther from what all others predict than six times their usual scatter: a "
     "bumped reflector, a broken beam, a mistyped number. They were not fitted. Held-out poses are "
     "never left out of the held-out error; a second figure without the outliers stands beside."},
    {"W-FIT-HELD-OUTLIERS",
     "Some held-out poses lie farther off than six times the usual scatter of the others: bad "
     "readings, or places where the model fails. The line of the held-out error counts them, and a "
     "second line shows the rest; the verdict is on the rest and names them."},
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
    {"W-FIT-SETUP",
     "A set-up has so few poses that all of them are needed to find where its tracker and its "
     "reflector are, so none is held out. The held-out error is that of the other set-ups."},
    {"W-FIT-SETUP-OPEN",
     "A set-up has so few readings, or readings so much in one line, that they do not tell where "
     "its tracker stood: some numbers of that frame stay as the fit guessed them. The arm itself "
     "is "
     "calibrated by the other set-ups; predictions in the frame of this one may be far off."},
    {"W-FIT-SETUP-TIGHT",
     "A set-up has hardly more readings than the numbers of its own frame and reflector, so that "
     "these fit whatever was read and no residual shows an error. The arm is calibrated by the "
     "other set-ups; predictions in this one's frame may be off by millimetres."},
    {"N-FIT-ORIENTATION",
     "The file holds orientations, but the cell does not say how good they are: they were left "
     "out. State [measurement] sigma_urad, one standard deviation per axis, to use them; the note "
     "gives the value by which they scatter about the fitted arm."},
    {"W-FIT-ORIENTATION",
     "Measured orientations that do not deserve their stated weight pull the whole fit aside. An "
     "arm fitted to the points alone shows whether they scatter by more than sigma_urad, and then "
     "they are fitted with what they scatter; whether they contradict the points, or were computed "
     "by the controller and not measured, or mean something else, and then they are left out. If "
     "repeats of poses agree much better than the arm meets them, the model lacks something that "
     "turns the tool."},
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
     "too alike, or two numbers of the model imitate each other."},
    {"W-AUDIT-STILL",
     "A joint never moved in the fitted poses. Elsewhere the model corrects blindly: measure poses "
     "all over the range that the robot will use."},
    {"W-COMPILE-SERIAL",
     "[cell] serial is empty, so the model is bound to no robot: plumb-rt would run it on any arm "
     "of "
     "the kind, whose errors are others. Write the robot's serial number into cell.toml."},
    {"W-COMPILE-TOLERANCE",
     "The model was compiled, but its held-out error does not keep [cell] tolerance_mm: at 95 % of "
     "the poses, or three times over at the worst. With --gate nothing would have been written."},
    {"N-FIT-REFLECTOR",
     "The poses do not tell where the reflector sits on the tool: if the tool is vertical in all "
     "of "
     "them, a reflector that sits lower and a tracker that stands higher look alike. So that "
     "number "
     "is taken from the earlier run. Another value would move the frame of the tracker and no "
     "predicted point in such poses; if the reflector sits elsewhere now, the heights of the base "
     "in this run are off by as much."},
    {"N-FIT-LEFT",
     "The readings of --data are another measurement than that of cell.toml. What happened to the "
     "tracker, its base or its reflector then (drift, step, tracker) is not taken over; if the "
     "same happened again, give the readings a cell of their own and add the effect there."},
    {"N-COMPILE-LEFT",
     "Effects of the measurement or of the procedure (drift, step, tracker, settling_lag) clean "
     "the other numbers of the fit. They are not the robot's, and are not compiled."},
    {"W-AUDIT-EFFECTS",
     "The model has room for hardly any effect more. A diagnosis may have stopped there, and what "
     "the poses support beyond these effects is left out of the correction."},
    {"W-AUDIT-HELD",
     "The model was fitted on every pose, so no pose is left to measure its accuracy with."},
    {"E-MODEL-OPEN", "The model file is missing, a folder, or not readable."},
    {"E-MODEL-SIZE", "The file is larger than any model file can be."},
    {"E-MODEL-TRUNCATED", "The file is shorter than it says: a copy was cut off."},
    {"E-MODEL-KIND", "The file is not a model file of plumb."},
    {"E-MODEL-CHECKSUM", "The bytes of the file changed since it was written."},
    {"E-MODEL-NEWER", "The file was written by a newer plumb with a schema this one cannot read."},
    {"E-MODEL-EFFECT",
     "The file lists a physical effect that this program cannot evaluate: a law it does not know, "
     "a newer version of one, or numbers of another count."},
    {"E-EFFECT-MANY",
     "The cycle reserves room for a fixed number of effects, every wave of a gear being one. Keep "
     "the strongest, and let a local tree learn the rest: [effects.local_tree]."},
    {"E-EFFECT-DATA",
     "A listed effect needs something that these measurements do not hold: the direction from "
     "which joints came, a temperature, the row after which something moved."},
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
    {"W-CORRECT-LIMITED",
     "Some corrections are larger than [deploy] max_correction_mm. They were cut to that size, as "
     "the guard of plumb-rt would, and are marked 'limited': the arm misses those targets by the "
     "rest. A limit far under what the arm needs, or a model that does not belong to it."},
    {"W-PREDICT-LIMITED",
     "In some rows the arm is farther from its nominal pose than [deploy] max_correction_mm lets a "
     "correction be. The predicted points are whole; the rows are marked 'limited' because "
     "correct and plumb-rt would cut the correction there, and the arm would miss by the rest."},
    {"W-PREDICT-RADIANS",
     "The joints stand in columns of degrees, but no angle is beyond 2 pi, and read as radians "
     "they lie within what the model was fitted with. If they are radians, name the columns "
     "q1_rad ...; if the arm does stay within 6 degrees of zero, nothing is wrong."},
    {"W-PREDICT-INPUT",
     "An effect of the model depends on something that the file does not say: the way each joint "
     "came (dir_jN, travel_jN_deg), a temperature, the payload, or when a row was measured. What "
     "the message names was assumed, and the rows are marked 'context-fallback'. Rows have a place "
     "in the cell's own series by their time (t_s, or ISO times, in both files), or else by the "
     "name of a pose that the cell measured too; others are taken as measured right after the last "
     "row of the cell: what has moved stays moved, and a drift has come to its end."},
    {"W-PREDICT-OUTSIDE",
     "The joints, the payload or a temperature of some rows lie outside what the model was fitted "
     "with (plumb inspect shows the ranges). They are marked 'outside-domain': a prediction there "
     "extrapolates, and a correction holds a little beyond and fades to nothing farther out. Often "
     "it is a unit: kelvin for degC, grams for kilograms."},
    {"E-CORRECT-NONE",
     "Every target was refused, so every command in the output is the target itself. When all are "
     "refused the targets are usually in other units, in another frame or in another order than "
     "their columns say, or the joint states belong to other targets."},
    {"W-CORRECT-REFUSED",
     "Some targets were refused; column status says why, and the command is the target itself. "
     "plumb explain STATUS tells what each one means."},
    {"N-CSV-REPLACED",
     "The input already had a column of that name, perhaps from an earlier predict; it was "
     "replaced."},
    {"E-DH-COLUMN",
     "The DH table needs alpha_deg, a_mm, d_mm and theta_deg (or rad, m, in), and may have joint, "
     "type, beta, offset, q_min and q_max. Another column would be left out, which may describe "
     "another arm."},
    {"E-DH-FILE",
     "The file of the DH table is no table of columns but a text of another kind, such as YAML."},
    {"E-DH-OFFSET", "The offset of a joint that turns is an angle, of one that slides a length."},
    {"W-DH-RADIANS",
     "Angles of arms are mostly quarter turns. All those of this table are multiples of pi/4 as "
     "numbers, though their header says degrees: 1.570796 is perhaps pi/2."},
    {"E-DH-JOINTS", "The DH table has more joints than a model can have."},
    {"E-DH-LIMITS", "A joint's limits are not two rising numbers in its own unit."},
    {"E-DH-TYPE", "A joint is revolute or prismatic."},
    {"N-DH-LIMITS", "The DH table does not give all joint limits; wide ones are assumed."},
    {"E-DEMO-NAME", "There is no sample cell of that name. plumb demo --list shows them."},
    {"W-DIAGNOSE-ROSE",
     "The fitted readings spoke for these effects, but with them the error on readings that had no "
     "say rose, so they were not added. Where the effects were chosen anew without each fold, it "
     "is "
     "the error of those choices that rose. Something else is missing that they imitate, or the "
     "measurement is short and in one place, so that what is learnt there does not hold elsewhere. "
     "Measure more poses, in an order that is no path."},
    {"E-SIM-PLAN", "The simulation that was asked for makes no sense; the message says why."},
    {"E-SIM-EFFECT", "The simulator does not know that effect. plumb simulate --list shows them."},
    {"E-SIM-SIZE",
     "A hidden effect cannot get the size that was asked for: no noise to measure it by, or "
     "nothing of it is left when geometry has been fitted. Or the size is one that tears the arm "
     "apart."},
    {"E-SIM-JOINT", "A joint of a hidden effect does not exist in this cell, or has no size."},
    {"E-CELL-BUS",
     "The bus layout of [deploy.bus], or the default one with this cycle_us, cannot be used: "
     "identifiers or registers out of range or shared, a scale, period or bit rate of 0, a period "
     "so long that its sender counts as silent (50 ms for target, joints, controller and status, "
     "500 ms for actual and robot), a number too small for the arm, or more than 70 % of the bus "
     "at worst. Nothing was written."},
    {"E-DEPLOY-CYCLE",
     "A step of the cycle with this model takes more than half of cycle_us on this machine, judged "
     "by the slowest of 2000 steps after the slowest hundredth. The rest of the cycle is needed "
     "for the bus, for waking up late and for a slower processor. Nothing was written; "
     "--allow-slow writes all the same."},
    {"W-DEPLOY-CYCLE",
     "A step of the cycle with this model takes more than half of cycle_us on this machine, and "
     "--allow-slow was given."},
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
    {"E-FIX-RIGHTS",
     "plumb-rt doctor --fix writes files below /etc, which only root may. Nothing was written. Run "
     "it with sudo, or look first with --dry-run, which needs no rights."},
    {"E-FIX-FIREWALL",
     "plumb-rt doctor --fix wrote a file of firewall rules, and the kernel did not take it; the "
     "message has what nft says. An interface may be missing yet, or the kernel older than 5.16, "
     "which has no hook for CAN. plumb-rt@NAME tries again at every start, and does not start with "
     "a rule that cannot be loaded; delete the file to do without it."},
    {"E-RT-FIREWALL",
     "The service plumb-rt@NAME did not start, because a file of firewall rules in /etc/plumb "
     "cannot be loaded: the line above has what nft says. Who installed the rule counts on it. "
     "Install nftables, run plumb-rt doctor --fix --force, or delete the file to do without it."},
    {"E-RT-KEY",
     "rt.toml has a key that plumb-rt does not know; nothing was sent. Rename it as proposed."},
    {"E-RT-TYPE", "A value of rt.toml is of the wrong type. The message says what is expected."},
    {"E-RT-RANGE", "A value of rt.toml is out of its range. The message says which is allowed."},
    {"E-RT-MISSING",
     "rt.toml lacks a key without which plumb-rt does not start; plumb deploy writes a complete "
     "one."},
    {"E-RT-PEERS",
     "plumb-rt as Modbus TCP server takes targets from those whom [source] peers of rt.toml names, "
     "and from nobody else, also of this machine; rt.toml names nobody. Nothing was opened. Write "
     "the address of the controller there and seal the folder."},
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
     "A file of the folder is not what SHA256SUMS lists, or the list is missing or does not name "
     "rt.toml and the model. Deploy again, or find out who changed it. After editing rt.toml: "
     "plumb-rt seal FOLDER."},
    {"E-RT-UNSIGNED",
     "The folder has no signature, and this machine demands one: it has a folder "
     "/etc/plumb/keys.d. Deploy again with --sign FILE.key, whose public part is trusted there. "
     "unsigned = \"allowed\" in /etc/plumb/plumb-rt.toml lets unsigned folders run, and status, "
     "doctor, journal and metrics keep saying so."},
    {"W-RT-UNSIGNED",
     "The folder has no signature, and /etc/plumb/plumb-rt.toml allows that. Whoever may write to "
     "the folder decides what the robot does."},
    {"E-RT-SIGNER",
     "A key signed the folder that is not among the .pub files of /etc/plumb/keys.d. If you trust "
     "who signed it, put his .pub there; a key file that is damaged, or that others may write, is "
     "not used, and is named."},
    {"E-RT-REVOKED",
     "The key that signed the folder was revoked on this machine: its file in /etc/plumb/keys.d "
     "was renamed to NAME.revoked. Deploy again, with a key that is trusted."},
    {"E-RT-SIGNATURE",
     "SHA256SUMS.sig is no signature, or belongs to another SHA256SUMS than the one beside it: the "
     "folder was changed after it was signed. Deploy again with --sign, or plumb-rt seal FOLDER "
     "--sign FILE.key."},
    {"E-RT-FOLDER",
     "In a signed or installed folder stands something that SHA256SUMS does not list, or a "
     "symbolic link, a file with several names, a pipe or a device. All of it must be regular "
     "files that were signed."},
    {"E-RT-KEYS",
     "A file or folder of /etc/plumb is not used: others than root may write to it, or it is no "
     "key. What it says does not count; the other keys still do."},
    {"W-RT-KEYS", "As E-RT-KEYS, of a file that was not needed: the folder runs all the same."},
    {"E-KEY-RIGHTS",
     "Others than its owner may read or write the private key, so it may be no secret. If nobody "
     "has read it: chmod 600 FILE; else make a new pair with plumb keygen and revoke the old one."},
    {"E-KEY", "The file is no private key of plumb keygen. The message says why."},
    {"E-RT-PLACE",
     "A place is a folder, by custom /var/lib/plumb/NAME, into which plumb-rt install copies "
     "deploy folders and of which plumb-rt runs the current one. The message says what is wrong "
     "with this one: it is none, others may write to it, or its link `current` points nowhere. "
     "plumb-rt verify looks at all of it; the next install mends the link."},
    {"E-RT-INSTALLING",
     "Another install or rollback works in the same place; this one has waited for five seconds. "
     "Nothing was changed."},
    {"E-RT-OLDER",
     "A folder that was made later was installed in this place before. So that an older model "
     "never comes back by accident, that is refused: plumb-rt rollback goes back on purpose, and "
     "install --older installs an old folder on purpose. If a clock was wrong when one of the "
     "folders was made, the message says so: set it, and deploy again."},
    {"W-RT-CLOCK",
     "The folder says that it was made in the future of this machine's clock. One of the two "
     "clocks is wrong; until that time all that is made later counts as older."},
    {"E-RT-RESTART",
     "The folder differs from what runs in more than the model, so a swap is not enough, and "
     "plumb-rt does not start anew by itself: a crash at night would then change the settings. "
     "With --at-restart it is installed, what runs runs on, and the next start takes it; status "
     "says so until then."},
    {"E-RT-ROLLBACK",
     "The place has no such version any more, or none before the current one. plumb-rt list shows "
     "what there is; install --keep says how many stay."},
    {"E-RT-CEILING",
     "The model allows itself a larger or faster correction, or a shorter ramp, than [limits] of "
     "rt.toml lets any model have. If that is meant, raise the ceiling there and seal the folder."},
    {"E-RT-CHANGE",
     "The new model corrects some pose differently by more than max_change_mm of rt.toml. The "
     "running model runs on. plumb-rt swap FILE --allow-change-mm X accepts just that change; "
     "points must be verified again."},
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
    {"E-RT-LOCK",
     "plumb-rt holds a lock on its folder for as long as it lives, so that no second one runs it; "
     "this folder cannot be opened or locked."},
    {"E-RT-NOT-RUNNING", "No plumb-rt runs from this folder, so there is none to ask."},
    {"E-RT-CONTROL",
     "There is no place for the socket over which status, monitor and swap speak to plumb-rt, or "
     "what came over it was no answer."},
    {"E-RT-METRICS",
     "The port for the metrics cannot be listened on; it is taken, or needs a right. It is on the "
     "loopback address only."},
    {"E-RT-RECORD",
     "The record cannot be made: its folder is missing or may not be written to. A disk that is "
     "full makes only a pause."},
    {"E-RT-SINK", "The file of answers cannot be made: folder, space or rights."},
    {"E-RT-SWAP",
     "The new model has another nominal arm or other sensors than the running one, or wants larger "
     "numbers than the layout of the bus has, or a swap is under way. The running model runs on."},
    {"E-RT-STOP",
     "plumb-rt was told to stop and the correction is out, but a file that it writes to, the "
     "record "
     "or the answers, did not answer within 3 s. The program ended all the same; what was not "
     "written is lost."},
    {"W-RT-ACKNOWLEDGE",
     "Before the first correction an operator must acknowledge: the last run did not end well, or "
     "nobody has acknowledged this model yet. plumb-rt waits in state shadow until the bit "
     "acknowledge of the controller goes from off to on."},
    {"W-RT-STATE",
     "plumb-rt.state, the note of how the last run ended, cannot be written. The run goes on, and "
     "the next one asks for an acknowledgement."},
    {"E-RT-LOST",
     "The bus was down for longer than give_up_s of rt.toml; without that key plumb-rt waits for "
     "ever."},
    {"E-RT-CLOCK", "The system's clock cannot sleep, so there is no cycle."},
    {"E-RT-REPLAY",
     "The files hold no cycle that plumb-rt recorded, or they go on with a session that another "
     "version of plumb-rt copied."},
    {"E-RT-REPLAY-DIFFERS",
     "With this folder the session decides otherwise than it did when it was recorded: another "
     "model, other limits, or another version of plumb-rt."},
    {"W-RT-EVENTS",
     "Lines of the journal are no events and were left out. The last line of a program that was "
     "killed while it wrote may be one."},
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
    {"E-TWIN-CHANGE",
     "--change names nothing that could change, gives it no size in its unit, or is the stiffness "
     "of a joint that does not yield."},
    {"E-TWIN-TRUTH",
     "truth.json does not say how its arm can be simulated again. plumb demo writes one that "
     "does."},
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
