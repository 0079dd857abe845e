// SPDX-License-Identifier: Apache-2.0
#include "wire_copy.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include "model_generated.h"

namespace plumb::format::internal {
namespace {

template <class Table>
using Tables = flatbuffers::Vector<flatbuffers::Offset<Table>>;

Pose pose(const wire::Pose* x) {
  if (x == nullptr) return {};
  return {{x->px(), x->py(), x->pz()}, {x->qw(), x->qx(), x->qy(), x->qz()}};
}

Twist twist(const wire::Twist* x) {
  if (x == nullptr) return {};
  return {{x->dx(), x->dy(), x->dz()}, {x->ex(), x->ey(), x->ez()}};
}

GuardLimits guard(const wire::Guard& w) {
  return {.corrects = static_cast<Corrects>(w.corrects()),
          .max_correction_m = w.max_correction_m(),
          .max_rotation_rad = w.max_rotation_rad(),
          .slew_m_per_s = w.slew_m_per_s(),
          .slew_rad_per_s = w.slew_rad_per_s(),
          .ramp_s = w.ramp_s(),
          .cycle_s = w.cycle_s(),
          .length_scale_m = w.length_scale_m(),
          .min_singular_value = w.min_singular_value(),
          .max_seed_distance = w.max_seed_distance()};
}

/// Copies within a budget of bytes and keeps the first error.
class Copier {
 public:
  Model model(const wire::Model& w) {
    Model out;
    out.cell_name = text(w.cell_name());
    out.robot_name = text(w.robot_name());
    out.serial = text(w.serial());
    out.gravity = {w.gravity_x(), w.gravity_y(), w.gravity_z()};
    out.nominal = chain(*w.nominal());
    out.calibrated = chain(*w.calibrated());
    out.effects = each(w.effects(), [this](const auto& x) { return effect(x); });
    if (w.trees() == nullptr || w.trees()->size() <= kTreeAxes) {
      auto trees = each(w.trees(), [this](const auto& x) { return tree(x); });
      std::move(trees.begin(), trees.end(), out.trees.begin());
    } else {
      refuse(ReadErrorCode::kInconsistent,
             "the model has " + std::to_string(w.trees()->size()) + " trees for 3 axes");
    }
    out.domain = domain(w.domain());
    out.guard = guard(*w.guard());
    out.provenance = provenance(w.provenance());
    out.mechanics = mechanics(w.mechanics());
    return out;
  }

  std::optional<ReadError> refusal() const { return refusal_; }

 private:
  void refuse(ReadErrorCode code, const std::string& detail) {
    if (!refusal_) refusal_ = ReadError{code, detail};
  }

  /// Takes `bytes` from the budget. False if they exceed it or something was refused before.
  bool affords(std::size_t bytes) {
    if (!refusal_ && bytes <= left_) {
      left_ -= bytes;
      return true;
    }
    refuse(ReadErrorCode::kMalformed, "the content is malformed: its parts exceed the whole");
    return false;
  }

  /// True if the elements of a vector may be read: it is not empty, aligned and within the budget.
  template <class T>
  bool readable(const flatbuffers::Vector<T>* x, std::size_t alignment, std::size_t size) {
    if (x == nullptr || x->size() == 0) return false;  // an empty vector need not be aligned
    if (reinterpret_cast<std::uintptr_t>(x->Data()) % alignment == 0)
      return affords(x->size() * size);
    refuse(ReadErrorCode::kMalformed, "the content is malformed: misaligned numbers");
    return false;
  }

  std::string text(const flatbuffers::String* x) {
    if (x == nullptr || !affords(sizeof(std::string) + x->size())) return {};
    return x->str();
  }

  template <class T>
  std::vector<T> numbers(const flatbuffers::Vector<T>* x) {
    if (!readable(x, alignof(T), sizeof(T))) return {};
    return {x->begin(), x->end()};
  }

  template <class Table, class F>
  std::vector<std::invoke_result_t<F, const Table&>> each(const Tables<Table>* tables, F convert) {
    std::vector<std::invoke_result_t<F, const Table&>> out;
    if (tables == nullptr) return out;
    for (const Table* t : *tables) {
      if (refusal_) break;
      out.push_back(convert(*t));
    }
    return out;
  }

  JointRow joint(const wire::Joint& w) {
    return {.name = text(w.name()),
            .type = static_cast<JointType>(w.type()),
            .alpha = w.alpha(),
            .a = w.a(),
            .d = w.d(),
            .theta = w.theta(),
            .beta = w.beta(),
            .scale = w.scale(),
            .offset = w.offset(),
            .q_min = w.q_min(),
            .q_max = w.q_max(),
            .pre = twist(w.pre()),
            .post = twist(w.post())};
  }

  std::vector<JointCoupling> coupling(const flatbuffers::Vector<const wire::Coupling*>* x) {
    std::vector<JointCoupling> out;
    if (!readable(x, alignof(wire::Coupling), sizeof(JointCoupling))) return out;
    for (const wire::Coupling* one : *x) out.push_back({one->joint(), one->by(), one->ratio()});
    return out;
  }

  Chain chain(const wire::Chain& w) {
    return {.convention = static_cast<Convention>(w.convention()),
            .base = pose(w.base()),
            .base_twist = twist(w.base_twist()),
            .joints = each(w.joints(), [this](const auto& x) { return joint(x); }),
            .tool_twist = twist(w.tool_twist()),
            .tool = pose(w.tool()),
            .coupling = coupling(w.coupling())};
  }

  Formula formula(const wire::Formula* w) {
    if (w == nullptr) return {};
    return {.name = text(w->name()),
            .target = static_cast<FormulaTarget>(w->target()),
            .joint = w->joint(),
            .component = w->component(),
            .domain = w->domain(),
            .expression = text(w->expression()),
            .code = numbers(w->code()),
            .literals = numbers(w->literals()),
            .parameters = each(w->parameters(), [this](const auto& x) {
              return FormulaParameter{text(x.name()), text(x.unit()), x.typical(), x.start()};
            })};
  }

  Effect effect(const wire::Effect& w) {
    return {.name = text(w.name()),
            .version = w.version(),
            .joints = numbers(w.joints()),
            .parameters = numbers(w.parameters()),
            .context = each(w.context(),
                            [this](const auto& x) {
                              return ContextNeed{static_cast<ContextInput>(x.input()),
                                                 text(x.name()), x.fallback()};
                            }),
            .constants = numbers(w.constants()),
            .formula = formula(w.formula())};
  }

  Mechanics mechanics(const wire::Mechanics* w) {
    Mechanics out;
    if (w == nullptr) return out;
    if (readable(w->links(), alignof(wire::LinkMass), sizeof(LinkMass)))
      for (const wire::LinkMass* link : *w->links())
        out.links.push_back({link->mass_kg(), {link->cx(), link->cy(), link->cz()}});
    out.payload_kg = w->payload_kg();
    out.payload_com_m = {w->payload_cx(), w->payload_cy(), w->payload_cz()};
    return out;
  }

  std::vector<TreeNode> nodes(const flatbuffers::Vector<const wire::Node*>* x) {
    std::vector<TreeNode> out;
    if (!readable(x, alignof(wire::Node), sizeof(TreeNode))) return out;
    for (const wire::Node* n : *x)
      out.push_back({n->threshold(), n->input(), n->low(), n->high(), n->reserved()});
    return out;
  }

  Tree tree(const wire::Tree& w) {
    return {.depth = w.depth(),
            .nodes = nodes(w.nodes()),
            .coefficients = numbers(w.coefficients()),
            .bounds = numbers(w.bounds()),
            .blend_half_width = numbers(w.blend_half_width()),
            .degree = w.degree(),
            .directions = numbers(w.directions()),
            .region = numbers(w.region()),
            .sigma = numbers(w.sigma())};
  }

  Domain domain(const wire::Domain* w) {
    if (w == nullptr) return {};
    return {numbers(w->q_min()), numbers(w->q_max()), w->fade(),
            each(w->context(), [this](const auto& x) {
              return ContextRange{static_cast<ContextInput>(x.input()), text(x.name()), x.low(),
                                  x.high()};
            })};
  }

  Provenance provenance(const wire::Provenance* w) {
    Provenance out;
    if (w == nullptr) return out;
    out.tool_version = text(w->tool_version());
    out.created = text(w->created());
    out.run = text(w->run());
    out.inputs = each(w->inputs(), [this](const auto& x) {
      return InputHash{text(x.name()), text(x.sha256())};
    });
    out.poses_fit = w->poses_fit();
    if (const auto* h = w->held_out())
      out.held_out = {h->poses(), h->mean_m(), h->rms_m(), h->p95_m(), h->max_m()};
    out.noise_floor_m = w->noise_floor_m();
    out.parameter_names = each(w->parameter_names(), [this](const auto& x) { return text(&x); });
    out.covariance = numbers(w->covariance());
    return out;
  }

  std::size_t left_ = kMaxFileBytes;
  std::optional<ReadError> refusal_;
};

}  // namespace

std::variant<Model, ReadError> copy_model(const wire::Model& model) {
  Copier copier;
  Model out = copier.model(model);
  if (auto refusal = copier.refusal()) return *std::move(refusal);
  return out;
}

}  // namespace plumb::format::internal
