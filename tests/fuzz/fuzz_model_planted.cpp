// SPDX-License-Identifier: Apache-2.0
// Planted: a reader that trusts the verifier and leaves out the semantic check.
#include <cstdint>
#include <cstring>
#include <vector>

#include "model_generated.h"
#include "seal.hpp"
#include "tests/fuzz/model_laws.hpp"
#include "wire_copy.hpp"

using namespace plumb;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < format::kTrailer) return 0;
  std::vector<double> aligned((size + 7) / 8);
  std::memcpy(aligned.data(), data, size);
  const auto* payload = reinterpret_cast<const std::uint8_t*>(aligned.data());
  flatbuffers::Verifier verifier(payload, size - format::kTrailer);
  if (!format::wire::VerifyModelBuffer(verifier)) return 0;
  const auto copied = format::internal::copy_model(*format::wire::GetModel(payload));
  if (const auto* model = std::get_if<format::Model>(&copied)) tests::require_sound(*model, size);
  return 0;
}
