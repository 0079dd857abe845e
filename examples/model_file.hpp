// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <variant>

#include "plumb/format/reader.hpp"
#include "plumb/runtime/loaded_model.hpp"

/// The load phase of every example: read, verify, ask whether this library knows the effects.
inline std::unique_ptr<const plumb::LoadedModel> load_or_exit(const char* file) {
  auto read = plumb::format::read_model(std::filesystem::path(file));
  if (const auto* error = std::get_if<plumb::format::ReadError>(&read)) {
    std::fprintf(stderr, "%s: %s\n", file, error->detail.c_str());
    std::exit(3);
  }
  auto loaded = plumb::LoadedModel::make(std::get<plumb::format::Model>(std::move(read)));
  if (loaded == nullptr) {
    std::fprintf(stderr, "%s: needs an effect that this version does not have\n", file);
    std::exit(3);
  }
  return loaded;
}
