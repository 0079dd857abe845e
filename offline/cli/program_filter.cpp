// SPDX-License-Identifier: Apache-2.0
#include "cli/program_filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "arm/effect_binding.hpp"
#include "program/shell_word.hpp"
#include "programs/lexer.hpp"
#include "programs/written.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

using programs::Joints;
using programs::Move;
using programs::Program;
using programs::Target;
using programs::Written;

constexpr double kTurnedByFilter_rad = 1e-9;  // less is rounding: the orientation stays as it is
constexpr double kSample_m = 0.01, kSample_rad = 0.1;  // between two points of a linear move
constexpr double kFewest = 8, kMost = 500;             // points of a linear move
constexpr double kSameJoints_rad = 1e-3;  // far less than from one solution to the next
constexpr double kSameTool_m = 1e-6, kSameTool_rad = 1e-5;

Targets one_target(const Transformd& X_BD) {
  const format::Pose pose = to_pose(X_BD);
  Targets out;
  out.p_B = Rows3(1, 3);
  out.quat_B = Rows4(1, 4);
  for (std::size_t i = 0; i < 3; ++i) out.p_B(0, static_cast<Eigen::Index>(i)) = pose.p[i];
  for (std::size_t i = 0; i < 4; ++i) out.quat_B(0, static_cast<Eigen::Index>(i)) = pose.q[i];
  out.commanded = true;
  return out;
}

/// Between two poses: the position on a straight line, the orientation about one axis.
Transformd between(const Transformd& X_BA, const Transformd& X_BE, double share) {
  Transformd out;
  out.p = X_BA.p + (X_BE.p - X_BA.p) * share;
  const Matrix3 turn = X_BA.R.transpose() * X_BE.R;
  out.R = product(X_BA.R, rotation_of(rotation_vector(turn) * share));
  return out;
}

}  // namespace

/// The work on one program.
class ProgramFilter::One {
 public:
  One(ProgramFilter& owner, const Program& program)
      : owner_(owner),
        program_(program),
        last_(owner.settings_.start),
        done_(program.targets.size()) {
    out_.decimals = programs::decimals_of(program, owner.settings_.least_decimals);
  }

  Filtered run(const programs::Language& language) {
    for (const Move& move : program_.moves) go(move);
    for (std::size_t t = 0; t < done_.size(); ++t) look(t);
    for (std::size_t m = 1; m < program_.moves.size(); ++m)
      look_between(program_.moves[m - 1], program_.moves[m]);
    out_.bytes = programs::edited(program_, edits_);
    for (std::size_t s = 0; s < out_.bytes.size(); ++s)
      if (out_.bytes[s] != program_.sources[s].bytes)
        out_.bytes[s] = programs::marked(language, out_.bytes[s], owner_.settings_.mark);
    std::stable_sort(out_.untouched.begin(), out_.untouched.end(),
                     [](const Untouched& a, const Untouched& b) { return a.line < b.line; });
    out_.targets = out_.corrected + static_cast<int>(out_.untouched.size());
    return out_;
  }

 private:
  /// A target that was worked on.
  struct Done {
    bool seen = false, corrected = false;
    Joints q;                        // nominal, at the target
    std::string why, help;           // why they are not known, of a target that is else
    std::optional<Transformd> X_BD;  // of the program's tool, desired; none: it is not known
    Transformd X_BC;                 // the same as it is written now
    Transformd X_BW;                 // of its work frame
    Transformd X_PT;                 // the model's tool in the program's
    std::string tool;
  };

  void go(const Move& move) {
    if (const Joints near = owner_.solutions_.of_controller(move.joints_deg); !near.empty())
      last_ = near;
    if (move.target < 0) return last_.clear();
    const auto t = static_cast<std::size_t>(move.target);
    visit(t, move.configured);
    last_ = done_[t].q;  // none: where the arm is now is not known
  }

  /// A move goes there: finds the joints, which must be the same at every visit.
  /// configured: the controller looks at the configuration then.
  void visit(std::size_t t, bool configured) {
    const Target& target = program_.targets[t];
    Done& done = done_[t];
    if (!may_be_corrected(target)) {
      done.q.clear();
    } else if (of_joints(target.written.notation)) {
      done.q = joints_of(target.written);
    } else if (done.X_BD || (!done.seen && place(target, done))) {
      find_joints(target, configured ? target.configuration : programs::Configuration{}, done);
    }
    done.seen = true;
  }

  bool may_be_corrected(const Target& target) const {
    return target.why.empty() && !(target.external_axes && !owner_.settings_.robot_stands);
  }

  void find_joints(const Target& target, const programs::Configuration& wanted, Done& done) {
    auto found = owner_.solutions_.find(*done.X_BD * done.X_PT, wanted, last_);
    if (!done.why.empty()) return done.q.clear();
    if (found.q.empty()) {
      done.why = found.why;
      done.help = found.help;
    } else if (!done.q.empty() && programs::distance(done.q, found.q) > kSameJoints_rad) {
      done.why = "moves reach it with different joint positions";
      done.help = "give each of them a target of its own";
    } else if (!side_agrees(target.configuration.side, found.q)) {
      done.why = fmt::format("the wrist that was found for it contradicts '{}' of other targets",
                             static_cast<char>(std::toupper(target.configuration.side)));
      done.help = "say where the joints are before its move, by a target of joints";
    } else {
      done.q = std::move(found.q);
      return;
    }
    done.q.clear();
  }

  /// One word for the side of axis 5 belongs to one sign of it.
  bool side_agrees(char word, const Joints& q) {
    if (word == 0 || q.size() != 6) return true;
    const bool negative = q[4] < 0.0;
    for (const auto& [other, its] : sides_)
      if ((other == word) != (its == negative)) return false;
    sides_.emplace(word, negative);
    return true;
  }

  void look(std::size_t t) {
    const Target& target = program_.targets[t];
    const bool joints = of_joints(target.written.notation);
    if (joints && !owner_.settings_.joint_targets && !target.written.numbers.empty())
      ++out_.joint_targets;
    else if (!target.why.empty())
      leave(target, target.why, target.help);
    else if (target.external_axes && !owner_.settings_.robot_stands)
      leave(target, "it moves an external axis, which may carry the robot or the work",
            "if none does: --robot-stands");
    else if (joints)
      correct_joints(target, done_[t]);
    else if (!done_[t].why.empty())
      refuse(target, done_[t].why, done_[t].help);
    else if (done_[t].X_BD)
      correct_pose(target, done_[t]);
  }

  void leave(const Target& target, std::string why, std::string help) {
    out_.untouched.push_back({.file = program_.sources[target.source].file,
                              .line = target.line,
                              .name = target.name,
                              .why = std::move(why),
                              .help = std::move(help)});
  }

  void refuse(const Target& target, std::string why, std::string help) {
    ++out_.refused;
    leave(target, std::move(why), std::move(help));
  }

  Joints joints_of(const Written& written) const {
    std::vector<double> values = programs::values_of(written);
    if (written.notation == programs::Notation::kJoints_rad)
      for (double& value : values) value = show::to_deg(value);
    return owner_.solutions_.of_controller(values);
  }

  /// The pose of a tool or frame by its name; null and listed if it is not known.
  const Transformd* frame(const char* what, const std::string& name, const programs::Frames& given,
                          const programs::Frames& stated, const Target& target) {
    const bool tool = std::string_view(what) == "tool";
    if (name.empty() || name[0] == '(') {
      leave(target, fmt::format("its {} is not known: {}", what, name.empty() ? "none" : name),
            fmt::format("name the {} in the move, and state it as plain numbers", what));
      return nullptr;
    }
    auto at = stated.find(name);
    if (const auto all = stated.find(programs::kAllFrames); all != stated.end()) at = all;
    if (at != stated.end() && at->second.moving) {
      leave(target, fmt::format("its {} '{}' is not known: {}", what, name, at->second.why),
            fmt::format("move it with a {} that stays the same in all of the program", what));
      return nullptr;
    }
    const auto option = given.find(programs::lower_case(name));
    if (option != given.end()) return &*option->second.X;
    if (at != stated.end() && at->second.X) return &*at->second.X;
    const bool spoilt = at != stated.end() && !at->second.why.empty();
    const std::string form = tool ? "=X,Y,Z,RX,RY,RZ or =model" : "=X,Y,Z,RX,RY,RZ";
    leave(
        target,
        fmt::format("its {} '{}'{}", what, name,
                    spoilt ? " is not known: " + at->second.why : " is not stated in the program"),
        fmt::format("say where it is: --{} {}{}", what, shell_word(name), form));
    return nullptr;
  }

  CorrectedRow correct(const Transformd& X_BD, const Joints& seed, KnownInputs& inputs) const {
    return corrected_row(owner_.poses_, one_target(X_BD), 0, seed, SeedKind::kCommanded,
                         owner_.sensors_, inputs);
  }

  /// Counts a target that was solved, and lists it if there is nothing to write.
  bool counted(const Target& target, const Joints& seed, const CorrectedRow& solved) {
    TargetTotals& all = owner_.found_;
    const Status status = solved.correction.status;
    all.counts.add(status);
    if (refused(status)) {
      Refusals one(owner_.poses_.corrector(), owner_.model_.nominal);
      for (Refusals* to : {&one, &all.refusals}) to->add(solved.X_BD, seed, status, true);
      refuse(target, "it " + one.words().substr(2),
             std::string("plumb explain ") + to_string(status));
      return false;
    }
    all.limited += solved.limited ? 1 : 0;
    all.faded += solved.faded ? 1 : 0;
    if (solved.faded)
      refuse(target, "it lies so far outside what was fitted that nothing is corrected",
             "measure there too, then: plumb fit");
    return !solved.faded;
  }

  /// Where it is, if its tool, its frame and its numbers say so; else it is listed.
  bool place(const Target& target, Done& done) {
    const FilterSettings& said = owner_.settings_;
    const Transformd* X_FP = frame("tool", target.tool, said.tools, program_.tools, target);
    if (X_FP == nullptr) return false;
    const Transformd* X_BW = frame("frame", target.frame, said.frames, program_.frames, target);
    if (X_BW == nullptr) return false;
    const auto X_WP = programs::pose_of(target.written);
    if (!X_WP) {
      leave(target, "its numbers are no pose: is its quaternion of length 1?", "mend its numbers");
      return false;
    }
    done.tool = target.tool;
    done.X_PT = X_FP->inverse() * from_pose(owner_.model_.nominal.tool);
    done.X_BW = *X_BW;
    done.X_BD = *X_BW * *X_WP;
    note_tool(target.tool, done.X_PT);
    return true;
  }

  void correct_pose(const Target& target, Done& done) {
    const Transformd X_BT = *done.X_BD * done.X_PT;
    const CorrectedRow solved = correct(X_BT, done.q, owner_.found_.inputs);
    if (!counted(target, done.q, solved)) return;
    const auto& q = solved.correction.q;
    if (!owner_.solutions_.agrees(target.configuration,
                                  Joints(q.begin(), q.begin() + std::ssize(done.q))))
      return refuse(target, "the correction would change the configuration or the turns it states",
                    "move it a little, or state the other configuration");
    Transformd X_BC = from_pose(solved.command);
    if (solved.moved_rad < kTurnedByFilter_rad) X_BC.R = X_BT.R;
    const Transformd X_WC = done.X_BW.inverse() * X_BC * done.X_PT.inverse();
    std::vector<double> old = programs::values_of(target.written);
    std::vector<double> values = programs::numbers_like(X_WC, target.written.notation, old);
    if (solved.moved_rad < kTurnedByFilter_rad)
      std::copy(old.begin() + 3, old.end(), values.begin() + 3);
    const auto written = write(target, values);
    done.corrected = true;
    const Transformd now = done.X_BW * *programs::pose_of(target.written.notation, written);
    done.X_BC = now;
    add_size(solved);
    out_.rounding_m = std::max(out_.rounding_m, (X_WC.p - (done.X_BW.inverse() * now).p).norm());
  }

  void correct_joints(const Target& target, Done& done) {
    if (done.q.empty())
      return leave(target, "it has not as many joints as the model", "check the model");
    const Transformd X_BD = owner_.poses_.corrector().nominal().forward(done.q);
    const CorrectedRow solved = correct(X_BD, done.q, owner_.found_.inputs);
    if (!counted(target, done.q, solved)) return;
    const Status status = solved.correction.status;
    if (status != Status::kOk && status != Status::kContextFallback)
      return refuse(target, "its joints cannot take a part of the correction only",
                    std::string("plumb explain ") + to_string(status));
    const auto& q = solved.correction.q;
    auto values =
        owner_.solutions_.to_controller(Joints(q.begin(), q.begin() + std::ssize(done.q)));
    if (target.written.notation == programs::Notation::kJoints_rad)
      for (double& value : values) value = show::from_deg(value);
    write(target, values);
    add_size(solved);
  }

  std::vector<double> write(const Target& target, const std::vector<double>& values) {
    auto made = programs::new_digits(program_, target, values, out_.decimals);
    ++out_.corrected;
    out_.changed += made.edits.empty() ? 0 : 1;
    edits_.insert(edits_.end(), made.edits.begin(), made.edits.end());
    return std::move(made.written);
  }

  void add_size(const CorrectedRow& solved) {
    out_.largest_m = std::max(out_.largest_m, solved.moved_m);
    owner_.found_.largest_m = std::max(owner_.found_.largest_m, solved.moved_m);
    owner_.found_.largest_rad = std::max(owner_.found_.largest_rad, solved.moved_rad);
  }

  void note_tool(const std::string& name, const Transformd& X_PT) {
    if (X_PT.p.norm() < kSameTool_m && rotation_vector(X_PT.R).norm() < kSameTool_rad) return;
    if (std::find(out_.other_tools.begin(), out_.other_tools.end(), name) == out_.other_tools.end())
      out_.other_tools.push_back(name);
  }

  /// Along a linear move between corrected targets: how far the written straight line lies from the
  /// commands that the straight line between the targets as they were would need. To first order
  /// this is how far the true arm is from that line.
  void look_between(const Move& from, const Move& to) {
    if (to.motion != programs::Motion::kLinear || from.target < 0 || to.target < 0) return;
    const Done& a = done_[static_cast<std::size_t>(from.target)];
    const Done& b = done_[static_cast<std::size_t>(to.target)];
    if (!a.corrected || !b.corrected || a.tool != b.tool || from.target == to.target) return;
    const double far = programs::distance(a.q, b.q);
    const double points = std::clamp(
        std::ceil(std::max((a.X_BD->p - b.X_BD->p).norm() / kSample_m, far / kSample_rad)), kFewest,
        kMost);
    KnownInputs unused(owner_.model_);
    Joints q = a.q;
    double largest = 0.0;
    for (double k = 1.0; k < points; ++k) {
      const Transformd X_BD = between(*a.X_BD, *b.X_BD, k / points);
      const CorrectedRow solved = correct(X_BD * a.X_PT, q, unused);
      if (refused(solved.correction.status)) return;
      std::copy_n(solved.correction.q.begin(), q.size(), q.begin());
      const Transformd X_BN = from_pose(solved.command) * a.X_PT.inverse();
      largest = std::max(largest, (X_BN.p - between(a.X_BC, b.X_BC, k / points).p).norm());
    }
    ++out_.linear_moves;
    out_.between_m = std::max(out_.between_m, largest);
  }

  ProgramFilter& owner_;
  const Program& program_;
  Joints last_;
  std::vector<Done> done_;
  std::map<char, bool> sides_;  // whether axis 5 is negative, by the word for it
  std::vector<programs::Edit> edits_;
  Filtered out_;
};

ProgramFilter::ProgramFilter(const format::Model& model, FilterSettings settings)
    : model_(model),
      poses_(model),
      solutions_(model.nominal),
      settings_(std::move(settings)),
      sensors_(temperature_names(model)),
      found_(poses_.corrector(), model.nominal, KnownInputs(model)) {}

ProgramFilter::~ProgramFilter() = default;

Filtered ProgramFilter::filter(const programs::Language& language, const Program& program) {
  return One(*this, program).run(language);
}

}  // namespace plumb::offline::cli
