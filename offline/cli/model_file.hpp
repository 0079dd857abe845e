// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "plumb/format/model.hpp"
#include "program/outcome.hpp"

namespace plumb::offline::cli {

/// Reads a model through the runtime's own reader; file and hash go to `outcome`.
/// Throws Failure (kInput, E-MODEL-...) with the reader's sentence.
format::Model open_model(const std::filesystem::path& file, Outcome& outcome);

/// The bytes of a model file, read back once to be sure.
/// Throws Failure (kNumbersSayNo) if the model is not sound.
std::string model_bytes(const format::Model& model);

}  // namespace plumb::offline::cli
