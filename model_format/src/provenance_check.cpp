// SPDX-License-Identifier: Apache-2.0
#include "provenance_check.hpp"

#include <cmath>

#include "text_check.hpp"

namespace plumb::format::internal {
namespace {

using Finding = std::optional<std::string>;

constexpr std::size_t kMaxInputs = 64;   // input files that a model may name
constexpr std::size_t kHashDigits = 64;  // of a SHA-256 in hexadecimal
constexpr double kMaxError_m = 100.0;  // of a held-out figure; a larger one is no number of an arm
constexpr double kRounding = 1.0 + 1e-9;  // by which a mean may exceed the maximum

bool is_hash(const std::string& text) {
  return text.size() == kHashDigits &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

Finding check_inputs(const std::vector<InputHash>& inputs) {
  if (inputs.size() > kMaxInputs) return "provenance names too many input files";
  for (const auto& input : inputs) {
    if (auto f = unprintable(input.name, "the name of an input file")) return f;
    if (input.name.empty() || input.name.find('/') != std::string::npos)
      return "the name of an input file is empty or has folders: '" + input.name + "'";
    if (!is_hash(input.sha256))
      return "the SHA-256 of input '" + input.name + "' is not 64 hex digits";
  }
  return std::nullopt;
}

Finding check_figures(const Provenance& p) {
  const auto& h = p.held_out;
  for (double x : {h.mean_m, h.rms_m, h.p95_m, h.max_m})
    if (!(x >= 0.0 && x <= kMaxError_m)) return "a held-out figure is out of range";
  if (!(p.noise_floor_m >= 0.0 && p.noise_floor_m <= kMaxError_m))
    return "the noise floor is out of range";
  if (h.mean_m > h.rms_m * kRounding) return "the held-out mean is larger than the rms";
  if (h.rms_m > h.max_m * kRounding) return "the held-out rms is larger than the maximum";
  if (h.p95_m > h.max_m * kRounding) return "the held-out p95 is larger than the maximum";
  return std::nullopt;
}

Finding check_covariance(const Provenance& p) {
  const std::size_t k = p.parameter_names.size();
  if (k > kMaxParameters)
    return "there are too many fitted parameters: " + std::to_string(k) + ", at most " +
           std::to_string(kMaxParameters);
  for (const auto& name : p.parameter_names)
    if (auto f = unprintable(name, "the name of a fitted parameter")) return f;
  if (p.covariance.empty()) return std::nullopt;
  if (p.covariance.size() != k * (k + 1) / 2)
    return "the covariance does not fit the number of parameters";
  for (float x : p.covariance)
    if (!std::isfinite(x)) return "the covariance is not finite";
  for (std::size_t i = 0; i < k; ++i)
    if (p.covariance[i * (i + 1) / 2 + i] < 0.0F)
      return "the variance of '" + p.parameter_names[i] + "' is negative";
  return std::nullopt;
}

}  // namespace

Finding unsound_provenance(const Provenance& p) {
  for (const auto* text : {&p.tool_version, &p.created, &p.run})
    if (auto f = unprintable(*text, "provenance")) return f;
  if (auto f = check_inputs(p.inputs)) return f;
  if (auto f = check_figures(p)) return f;
  return check_covariance(p);
}

}  // namespace plumb::format::internal
