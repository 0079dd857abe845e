// SPDX-License-Identifier: Apache-2.0
#include "catalogue/explanation.hpp"

namespace plumb::offline {
namespace {

constexpr Explanation kTerms[] = {
    {"left-handed",
     "Measured points whose axes x, y, z do not follow the right-hand rule: one axis was negated, "
     "or two were swapped, when the file was written."},
    {"calibrated",
     "With the numbers of the arm as fitted to the measurements, instead of those of the data "
     "sheet (nominal)."},
    {"prior",
     "What is assumed before anything is measured: that arms are built within 0.5 mm and 0.5 "
     "mrad of nominal ([fit] prior_mm, prior_mrad), or up to 16 times farther where what the "
     "poses clearly tell of this arm says so and the cell states nothing else. It decides only "
     "where the poses say next to nothing. Or what other arms, or an earlier run of this one, "
     "taught: [fit] prior_from, "
     "fit --from."},
    {"fleet",
     "Several arms that are looked at together: plumb fleet fits every cell of a folder and says "
     "which arm is good, which is unlike its sisters, and what is typical of a model."},
    {"sisters",
     "Arms of one model, which have the same nominal arm in their cells. An arm is unlike its "
     "sisters if so great a distance of its numbers from theirs has a chance below 1 %, by "
     "their spread and by the uncertainty of its own fit."},
    {"shrinkage",
     "How much of an arm's own estimate of a number gives way to the mean of its sisters: 0 % "
     "where "
     "its readings show the number well, 100 % where they do not show it at all."},
    {"recheck",
     "A few poses, measured again after some time, judged against the calibration: still true, or "
     "which part has changed. plumb recheck makes a run that names its parent; compile takes the "
     "latest one."},
    {"control limit",
     "Of a recheck: what its mean error exceeds by chance about once in a thousand times, three "
     "standard deviations above what is expected. plumb plot history draws it."},
    {"audit",
     "What compile tries over 2000 poses of the trained range: the largest correction, where "
     "it is, how well the tool point is known, and whether the guard would cut anything."},
    {"set-up",
     "One arrangement of tracker and reflector. Frame and target belong to a set-up; the arm "
     "is the same in all of them ([[measurement.setup]])."},
    {"iterations",
     "Steps of the least-squares solution until nothing changes any more. More than some tens "
     "mean that the poses hardly show some number."},
    {"correlation",
     "How alike two numbers move the measured points, from -1 to +1. Beyond 0.98 these poses "
     "cannot tell one from the other."},
    {"cycles a turn",
     "How often an error repeats while a joint turns once. Whole numbers belong to the joint "
     "itself; the others to its gear or motor."},
    {"readings", "Single measurements. A pose that was measured three times gives three readings."},
    {"held-out",
     "Poses that nothing of the fit has seen: not the parameters, not the rank analysis, not the "
     "size of the tree. Their error is the accuracy to expect on new poses of the same kind. The "
     "error on the fit poses is always smaller and is never accuracy."},
    {"noise floor",
     "The error that measurement noise alone would leave, whatever the model: 1.60 sigma for the "
     "mean and 1.73 sigma for the RMS of a 3-D error. It comes from repeats of a pose under the "
     "same temperatures, load and side of approach, or from sigma_um; it does not depend on the "
     "effects of the model. A held-out error at a measured floor means: nothing more can be learnt "
     "from these poses."},
    {"position error",
     "Distance between the measured point and the predicted one, in mm: how far the model misses."},
    {"held-out error",
     "The position error of poses that nothing of the fit has seen: the accuracy to expect."},
    {"95 % interval",
     "Where the mean error of all poses of this kind lies with a probability of 95 %. Few held-out "
     "poses leave it wide: two models whose intervals overlap may be equally good. Repeats of a "
     "pose count as one."},
    {"95 %",
     "As a column: the error that 95 % of the readings do not exceed. It is held against the "
     "tolerance of the cell."},
    {"mean", "The average of the position errors, which are distances and never negative."},
    {"RMS",
     "Root mean square: the square root of the average of the squared errors. Large errors weigh "
     "more than in the mean."},
    {"max", "The largest error of all readings of the row."},
    {"within the tolerance",
     "Share of the readings whose error is no larger than the tolerance of the cell."},
    {"fit",
     "The error on the poses that were fitted. It shrinks with every number that is added, and is "
     "never accuracy: see held-out."},
    {"floor", "Short for noise floor."},
    {"sigma",
     "Standard deviation. sigma_um in cell.toml is the noise of one measured coordinate; 1 sigma "
     "beside a fitted number is how uncertain that number is."},
    {"1 sigma",
     "Standard deviation: with normal noise the truth lies within 1 sigma of the number in 68 % of "
     "all cases, within 2 sigma in 95 %."},
    {"parameter",
     "A number that is fitted: of the geometry (J2.a is the DH length a of joint J2), or of an "
     "effect."},
    {"nominal", "The value that stands in cell.toml, as the maker of the arm gives it."},
    {"fitted", "The value that explains the measurements best."},
    {"change", "Fitted minus nominal; of two runs, the second minus the first."},
    {"effect",
     "A physical cause of position errors, such as joint compliance. plumb explain lists them all; "
     "plumb add and plumb drop take the name in brackets."},
    {"effects", "What the model contains; x3 says that an effect stands in it three times."},
    {"candidate", "An effect at certain joints that may be missing from the model."},
    {"alone", "Held-out error in mm with this effect added to the present model and nothing else."},
    {"with #1",
     "Held-out error in mm with the first candidate and this one added. No lower than the first "
     "one alone: this candidate explains nothing that the first does not."},
    {"supported",
     "yes: the evidence and the folds of the fitted poses speak for the effect, so plumb diagnose "
     "--apply would add it; the held-out poses have no say in that. no gain: the same, but the "
     "error on the held-out poses does not fall. unlikely: the same, but hardly any arm has this "
     "effect so large, so "
     "another cause may be behind it. one of 2, one of 3 ...: these poses cannot tell the first "
     "from as many."},
    {"Complete",
     "Of a diagnosis: no effect of the library is supported by these readings beside those that "
     "the "
     "model has. Where more than the noise is left, the sentence says so."},
    {"Missing",
     "Of a diagnosis: an effect of the library explains what the model misses, and the error on "
     "readings that had no say falls with it."},
    {"Unknown",
     "Of a diagnosis: the errors have a structure that no effect of the library explains. The "
     "sentence names what it depends on, and how much of the error it is."},
    {"Undecidable",
     "Of a diagnosis: these readings cannot tell: there are too few poses, no noise is known, two "
     "effects explain them exactly as well, an effect that these poses cannot show or a part that "
     "moves slowly would explain them as well, or far more than the noise is left and nothing says "
     "what."},
    {"these poses cannot tell",
     "Of a diagnosis: two or more effects explain the readings nearly as well (a lead of less "
     "than 10 nats names the wrong one in every third case; along a path, where the arm's own "
     "numbers imitate nearly all that a load does, a larger one may, for no law is exact), and "
     "each "
     "can imitate the other. The "
     "error falls as far with either. plumb diagnose --apply adds the first, but none of them "
     "where one would be compiled and another thrown away; what else is supported beside them it "
     "adds. "
     "plumb plan --separate A,B proposes poses that tell."},
    {"Certain",
     "Of the first candidate: the evidence speaks for it by far, and no other candidate is near "
     "it. Rivals that the data cannot test are listed under Not testable."},
    {"Doubtful",
     "Of the first candidate: the fitted readings speak for it, but the error on readings that had "
     "no say does not fall, so plumb does not advise to add it."},
    {"no gain", "Supported by the fitted readings, but the held-out error does not fall with it."},
    {"unlikely",
     "Supported, but so large that hardly any arm has it: another cause may look like it."},
    {"stand out",
     "Readings that miss by far more than the others. The verdict leaves them out and names them, "
     "unless they are more than 15 in 100; the error table has a line with them and one without."},
    {"kept at nominal",
     "A number that these poses say too little about: it is not fitted and has the value of the "
     "cell file."},
    {"reflector",
     "The target of the laser tracker on the tool, also called retroreflector or SMR. Where it is "
     "in the tool frame is fitted, or given as target."},
    {"limit of the guard",
     "The largest correction that the controller-side program ever sends. A larger one is cut to "
     "it, and its status is limited."},
    {"trained range",
     "The range of joints, loads and temperatures that the fitted readings cover. Outside it the "
     "status is outside-domain and the correction fades out."},
    {"refused",
     "A target that is not corrected: out of reach, near a singularity, or far from the seed. Its "
     "status says which."},
    {"sigma_um",
     "[measurement] sigma_um in cell.toml: the noise of one measured coordinate, 1 sigma, in "
     "micrometres, as the data sheet of the tracker or repeats of a pose tell."},
    {"domain",
     "Whom an effect belongs to: the robot and its environment go into the model file; the "
     "measurement and its procedure are fitted so that they do not spoil the rest, and dropped."},
    {"ln Bayes",
     "Natural logarithm of the Bayes factor: how many times more probable the measurements are "
     "with "
     "the effect than without, each charged for what else it could have explained. 3 is 20 to 1, 5 "
     "is 150 to 1, 10 is 22,000 to 1."},
    {"evidence", "What speaks for an effect, as a Bayes factor: see ln Bayes."},
    {"fall", "By how much the RMS error falls on folds of the fit poses that had no say."},
    {"share", "Share of the squared error of the present model that the effect explains."},
    {"absorbed",
     "Share of the effect's motion that the fitted geometry can imitate. Near 100 % the effect can "
     "hardly be seen: other poses may show more of it."},
    {"size",
     "How far the effect moves the measured point at most, in mm, in a way that the geometry "
     "cannot "
     "imitate."},
    {"unlikely size", "See supported."},
    {"confounded",
     "Two effects that move the measured point alike at these poses, so that nobody can tell which "
     "of them it is. plumb plan --separate A,B proposes poses that can."},
    {"lack of fit",
     "What the model misses at distinct poses, held against what repeats of a pose scatter: more "
     "than that is systematic, and a better model can remove it."},
    {"F",
     "Ratio of two mean squares, here of what the model misses over what repeats scatter. 1 is "
     "what "
     "chance gives; F(a, b) names the independent numbers behind each."},
    {"systematic", "What repeats in the same way at the same pose, unlike noise."},
    {"by chance",
     "The probability of a figure at least so large if there were nothing to find. 1 in 1000 or "
     "less is counted as found."},
    {"autocorrelation",
     "Whether a reading misses like the one before it, from -1 to +1. Beyond what chance gives, "
     "something changes with time."},
    {"fold", "One of the K parts of a cross-validation: see kfold."},
    {"tolerance",
     "cell.tolerance_mm: how large the error may be at 95 % of the poses. It is yours to choose."},
    {"outlier",
     "A reading that lies more than six times the usual scatter off. It is left out of the fit; "
     "the verdict is on the held-out ones without it, and names it."},
    {"observability",
     "How well a set of poses shows the parameters; see observability index and condition."},
    {"condition",
     "Condition number of the scaled Jacobian: how unequally the poses show the parameters. Below "
     "100 is good, above 1000 some of them are guesses."},
    {"rank", "Short for identifiable rank."},
    {"leaves", "How many pieces the local tree has: see leaf."},
    {"trees", "Local linear model trees, one for each axis: see local_tree and leaf."},
    {"placed",
     "Mean distance in mm between measured and predicted points with the nominal arm, only frame "
     "and target fitted."},
    {"how the files are read",
     "One reading of the labels: DH convention, units, signs and directions of the joints."},
    {"used", "Range of the joint in the measurements."},
    {"limits", "Range of the joint in cell.toml."},
    {"testable", "Whether these measurements can show the effect at all."},
    {"why", "What keeps the measurements from showing the effect."},
    {"to measure", "Which measurements would show it."},
    {"joint", "A joint of the arm, by its name in cell.toml."},
    {"error", "Distance between the measured point and the predicted one."},
    {"dx", "Measured minus predicted along x of the measurement frame; dy and dz likewise."},
    {"dy", "Measured minus predicted along y of the measurement frame."},
    {"dz", "Measured minus predicted along z of the measurement frame."},
    {"worst", "The largest value over the poses that were looked at."},
    {"1 sigma of a predicted point (3-D)",
     "How uncertain the model's prediction is because its numbers are uncertain; what the model "
     "lacks does not count."},
    {"before", "With what was measured or fitted so far."},
    {"after", "With what is proposed or was added."},
    {"created", "When the run was made, in UTC."},
    {"alpha", "DH angle about x from one joint axis to the next: see DH."},
    {"a", "DH length along x from one joint axis to the next: see DH."},
    {"d", "DH length along the joint axis: see DH."},
    {"theta", "DH angle about the joint axis, added to the joint position: see DH."},
    {"beta", "Hayati's angle about y for near parallel axes: see Hayati."},
    {"q min", "Lower limit of the joint."},
    {"q max", "Upper limit of the joint."},
    {"now", "The present model, before anything is added."},
    {"calibrability",
     "Condition number of J^T J of the robot's parameters, in SI units: how unequally the poses "
     "show them. Small is good. It is infinite if two parameters cannot be told apart; those are "
     "held at nominal instead."},
    {"observability index",
     "One number for how well a set of poses shows the parameters, for example the geometric mean "
     "of the singular values of the Jacobian."},
    {"identifiable rank",
     "How many independent columns the Jacobian of all candidate parameters has: 27 for a general "
     "six-joint arm seen through one point with a fitted frame, 33 through a full pose. More "
     "parameters cannot be fitted from any poses."},
    {"residual", "Measured minus predicted. In compare it is given in the measurement frame."},
    {"leaf",
     "One piece of a local linear model tree: a box of joint positions with a linear formula, "
     "clamped to the errors seen there in training."},
    {"validity function",
     "The weight with which a leaf counts at a joint position. Crisp: 1 in its box, 0 elsewhere."},
    {"trained domain",
     "The box of joint positions of the fit poses, and the ranges of payload and temperatures that "
     "the effects were told there. Outside it the status is outside-domain. The tree fades to zero "
     "over 5 % of a joint's span; the rest of a correction holds as far (at least 2 deg), then "
     "fades to nothing over five times that way. Of a temperature 5 degC, of a payload a tenth are "
     "no matter; far beyond, the correction fades too."},
    {"TCP",
     "Tool centre point: origin of the tool frame, robot.tool seen from the flange. predict with a "
     "model file gives it in the base frame."},
    {"flange", "The mounting face of the last joint. The tool is stated relative to it."},
    {"pose",
     "Position and orientation. In a measurement file also one row: a configuration of the "
     "arm at which something was measured."},
    {"frame",
     "Where the base stands in the measurement's own frame (the tracker's). It is fitted unless "
     "given, belongs to the measurement, and is not compiled."},
    {"target",
     "The reflector's place in the tool frame. It is fitted unless given, belongs to the "
     "measurement, and is not compiled. For correct: the desired tool pose in the base frame."},
    {"DH",
     "Denavit-Hartenberg parameters: four numbers a joint. standard (distal): Rz(theta) Tz(d) "
     "Tx(a) "
     "Rx(alpha). modified (Craig, proximal): Rx(alpha) Tx(a) Rz(theta) Tz(d). The same table means "
     "another arm in the other convention."},
    {"Hayati",
     "Where neighbouring axes are near parallel their common normal is not defined, and d would "
     "run "
     "away. There Hayati's beta, a turn about y, takes the place of d."},
    {"reversal", "The error that depends on the side from which a joint arrived."},
    {"hysteresis", "An error that depends on the way, not only on the place: see reversal."},
    {"seed",
     "For correct: the joint state from which the command is sought, commanded joints first, then "
     "the last solution, then measured joints. For fit and simulate: the number from which every "
     "random choice follows."},
    {"kfold",
     "Cross-validation: the poses are dealt into K parts and each part is predicted by a model "
     "fitted on the others. Every pose then has a held-out error. Repeats stay together."},
    {"run", "One kept fit under runs/, never changed afterwards."},
    {"gate",
     "A limit that you ask for, --max-rms or --gate. If it is missed the exit code is 1 and "
     "nothing is written."},
    {"guard",
     "The part of the runtime that keeps the correction small, slow and continuous. Its limits act "
     "on the correction, never on the target."},
    {"place",
     "The folder into which plumb-rt install copies deploy folders, by custom /var/lib/plumb/NAME, "
     "and of which plumb-rt runs the current version."},
    {"version",
     "A copy of one deploy folder in a place, never changed again. Its name is the beginning of "
     "the SHA-256 of its SHA256SUMS, so that other content has another name."},
    {"signed",
     "With an Ed25519 signature over all files of a deploy folder, made by plumb deploy --sign. "
     "unsigned: without one, or nobody here can check it."},
    {"exit codes",
     "0 done, 1 a gate failed, 2 usage, 3 an input file is wrong, 4 the numbers say no, 5 "
     "environment, 70 bug, 130 interrupted."},
};

constexpr Explanation kStatus[] = {
    {"ok", "Everything was as it should be."},
    {"outside-domain",
     "The joints, the payload or a temperature are outside the trained domain: the tree has faded, "
     "and farther out so does the whole correction. Valid, but less certain."},
    {"context-fallback",
     "An input of an effect was missing or stale: its declared fallback was used. Valid."},
    {"limited",
     "The guard cut the correction to its size or slew limit; of predict: it would. Valid."},
    {"ramping", "The correction is still being ramped in. Valid."},
    {"partial",
     "Near a singular pose, in a cell that corrects the position only: the whole correction would "
     "turn some joints far or lies out of reach, so only a part of it is made. The position is "
     "never worse than without correction. Valid."},
    {"not-finite", "Refused: a target or joint position is NaN or infinite."},
    {"near-singular",
     "Refused: near this pose some direction can hardly be moved; the smallest singular value of "
     "the scaled Jacobian is under its limit. Move the target or choose another configuration."},
    {"other-configuration",
     "Refused: the solution lies in another configuration (elbow, wrist) than the seed. Give a "
     "seed nearer to the target."},
    {"far-from-seed",
     "Refused: the solution is farther from the seed than 0.2 rad. Give the commanded joints, or a "
     "seed nearer to the target."},
    {"not-converged",
     "Refused: more than 1 um or 1 urad is left, usually because the target is out of reach or "
     "the seed is far away."},
    {"seed-not-commanded",
     "Refused: more than six joints need the commanded joints as seed: columns qc1 ..."},
    {"no-model", "Refused: no model is loaded."},
};

}  // namespace

std::span<const Explanation> term_explanations() { return kTerms; }
std::span<const Explanation> status_explanations() { return kStatus; }

}  // namespace plumb::offline
