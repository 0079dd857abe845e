// SPDX-License-Identifier: Apache-2.0
// Files our writer would not make: of other schemas, sparse, hostile.
#include <gtest/gtest.h>

#include <functional>

#include "consistency.hpp"
#include "golden_models.hpp"
#include "model_generated.h"
#include "plumb/format/reader.hpp"
#include "plumb/format/version.hpp"
#include "plumb/format/writer.hpp"
#include "seal.hpp"

namespace plumb::format {
namespace {

using Builder = flatbuffers::FlatBufferBuilder;
template <class T>
using Offset = flatbuffers::Offset<T>;

Offset<wire::Chain> one_joint(Builder& b) {
  const auto joint = wire::CreateJoint(b, b.CreateString("J1"), wire::JointType::Revolute, 0, 0, 0,
                                       0, 0, 1.0, 0, -1.0, 1.0);
  return wire::CreateChain(b, wire::Convention::Standard, nullptr, nullptr,
                           b.CreateVector(std::vector<Offset<wire::Joint>>{joint}));
}

Offset<wire::Guard> guard(Builder& b) {
  const GuardLimits g;
  return wire::CreateGuard(b, wire::Corrects::Position, g.max_correction_m, g.max_rotation_rad,
                           g.slew_m_per_s, g.slew_rad_per_s, g.ramp_s, g.cycle_s, g.length_scale_m,
                           g.min_singular_value, g.max_seed_distance);
}

/// What is given beside the fields a model must have.
struct Extra {
  std::uint32_t schema = kSchemaVersion;
  Offset<flatbuffers::Vector<Offset<wire::Effect>>> effects = 0;
  Offset<flatbuffers::Vector<Offset<wire::Tree>>> trees = 0;
  Offset<wire::Domain> domain = 0;
  Offset<wire::Provenance> provenance = 0;
};

Bytes file(Builder& b, const Extra& extra) {
  const auto chain = one_joint(b);
  const auto limits = guard(b);
  wire::FinishModelBuffer(
      b, wire::CreateModel(b, extra.schema, 0, 0, 0, 0, 0, 0, chain, chain, extra.effects,
                           extra.trees, extra.domain, limits, extra.provenance));
  const auto* data = reinterpret_cast<const std::byte*>(b.GetBufferPointer());
  return sealed({data, data + b.GetSize()});
}

ReadError refusal(const Bytes& bytes) {
  const auto read = read_model(bytes);
  if (const auto* error = std::get_if<ReadError>(&read)) return *error;
  ADD_FAILURE() << "accepted";
  return {};
}

TEST(Wire, EveryOptionalFieldMayBeAbsent) {
  Builder b;
  const auto read = read_model(file(b, {}));
  ASSERT_TRUE(std::holds_alternative<Model>(read)) << std::get<ReadError>(read).detail;
  const Model& m = std::get<Model>(read);
  EXPECT_EQ(inconsistency(m), "");
  EXPECT_EQ(m.nominal.base, Pose{});
  EXPECT_EQ(m.nominal.joints[0].pre, Twist{});
  EXPECT_EQ(m.serial, "");
  EXPECT_EQ(m.trees[2], Tree{});
  EXPECT_EQ(m.domain, Domain{});
  EXPECT_EQ(m.provenance, Provenance{});
}

TEST(Wire, InnerOptionalFieldsMayBeAbsentToo) {
  Builder b;
  Extra extra;
  const auto need = wire::CreateContextNeed(b);
  const auto effect =
      wire::CreateEffect(b, b.CreateString("reversal"), 1, 0, 0,
                         b.CreateVector(std::vector<Offset<wire::ContextNeed>>{need}));
  extra.effects = b.CreateVector(std::vector<Offset<wire::Effect>>{effect});
  extra.trees = b.CreateVector(std::vector<Offset<wire::Tree>>{wire::CreateTree(b)});
  extra.domain = wire::CreateDomain(b);
  extra.provenance = wire::CreateProvenance(b);
  const auto read = read_model(file(b, extra));
  ASSERT_TRUE(std::holds_alternative<Model>(read)) << std::get<ReadError>(read).detail;
  EXPECT_EQ(inconsistency(std::get<Model>(read)), "");
  EXPECT_EQ(std::get<Model>(read).effects[0].context[0], ContextNeed{});
}

TEST(Wire, ANewerSchemaIsNamedWithBothVersions) {
  Builder b;
  const auto error = refusal(file(b, {.schema = 4711}));
  EXPECT_EQ(error.code, ReadErrorCode::kNewerSchema);
  EXPECT_NE(error.detail.find("4711"), std::string::npos);
  EXPECT_NE(error.detail.find(std::to_string(kSchemaVersion)), std::string::npos);
}

TEST(Wire, ANewerSchemaIsNewerEvenIfNothingElseIsAsWeKnowIt) {
  Builder b;
  const auto start = b.StartTable();
  b.AddElement<std::uint32_t>(wire::Model::VT_SCHEMA_VERSION, kSchemaVersion + 1, 0);
  b.AddElement<std::uint8_t>(wire::Model::VT_NOMINAL, 9, 0);  // a chain, say we
  b.Finish(Offset<wire::Model>(b.EndTable(start)), wire::ModelIdentifier());
  const auto* data = reinterpret_cast<const std::byte*>(b.GetBufferPointer());
  EXPECT_EQ(refusal(sealed({data, data + b.GetSize()})).code, ReadErrorCode::kNewerSchema);
}

TEST(Wire, EverySchemaUpToOursIsReadAndTheNextIsNewer) {
  static_assert(kSchemaVersion == 3);
  for (std::uint32_t schema : {1U, 2U, 3U}) {
    Builder b;
    EXPECT_TRUE(std::holds_alternative<Model>(read_model(file(b, {.schema = schema})))) << schema;
  }
  Builder b;
  EXPECT_EQ(refusal(file(b, {.schema = 4})).code, ReadErrorCode::kNewerSchema);
}

TEST(Wire, ATreeThatIsCrispAndAffineIsWrittenForReadersOfSchemaOne) {
  Model m = planar_2r_model();
  EXPECT_EQ(stated_schema(write_model(m)), 1U);
  m.trees[0].sigma = {1e-6F};  // an old reader loses nothing it knew
  EXPECT_EQ(stated_schema(write_model(m)), 1U);
}

TEST(Wire, EachKindOfTreeThatAnOldReaderWouldMisreadIsWrittenAsSchemaTwo) {
  const std::vector<std::pair<std::string, std::function<void(Tree&)>>> kinds{
      {"blended", [](Tree& t) { t.blend_half_width = {0.5}; }},
      {"quadratic", [](Tree& t) { t.degree = 2, t.coefficients.resize(12); }},
      {"oblique",
       [](Tree& t) {
         t.directions = {0.5, 0.5};
       }},
      {"region", [](Tree& t) { t.region.assign(8, 0.5F); }}};
  Model crisp = planar_2r_model();
  crisp.trees[1] = {.depth = 1,
                    .nodes = {{0.0, 0, ~0, ~1, 0}},
                    .coefficients = std::vector<double>(6, 1e-5),
                    .bounds = {-1e-4, 1e-4, -1e-4, 1e-4}};
  EXPECT_EQ(stated_schema(write_model(crisp)), 1U);
  for (const auto& [name, make] : kinds) {
    Model m = crisp;
    make(m.trees[1]);
    const Bytes bytes = write_model(m);
    EXPECT_EQ(stated_schema(bytes), 2U) << name;
    const auto read = read_model(bytes);
    ASSERT_TRUE(std::holds_alternative<Model>(read)) << std::get<ReadError>(read).detail;
    EXPECT_EQ(std::get<Model>(read), m) << name;
  }
}

TEST(Wire, ATreeWithoutTheFieldsOfSchemaTwoIsCrispAndAffine) {
  Builder b;
  const std::vector<double> coefficients{1e-4, 2e-5}, bounds{-1e-4, 1e-4}, low{-1.0}, high{1.0};
  const auto tree = wire::CreateTree(b, 0, 0, b.CreateVector(coefficients), b.CreateVector(bounds));
  Extra extra;
  extra.schema = 1;
  extra.trees = b.CreateVector(std::vector<Offset<wire::Tree>>{tree});
  extra.domain = wire::CreateDomain(b, b.CreateVector(low), b.CreateVector(high));
  const auto read = read_model(file(b, extra));
  ASSERT_TRUE(std::holds_alternative<Model>(read)) << std::get<ReadError>(read).detail;
  const Tree expected{.depth = 0, .nodes = {}, .coefficients = coefficients, .bounds = bounds};
  EXPECT_EQ(std::get<Model>(read).trees[0], expected);
}

TEST(Wire, TreesThatShareTheirRegionAreRefusedInLittleMemory) {
  Builder b;
  Extra extra;
  const auto region = b.CreateVector(std::vector<float>(3'000'000, 0.5F));  // 12 MB
  const auto tree = wire::CreateTree(b, 0, 0, 0, 0, 0, 1, 0, region);
  extra.trees = b.CreateVector(std::vector<Offset<wire::Tree>>(2, tree));
  EXPECT_EQ(refusal(file(b, extra)).code, ReadErrorCode::kMalformed);
}

TEST(Wire, SchemaZeroIsRefused) {
  Builder b;
  EXPECT_EQ(refusal(file(b, {.schema = 0})).code, ReadErrorCode::kInconsistent);
}

TEST(Wire, AVerifiedFileWithoutSenseIsInconsistent) {
  Builder b;
  Extra extra;
  const auto effect = wire::CreateEffect(b, b.CreateString("Gear Ripple"));
  extra.effects = b.CreateVector(std::vector<Offset<wire::Effect>>{effect});
  EXPECT_EQ(refusal(file(b, extra)).code, ReadErrorCode::kInconsistent);
}

TEST(Wire, MoreTreesThanAxesAreRefused) {
  Builder b;
  Extra extra;
  extra.trees = b.CreateVector(std::vector<Offset<wire::Tree>>(kTreeAxes + 1, wire::CreateTree(b)));
  EXPECT_EQ(refusal(file(b, extra)).code, ReadErrorCode::kInconsistent);
}

TEST(Wire, AMillionNamesThatShareOneMegabyteAreRefusedInLittleMemory) {
  Builder b;
  Extra extra;
  const auto name = b.CreateString(std::string(1 << 20, 'x'));
  const auto names =
      b.CreateVector(std::vector<Offset<flatbuffers::String>>(1'000'000, name));  // a terabyte
  extra.provenance = wire::CreateProvenance(b, 0, 0, 0, 0, 0, 0, 0, names);
  EXPECT_EQ(refusal(file(b, extra)).code, ReadErrorCode::kMalformed);
}

TEST(Wire, EffectsThatShareTheirParametersAreRefusedInLittleMemory) {
  Builder b;
  Extra extra;
  const auto name = b.CreateString("reversal");
  const auto parameters = b.CreateVector(std::vector<double>(1'000'000, 0.5));
  const auto effect = wire::CreateEffect(b, name, 1, 0, parameters);
  extra.effects = b.CreateVector(std::vector<Offset<wire::Effect>>(4000, effect));  // 32 GB
  EXPECT_EQ(refusal(file(b, extra)).code, ReadErrorCode::kMalformed);
}

TEST(Wire, MisalignedNumbersAreRefused) {
  Builder b;
  const std::vector<std::uint32_t> words{4, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  b.ForceVectorAlignment(words.size(), sizeof(words[0]), alignof(double));
  const auto aligned = b.CreateVector(words);
  // The first word taken for a length: four doubles follow, 4 bytes off their alignment.
  const Offset<flatbuffers::Vector<double>> shifted(
      aligned.o - static_cast<flatbuffers::uoffset_t>(sizeof(words[0])));
  const auto error = refusal(file(b, {.domain = wire::CreateDomain(b, shifted, shifted)}));
  EXPECT_EQ(error.code, ReadErrorCode::kMalformed);
  EXPECT_NE(error.detail.find("misaligned"), std::string::npos);
}

}  // namespace
}  // namespace plumb::format
