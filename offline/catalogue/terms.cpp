// SPDX-License-Identifier: Apache-2.0
#include "catalogue/explanation.hpp"

namespace plumb::offline {
namespace {

constexpr Explanation kTerms[] = {
    {"held-out",
     "Poses that nothing of the fit has seen: not the parameters, not the rank analysis, not the "
     "size of the tree. Their error is the accuracy to expect on new poses of the same kind. The "
     "error on the fit poses is always smaller and is never accuracy."},
    {"noise floor",
     "The error that measurement noise alone would leave, whatever the model: 1.60 sigma for the "
     "mean and 1.73 sigma for the RMS of a 3-D error. It comes from repeats of a pose, or from "
     "sigma_um. A held-out error at the floor means: nothing more can be learnt from these poses."},
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
     "The box of joint positions of the fit poses. Outside it the tree fades to zero over 5 % of "
     "the span and physics alone remains; the status is then outside-domain."},
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
    {"exit codes",
     "0 done, 1 a gate failed, 2 usage, 3 an input file is wrong, 4 the numbers say no, 5 "
     "environment, 70 bug, 130 interrupted."},
};

constexpr Explanation kStatus[] = {
    {"ok", "Everything was as it should be."},
    {"outside-domain",
     "The joints are outside the trained domain: the tree has faded, physics only. Valid, but less "
     "certain."},
    {"context-fallback",
     "An input of an effect was missing or stale: its declared fallback was used. Valid."},
    {"limited", "The guard cut the correction to its size or slew limit. Valid."},
    {"ramping", "The correction is still being ramped in. Valid."},
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
