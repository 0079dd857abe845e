// SPDX-License-Identifier: Apache-2.0
// Every schema there was: its files are read to what they said, and its reader reads what today's
// writer says in it. flatc --conform compares the schemas too, but lets the last field of a table
// be removed, and sees nothing of the code that copies.
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <sstream>

#include "golden_models.hpp"
#include "old_writer.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/version.hpp"
#include "plumb/format/writer.hpp"
#include "random_model.hpp"
#include "wire_retyped_generated.h"
#include "wire_swapped_generated.h"
#include "wire_v1_generated.h"
#include "wire_v2_generated.h"
#include "wire_v3_generated.h"

namespace plumb::format {
namespace {

constexpr std::uint64_t kModels = 200;

/// A model in which every field says something.
Model telling_model(std::uint64_t seed) {
  Model out = random_model(seed);
  if (out.nominal.joints.size() < 2) return telling_model(seed + kModels);
  out.effects.push_back(formula_model().effects[0]);
  out.effects[0].constants = {1.5, -2.5};
  out.domain.context = ranges_model().domain.context;
  out.mechanics = {{out.nominal.joints.size(), {7.0, {0.1, 0.2, 0.3}}}, 3.0, {0.01, 0.02, 0.03}};
  return out;
}

/// The same with what schema 1 could say of trees.
Model of_schema_one(Model model) {
  model.domain.context.clear();
  for (Tree& tree : model.trees) {
    if (tree.bounds.empty()) continue;
    const std::size_t leaves = tree.leaves(), terms = 1 + model.nominal.joints.size();
    tree.blend_half_width.clear();
    tree.directions.clear();
    tree.region.clear();
    tree.sigma.clear();
    tree.degree = 1;
    tree.coefficients.resize(leaves * terms);
  }
  return model;
}

/// Whether a file written under the schema of ModelT says the same to today's reader.
template <class ModelT>
bool is_read(const Model& model, std::uint32_t schema) {
  const auto file = sealed(old::packed(old::model<ModelT>(model, schema)));
  const auto read = read_model(file);
  const auto* same = std::get_if<Model>(&read);
  return same != nullptr && *same == model;
}

/// And whether today's file says the same to the reader of that schema.
template <class ModelT>
bool is_understood(const Model& model) {
  const Bytes file = write_model(model);
  const std::size_t payload = file.size() - kTrailer;
  const auto* data = reinterpret_cast<const std::uint8_t*>(file.data());
  flatbuffers::Verifier verifier(data, payload);
  if (!verifier.VerifyBuffer<typename ModelT::TableType>("PLMB")) return false;
  ModelT object;
  flatbuffers::GetRoot<typename ModelT::TableType>(data)->UnPackTo(&object);
  return old::packed(object) == old::packed(old::model<ModelT>(model, object.schema_version));
}

/// Of all models: whether each survives.
template <class Survives>
std::uint64_t survivors(Survives survives) {
  std::uint64_t out = 0;
  for (std::uint64_t seed = 1; seed <= kModels; ++seed)
    out += survives(telling_model(seed)) ? 1 : 0;
  return out;
}

TEST(Evolution, FilesWrittenUnderSchemaOneAreReadToWhatTheySaid) {
  EXPECT_EQ(survivors([](const Model& m) { return is_read<wire_v1::ModelT>(of_schema_one(m), 1); }),
            kModels);
}

TEST(Evolution, FilesWrittenUnderSchemaTwoAreReadToWhatTheySaid) {
  EXPECT_EQ(survivors([](const Model& m) { return is_read<wire_v2::ModelT>(m, 2); }), kModels);
}

TEST(Evolution, ReadersOfSchemaOneUnderstandWhatIsWrittenInItToday) {
  EXPECT_EQ(
      survivors([](const Model& m) { return is_understood<wire_v1::ModelT>(of_schema_one(m)); }),
      kModels);
}

TEST(Evolution, ReadersOfSchemaTwoUnderstandWhatIsWrittenInItToday) {
  EXPECT_EQ(survivors([](const Model& m) { return is_understood<wire_v2::ModelT>(m); }), kModels);
}

/// The same of a controller that couples its last two joints.
Model with_coupling(Model model) {
  const auto last = static_cast<std::uint8_t>(model.nominal.joints.size() - 1);
  const auto by = static_cast<std::uint8_t>(last - 1);
  model.nominal.joints[by].type = model.calibrated.joints[by].type =
      model.nominal.joints[last].type;
  model.nominal.coupling = model.calibrated.coupling = {{last, by, -0.5}};
  return model;
}

TEST(Evolution, FilesWrittenUnderSchemaThreeAreReadToWhatTheySaid) {
  EXPECT_EQ(survivors([](const Model& m) { return is_read<wire_v3::ModelT>(with_coupling(m), 3); }),
            kModels);
}

TEST(Evolution, ReadersOfSchemaThreeUnderstandWhatIsWrittenInItToday) {
  EXPECT_EQ(
      survivors([](const Model& m) { return is_understood<wire_v3::ModelT>(with_coupling(m)); }),
      kModels);
}

TEST(Evolution, TwoFieldsThatChangedPlacesAreCaught) {
  const Model model = telling_model(1);
  EXPECT_FALSE(is_read<wire_swapped::ModelT>(model, 2));
  EXPECT_FALSE(is_understood<wire_swapped::ModelT>(model));
}

TEST(Evolution, AFieldOfAnotherTypeIsCaught) {
  const Model model = telling_model(1);
  EXPECT_FALSE(is_read<wire_retyped::ModelT>(model, 2));
  EXPECT_FALSE(is_understood<wire_retyped::ModelT>(model));
}

TEST(Evolution, AFileOfTheNextSchemaIsCalledNewer) {
  const auto file =
      sealed(old::packed(old::model<wire_v3::ModelT>(telling_model(1), kSchemaVersion + 1)));
  const auto read = read_model(file);
  ASSERT_TRUE(std::holds_alternative<ReadError>(read));
  EXPECT_EQ(std::get<ReadError>(read).code, ReadErrorCode::kNewerSchema);
}

/// Without comments and blanks.
std::string statements(const std::string& file) {
  std::ifstream in(file);
  std::string out, line, word;
  while (std::getline(in, line))
    for (std::istringstream words(line.substr(0, line.find("//"))); words >> word;)
      out += word + " ";
  return out;
}

TEST(Evolution, TheHistoryEndsWithTodaysSchema) {
  const std::string newest = PLUMB_HISTORY "/model_v" + std::to_string(kSchemaVersion) + ".fbs";
  ASSERT_FALSE(statements(newest).empty()) << newest;
  EXPECT_EQ(statements(newest), statements(PLUMB_SCHEMA)) << "see tests/format/history/README.md";
}

}  // namespace
}  // namespace plumb::format
