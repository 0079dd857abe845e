// SPDX-License-Identifier: Apache-2.0
#include "cli/model_file.hpp"

#include <fmt/format.h>

#include <span>
#include <stdexcept>

#include "arm/effect_binding.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "program/file.hpp"

namespace plumb::offline::cli {
namespace {

using format::ReadErrorCode;

struct Words {
  const char* code;
  const char* help;
};

Words words(ReadErrorCode code) {
  switch (code) {
    case ReadErrorCode::kCannotOpen:
      return {"E-MODEL-OPEN", "check the path; plumb compile makes a model file"};
    case ReadErrorCode::kTooLarge:
      return {"E-MODEL-SIZE", "this is not a model file of plumb"};
    case ReadErrorCode::kTruncated:
      return {"E-MODEL-TRUNCATED", "copy the file again, or: plumb compile"};
    case ReadErrorCode::kNotAModel:
      return {"E-MODEL-KIND", "name a file that plumb compile made"};
    case ReadErrorCode::kChecksum:
      return {"E-MODEL-CHECKSUM", "the file is damaged: copy it again, or: plumb compile"};
    case ReadErrorCode::kNewerSchema:
      return {"E-MODEL-NEWER", "install a newer plumb, or compile the model with this one"};
    case ReadErrorCode::kMalformed:
      return {"E-MODEL-MALFORMED", "copy the file again, or: plumb compile"};
    case ReadErrorCode::kInconsistent:
      return {"E-MODEL-INCONSISTENT", "compile it again: plumb compile"};
  }
  return {"E-MODEL-MALFORMED", "compile it again: plumb compile"};
}

}  // namespace

format::Model open_model(const std::filesystem::path& file, Outcome& outcome) {
  auto read = format::read_model(file);
  if (const auto* error = std::get_if<format::ReadError>(&read)) {
    const auto [code, help] = words(error->code);
    throw Failure(Exit::kInput, {.code = code,
                                 .message = error->detail,
                                 .place = Place{.file = file.string()},
                                 .help = help});
  }
  if (const auto why = unusable_effects(std::get<format::Model>(read)); !why.empty())
    throw Failure(Exit::kInput, {.code = "E-MODEL-EFFECT",
                                 .message = why,
                                 .place = Place{.file = file.string()},
                                 .help = "install a newer plumb, or compile it again"});
  outcome.inputs.push_back({file.string(), sha256(read_file(file))});
  return std::get<format::Model>(std::move(read));
}

std::string model_bytes(const format::Model& model) {
  try {
    const auto bytes = format::write_model(model);
    const auto back = format::read_model(std::span(bytes));
    if (const auto* error = std::get_if<format::ReadError>(&back))
      throw std::logic_error("a compiled model cannot be read back: " + error->detail);
    if (!(std::get<format::Model>(back) == model))
      throw std::logic_error("a compiled model does not read back to itself");
    std::string text(bytes.size(), '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i) text[i] = static_cast<char>(bytes[i]);
    return text;
  } catch (const std::invalid_argument& unsound) {
    throw Failure(Exit::kNumbersSayNo,
                  {.code = "E-MODEL-UNSOUND",
                   .message = fmt::format("the model is not sound: {}", unsound.what()),
                   .help = "look at the parameters: plumb fit --dry-run"});
  }
}

}  // namespace plumb::offline::cli
