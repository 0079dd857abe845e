// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "program/folder_lock.hpp"
#include "rt/deployment.hpp"
#include "rt/install_history.hpp"
#include "rt/place.hpp"

namespace plumb::drivers::rt {

/// The folder versions/ of a place, held by one install or rollback at a time. Whoever holds it
/// finds nothing that a killed one has left half done.
class VersionStore {
 public:
  /// Waits five seconds for another one to end; then throws Failure (kEnvironment):
  /// E-RT-INSTALLING, E-RT-LOCK. Makes the place if `make` says so, and removes it again at the end
  /// if nothing was installed in it. Throws kInput, E-RT-PLACE if others may write there.
  enum class Make : std::uint8_t { kNo, kYes };
  VersionStore(const InstallPlace& place, Make make);
  ~VersionStore();
  VersionStore(const VersionStore&) = delete;
  VersionStore& operator=(const VersionStore&) = delete;

  /// A copy of all that the folder's SHA256SUMS, of text `sums`, lists, with the list and its
  /// signature, under a name that is no version yet. Removed by the next holder of the store unless
  /// it is added.
  std::filesystem::path copy(const std::filesystem::path& folder, const std::string& sums) const;

  /// Gives a verified copy its name, waits for the disk, and says whether there was no version of
  /// this name. One that is there is replaced if its content or its signature differs.
  enum class Added : std::uint8_t { kNew, kWasThere };
  Added add(const std::filesystem::path& copy, const std::string& id) const;

  /// Removes a version, in one step as far as others can see. False if that failed.
  bool remove(const std::string& id) const;

  /// Removes all but the newest `keep` versions, never one of `needed` and never one that a
  /// plumb-rt was started with. Returns what it removed.
  std::vector<std::string> keep_newest(int keep, const History& history,
                                       const std::vector<std::string>& needed) const;

 private:
  void remove_leftovers() const;
  std::filesystem::path aside() const;

  InstallPlace place_;
  bool made_ = false;           // the folder of the place
  bool made_versions_ = false;  // versions/ in it
  FolderLock lock_;
};

/// The version that a list of check sums stands for.
std::string version_of(const std::string& sums);

/// Reads a version as `run` would, and makes sure that nothing but the listed files is in it.
Deployment load_version(const std::filesystem::path& folder, const SigningRules& rules);

}  // namespace plumb::drivers::rt
