// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "program/scratch_folder.hpp"
#include "rt/place.hpp"
#include "rt/version_store.hpp"
#include "tests/drivers/deployed.hpp"

namespace plumb::tests {

/// A place, on a machine that demands no signatures.
class Placed {
 public:
  static std::string id_of(const Deployed& folder) {
    return drivers::rt::version_of(folder.text(Deployed::kSums));
  }

  /// Adds a version without making it current.
  std::string add(const Deployed& folder) const {
    const drivers::rt::VersionStore store(place, drivers::rt::VersionStore::Make::kYes);
    store.add(store.copy(folder.folder, folder.text(Deployed::kSums)), id_of(folder));
    return id_of(folder);
  }
  void make_current(const std::string& id) const {
    drivers::rt::CurrentLink::prepare(place, id).commit();
  }
  std::string current() const { return drivers::rt::current_version_if_any(place); }

 private:
  const ScratchFolder scratch_{"plumb-placed-"};

 public:
  const drivers::rt::InstallPlace place{scratch_.path() / "place"};
  const std::string etc = (scratch_.path() / "etc").string();  // which is not there
};

/// A model that corrects otherwise by so much.
inline format::Model arm_shifted(double shift_m) {
  format::Model out = Deployed::arm();
  for (auto& joint : out.calibrated.joints) joint.a -= shift_m;
  return out;
}

inline std::string made_at(const std::string& made) {
  return Deployed::csv("[model]\nmade = \"" + made + "\"\n");
}

}  // namespace plumb::tests
