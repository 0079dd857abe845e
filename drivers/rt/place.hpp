// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plumb::drivers::rt {

/// Where the places of a machine are: /var/lib/plumb/NAME.
inline constexpr char kStore[] = "/var/lib/plumb";

/// A place: the folder in which deploy folders are installed for one plumb-rt.
///
///   versions/ID/     a copy of a deploy folder that is never changed again; ID: the first 16
///                    hexadecimal digits of the SHA-256 of its SHA256SUMS
///   current          a symbolic link to versions/ID: what the next start runs
///   installs.jsonl   what was installed and rolled back, when and by whom
///
/// What plumb-rt writes while it runs a place, such as its journal, belongs to the place itself.
struct InstallPlace {
  std::filesystem::path folder;

  std::filesystem::path versions() const { return folder / "versions"; }
  std::filesystem::path version(const std::string& id) const { return versions() / id; }
  std::filesystem::path link() const { return folder / "current"; }
  std::filesystem::path history() const { return folder / "installs.jsonl"; }

  /// The versions that stand there, sorted by name.
  std::vector<std::string> ids() const;
};

/// True if --to takes it as the name of a place below the store.
bool is_place_name(const std::string& name);

bool is_version_id(const std::string& text);

/// True if the folder has a `current`, or a folder `versions` and no rt.toml of its own.
bool is_place(const std::filesystem::path& folder);

/// The version that `current` names; nothing if there is no `current`. Throws Failure (kInput,
/// E-RT-PLACE) if it is no link to a version that is there.
std::optional<std::string> current_version(const InstallPlace& place);

/// The same in one system call, for looking again and again: empty instead of any failure.
std::string current_version_if_any(const InstallPlace& place) noexcept;

/// Lets `current` point to this version, in one step: a reader finds the old one or the new one.
/// Waits until the disk has it. `prepare` makes the link under another name, so that a full disk is
/// noticed before anything has changed; `commit` renames it. Both throw Failure (kEnvironment,
/// E-WRITE).
class CurrentLink {
 public:
  static CurrentLink prepare(const InstallPlace& place, const std::string& id);
  ~CurrentLink();  // removes a link that was not committed
  CurrentLink(CurrentLink&& other) noexcept;
  CurrentLink& operator=(CurrentLink&&) = delete;
  void commit();

 private:
  CurrentLink() = default;
  std::filesystem::path draft_, link_;
};

/// Throws Failure (kInput, E-RT-PLACE) if others than the owner may write to the place or to its
/// versions: they could let `current` point to another version.
void refuse_open_place(const InstallPlace& place);

/// The content that a folder stands for: of a place the version that is `current`, resolved once;
/// else the folder itself, with an empty version.
struct Content {
  std::filesystem::path folder;
  std::string version;
};

/// Throws Failure (kInput, E-RT-PLACE) of a place that is not sound, or has nothing installed.
Content find_content(const std::filesystem::path& folder);

/// Their names, sorted.
std::vector<std::string> places_below(const std::filesystem::path& store);

/// The place that --to names: a folder if it contains '/', else a name below `store`; if it is
/// empty the only place there. Throws Failure (kUsage, E-RT-PLACE).
InstallPlace find_place(const std::string& to, const std::filesystem::path& store);

}  // namespace plumb::drivers::rt
