// SPDX-License-Identifier: Apache-2.0
#include "plumb/format/reader.hpp"

#include <cstring>
#include <fstream>
#include <optional>
#include <vector>

#include "model_generated.h"
#include "plumb/format/version.hpp"
#include "semantic_check.hpp"
#include "trailer.hpp"
#include "wire_copy.hpp"

namespace plumb::format {
namespace {

constexpr std::uint32_t kMaxNesting = 16;   // the schema needs 4
constexpr std::uint32_t kMaxTables = 4096;  // the largest model has fewer than 1000

ReadError error(ReadErrorCode code, std::string detail) { return {code, std::move(detail)}; }

ReadError too_large(std::uintmax_t bytes) {
  return error(ReadErrorCode::kTooLarge, "the file has " + std::to_string(bytes) +
                                             " bytes, no model has more than " +
                                             std::to_string(kMaxFileBytes));
}

std::optional<ReadError> check_envelope(std::span<const std::byte> bytes) {
  if (bytes.size() > kMaxFileBytes) return too_large(bytes.size());
  if (bytes.empty()) return error(ReadErrorCode::kTruncated, "the file is empty");
  if (bytes.size() < 8 || std::memcmp(bytes.data() + 4, wire::ModelIdentifier(), 4) != 0)
    return error(ReadErrorCode::kNotAModel, "this is not a Plumb model file");
  switch (internal::check_trailer(bytes)) {
    case internal::TrailerState::kSound:
      return std::nullopt;
    case internal::TrailerState::kWrongChecksum:
      return error(ReadErrorCode::kChecksum,
                   "the checksum is wrong: the file was damaged or edited");
    default:
      return error(ReadErrorCode::kTruncated,
                   "the file is cut short or was changed in transfer: its " +
                       std::to_string(bytes.size()) + " bytes do not end in their own length");
  }
}

/// Reads the schema version before the rest is verified: its place is all that every schema has in
/// common.
std::optional<std::uint32_t> schema_of(const std::uint8_t* data, std::size_t size) {
  flatbuffers::Verifier verifier(data, size, kMaxNesting, kMaxTables);
  const auto root = verifier.VerifyOffset(std::size_t{0});
  if (root == 0) return std::nullopt;
  const auto* table = reinterpret_cast<const flatbuffers::Table*>(data + root);
  constexpr auto kField = wire::Model::VT_SCHEMA_VERSION;
  if (!table->VerifyTableStart(verifier) ||
      !table->VerifyField<std::uint32_t>(verifier, kField, alignof(std::uint32_t)))
    return std::nullopt;
  return table->GetField<std::uint32_t>(kField, 0);
}

std::optional<ReadError> check_payload(const std::uint8_t* data, std::size_t size) {
  const auto schema = schema_of(data, size);
  if (!schema)
    return error(ReadErrorCode::kMalformed, "the content is malformed: it shows no schema version");
  if (*schema > kSchemaVersion)
    return error(ReadErrorCode::kNewerSchema, "the file has schema " + std::to_string(*schema) +
                                                  ", this Plumb reads up to " +
                                                  std::to_string(kSchemaVersion));
  if (*schema == 0) return error(ReadErrorCode::kInconsistent, "schema 0 does not exist");
  flatbuffers::Verifier verifier(data, size, kMaxNesting, kMaxTables);
  if (!wire::VerifyModelBuffer(verifier))
    return error(ReadErrorCode::kMalformed, "the content is malformed: an offset leads astray");
  return std::nullopt;
}

std::variant<Model, ReadError> read_payload(std::span<const std::byte> payload) {
  // The verifier checks offsets, not addresses: parse from memory aligned for doubles.
  std::vector<double> aligned((payload.size() + 7) / 8);
  std::memcpy(aligned.data(), payload.data(), payload.size());
  const auto* data = reinterpret_cast<const std::uint8_t*>(aligned.data());
  if (auto bad = check_payload(data, payload.size())) return *std::move(bad);
  auto copied = internal::copy_model(*wire::GetModel(data));
  if (const Model* model = std::get_if<Model>(&copied))
    if (const auto finding = internal::unsoundness(*model))
      return error(ReadErrorCode::kInconsistent, *finding);
  return copied;
}

}  // namespace

std::variant<Model, ReadError> read_model(std::span<const std::byte> bytes) {
  if (auto bad = check_envelope(bytes)) return *std::move(bad);
  return read_payload(bytes.first(bytes.size() - internal::kTrailerBytes));
}

std::variant<Model, ReadError> read_model(const std::filesystem::path& file) {
  std::error_code failed;
  const auto status = std::filesystem::status(file, failed);
  if (status.type() == std::filesystem::file_type::not_found)
    return error(ReadErrorCode::kCannotOpen, "there is no such file");
  if (failed) return error(ReadErrorCode::kCannotOpen, "it cannot be opened: " + failed.message());
  if (!std::filesystem::is_regular_file(status))
    return error(ReadErrorCode::kCannotOpen, "it is not a file");
  const auto size = std::filesystem::file_size(file, failed);
  if (failed) return error(ReadErrorCode::kCannotOpen, "it has no size: " + failed.message());
  if (size > kMaxFileBytes) return too_large(size);
  std::ifstream in(file, std::ios::binary);
  if (!in) return error(ReadErrorCode::kCannotOpen, "it cannot be opened");
  std::string text(static_cast<std::size_t>(size), '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (in.bad()) return error(ReadErrorCode::kCannotOpen, "it cannot be read");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return read_model(std::as_bytes(std::span(text)));
}

}  // namespace plumb::format
