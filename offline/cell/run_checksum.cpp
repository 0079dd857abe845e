// SPDX-License-Identifier: Apache-2.0
#include "cell/run_checksum.hpp"

#include "program/file.hpp"

namespace plumb::offline {
namespace {

constexpr const char* kOfPredictions = "predictions_sha256";
constexpr const char* kKey = "\"checksum\": \"";
constexpr std::size_t kDigits = 64;

/// Where the digits of the sum stand, or npos.
std::size_t digits_at(const std::string& text) {
  const std::size_t key = text.rfind(kKey);
  if (key == std::string::npos) return key;
  const std::size_t at = key + std::string(kKey).size();
  return at + kDigits < text.size() ? at : std::string::npos;
}

std::string with_zeros(std::string text, std::size_t at) {
  return text.replace(at, kDigits, kDigits, '0');
}

}  // namespace

std::string with_checksums(Json run, const std::string& predictions_csv) {
  run[kOfPredictions] = sha256(predictions_csv);
  run["checksum"] = std::string(kDigits, '0');
  std::string text = run.dump(1) + "\n";
  return text.replace(digits_at(text), kDigits, sha256(text));
}

bool json_sum_holds(const std::string& text) {
  const std::size_t at = digits_at(text);
  // A text that holds the sum of the predictions but not its own was edited.
  if (at == std::string::npos) return text.find(kOfPredictions) == std::string::npos;
  return text.substr(at, kDigits) == sha256(with_zeros(text, at));
}

bool predictions_sum_holds(const Json& run, const std::string& predictions_csv) {
  return is_predictions_sum(run, sha256(predictions_csv));
}

bool is_predictions_sum(const Json& run, const std::string& sha256_of_csv) {
  return !run.contains(kOfPredictions) || run.at(kOfPredictions) == sha256_of_csv;
}

bool has_checksums(const std::filesystem::path& run_folder) {
  return digits_at(read_file(run_folder / "run.json")) != std::string::npos;
}

}  // namespace plumb::offline
