// SPDX-License-Identifier: Apache-2.0
#include "plumb/format/reader.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <optional>

#include "model_generated.h"
#include "plumb/format/version.hpp"
#include "semantic_check.hpp"
#include "trailer.hpp"

namespace plumb::format {
namespace {

constexpr std::size_t kSmallestFile = 64;
constexpr int kMaxNesting = 16;
constexpr int kMaxTables = 4096;

ReadError error(ReadErrorCode code, std::string detail) { return {code, std::move(detail)}; }

Pose from_wire(const wire::Pose* x) {
  if (x == nullptr) return {};
  return {{x->px(), x->py(), x->pz()}, {x->qw(), x->qx(), x->qy(), x->qz()}};
}
Twist from_wire(const wire::Twist* x) {
  if (x == nullptr) return {};
  return {{x->dx(), x->dy(), x->dz()}, {x->ex(), x->ey(), x->ez()}};
}
std::string from_wire(const flatbuffers::String* x) {
  return x == nullptr ? std::string() : x->str();
}

/// A vector of numbers; absent means empty.
template <class T>
std::vector<T> from_wire(const flatbuffers::Vector<T>* x) {
  return x == nullptr ? std::vector<T>() : std::vector<T>(x->begin(), x->end());
}

/// A vector of tables; absent means empty.
template <class Table, class F>
auto each(const flatbuffers::Vector<flatbuffers::Offset<Table>>* tables, F convert) {
  std::vector<decltype(convert(*static_cast<const Table*>(nullptr)))> out;
  if (tables != nullptr)
    for (const Table* t : *tables) out.push_back(convert(*t));
  return out;
}

JointRow joint(const wire::Joint& w) {
  return {.name = from_wire(w.name()),
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
          .pre = from_wire(w.pre()),
          .post = from_wire(w.post())};
}

Chain chain(const wire::Chain& w) {
  return {.convention = static_cast<Convention>(w.convention()),
          .base = from_wire(w.base()),
          .base_twist = from_wire(w.base_twist()),
          .joints = each(w.joints(), joint),
          .tool_twist = from_wire(w.tool_twist()),
          .tool = from_wire(w.tool())};
}

ContextNeed context_need(const wire::ContextNeed& w) {
  return {static_cast<ContextInput>(w.input()), from_wire(w.name()), w.fallback()};
}

Effect effect(const wire::Effect& w) {
  return {.name = from_wire(w.name()),
          .version = w.version(),
          .joints = from_wire(w.joints()),
          .parameters = from_wire(w.parameters()),
          .context = each(w.context(), context_need)};
}

Tree tree(const wire::Tree& w) {
  Tree out;
  out.depth = w.depth();
  if (w.nodes() != nullptr)
    for (const wire::Node* n : *w.nodes())
      out.nodes.push_back({n->threshold(), n->input(), n->low(), n->high(), n->reserved()});
  out.coefficients = from_wire(w.coefficients());
  out.bounds = from_wire(w.bounds());
  out.blend_half_width = from_wire(w.blend_half_width());
  return out;
}

Domain domain(const wire::Domain* w) {
  if (w == nullptr) return {};
  return {from_wire(w->q_min()), from_wire(w->q_max()), w->fade()};
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

InputHash input_hash(const wire::InputHash& w) {
  return {from_wire(w.name()), from_wire(w.sha256())};
}

Provenance provenance(const wire::Provenance* w) {
  Provenance out;
  if (w == nullptr) return out;
  out.tool_version = from_wire(w->tool_version());
  out.created = from_wire(w->created());
  out.run = from_wire(w->run());
  out.inputs = each(w->inputs(), input_hash);
  out.poses_fit = w->poses_fit();
  if (const auto* h = w->held_out())
    out.held_out = {h->poses(), h->mean_m(), h->rms_m(), h->p95_m(), h->max_m()};
  out.noise_floor_m = w->noise_floor_m();
  if (w->parameter_names() != nullptr)
    for (const auto* name : *w->parameter_names()) out.parameter_names.push_back(from_wire(name));
  out.covariance = from_wire(w->covariance());
  return out;
}

std::variant<Model, ReadError> model(const wire::Model& w) {
  Model out;
  out.cell_name = from_wire(w.cell_name());
  out.robot_name = from_wire(w.robot_name());
  out.serial = from_wire(w.serial());
  out.gravity = {w.gravity_x(), w.gravity_y(), w.gravity_z()};
  out.nominal = chain(*w.nominal());
  out.calibrated = chain(*w.calibrated());
  out.effects = each(w.effects(), effect);
  if (w.trees() != nullptr && w.trees()->size() > out.trees.size())
    return error(ReadErrorCode::kInconsistent, "the model has more than three trees");
  const auto trees = each(w.trees(), tree);
  std::copy(trees.begin(), trees.end(), out.trees.begin());
  out.domain = domain(w.domain());
  out.guard = guard(*w.guard());
  out.provenance = provenance(w.provenance());
  if (const auto finding = internal::unsoundness(out))
    return error(ReadErrorCode::kInconsistent, *finding);
  return out;
}

std::optional<ReadError> check_envelope(std::span<const std::byte> bytes) {
  if (bytes.size() > kMaxFileBytes)
    return error(ReadErrorCode::kTooLarge, "the file is larger than any model");
  const bool ours =
      bytes.size() >= 8 && std::memcmp(bytes.data() + 4, wire::ModelIdentifier(), 4) == 0;
  if (!ours && !bytes.empty())
    return error(ReadErrorCode::kNotAModel, "this is not a Plumb model file");
  if (bytes.size() < kSmallestFile)
    return error(ReadErrorCode::kTruncated, "the file is cut short");
  switch (internal::check_trailer(bytes)) {
    case internal::TrailerState::kSound:
      return std::nullopt;
    case internal::TrailerState::kWrongChecksum:
      return error(ReadErrorCode::kChecksum,
                   "the checksum is wrong: the file was damaged or edited");
    default:
      return error(ReadErrorCode::kTruncated, "the file is cut short");
  }
}

std::variant<Model, ReadError> read_payload(std::span<const std::byte> payload) {
  // The verifier checks offsets, not addresses: parse from memory aligned for doubles.
  std::vector<double> aligned((payload.size() + 7) / 8);
  std::memcpy(aligned.data(), payload.data(), payload.size());
  const auto* data = reinterpret_cast<const std::uint8_t*>(aligned.data());
  flatbuffers::Verifier verifier(data, payload.size(), kMaxNesting, kMaxTables);
  if (!wire::VerifyModelBuffer(verifier))
    return error(ReadErrorCode::kMalformed, "the content is malformed");
  const wire::Model& root = *wire::GetModel(data);
  if (root.schema_version() > kSchemaVersion)
    return error(ReadErrorCode::kNewerSchema,
                 "the file has schema " + std::to_string(root.schema_version()) +
                     ", this Plumb reads up to " + std::to_string(kSchemaVersion));
  if (root.schema_version() == 0)
    return error(ReadErrorCode::kInconsistent, "schema 0 does not exist");
  return model(root);
}

}  // namespace

std::variant<Model, ReadError> read_model(std::span<const std::byte> bytes) {
  if (auto bad = check_envelope(bytes)) return *bad;
  return read_payload(bytes.first(bytes.size() - internal::kTrailerBytes));
}

std::variant<Model, ReadError> read_model(const std::filesystem::path& file) {
  std::error_code failed;
  const auto status = std::filesystem::status(file, failed);
  if (!std::filesystem::exists(status))
    return error(ReadErrorCode::kCannotOpen, "there is no such file");
  if (!std::filesystem::is_regular_file(status))
    return error(ReadErrorCode::kCannotOpen, "it is not a file");
  if (std::filesystem::file_size(file, failed) > kMaxFileBytes)
    return error(ReadErrorCode::kTooLarge, "the file is larger than any model");
  std::ifstream in(file, std::ios::binary);
  if (!in) return error(ReadErrorCode::kCannotOpen, "it cannot be opened");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return read_model(std::as_bytes(std::span(text)));
}

}  // namespace plumb::format
