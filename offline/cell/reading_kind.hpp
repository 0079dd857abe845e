// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

namespace plumb::offline {

/// What one row of a measurement says of where the target was.
enum class ReadingKind : unsigned char {
  kPosition,  // an instrument measured x, y, z, or some of them, in its frame
  kPoint,     // the target is in a fixed point: a ball in a socket, a pin in a hole
  kPlane,     // it is on a plane: a probe's ball on a plate
  kHeight,    // so far above a plane: a dial gauge
  kSphere,    // on a sphere about a fixed centre: a ball bar
  kDistance,  // so far from a fixed anchor: a draw wire
};

/// Everything that a kind of reading is, but the mathematics of its lines. A file whose rows have
/// such a reading names in the column `label` which artefact each row is about, and has no measured
/// position.
///
/// In the frame of its artefact a reading is up to three coordinates. Points stand in the origin of
/// that frame, planes are its z = 0, and of spheres and distances x is how far the target is from
/// the origin, less a length that may be unknown (observe/reading.hpp).
struct ReadingDescriptor {
  ReadingKind kind;
  const char* label;          // column with the name of the artefact; null: positions
  const char* value;          // column with what was read there; null: nothing but the joints
  std::array<bool, 3> reads;  // which coordinates in that frame
  bool radial;                // how far from the origin of that frame, less a length
  const char* noun;           // of an artefact in a message, "plane"
};

/// Unknown numbers of an artefact, a length not counted: a point or a centre has three coordinates,
/// a plane a height and two tilts.
inline constexpr int kNumbersOfArtefact = 3;

/// All kinds with an artefact. Where an artefact is touched or read, the kind without a value
/// stands first.
std::span<const ReadingDescriptor> artefact_readings();

/// Of any kind. The axes of positions are those of Measurements::has_axis.
const ReadingDescriptor& descriptor_of(ReadingKind kind);

/// Whether it is about a plane: its frame is known but for turns about its normal and shifts in it.
inline bool is_of_plane(ReadingKind kind) {
  return kind == ReadingKind::kPlane || kind == ReadingKind::kHeight;
}

/// Whether the only thing read is that the target touches the artefact: what scatters then is where
/// the arm says that it is (touch_density.hpp).
inline bool is_touch(ReadingKind kind) {
  return kind != ReadingKind::kPosition && descriptor_of(kind).value == nullptr;
}

}  // namespace plumb::offline
