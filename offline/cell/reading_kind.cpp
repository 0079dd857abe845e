// SPDX-License-Identifier: Apache-2.0
#include "cell/reading_kind.hpp"

namespace plumb::offline {
namespace {

constexpr std::array kAll{
    ReadingDescriptor{
        ReadingKind::kPosition, nullptr, nullptr, {true, true, true}, false, "set-up"},
    ReadingDescriptor{ReadingKind::kPoint, "point", nullptr, {true, true, true}, false, "point"},
    ReadingDescriptor{ReadingKind::kPlane, "plane", nullptr, {false, false, true}, false, "plane"},
    ReadingDescriptor{
        ReadingKind::kHeight, "plane", "height", {false, false, true}, false, "plane"},
    ReadingDescriptor{
        ReadingKind::kSphere, "sphere", nullptr, {true, false, false}, true, "sphere"},
    ReadingDescriptor{
        ReadingKind::kDistance, "anchor", "distance", {true, false, false}, true, "anchor"},
};

}  // namespace

std::span<const ReadingDescriptor> artefact_readings() { return std::span(kAll).subspan(1); }

const ReadingDescriptor& descriptor_of(ReadingKind kind) {
  return kAll[static_cast<std::size_t>(kind)];
}

}  // namespace plumb::offline
