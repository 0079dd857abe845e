// SPDX-License-Identifier: Apache-2.0
#include "rt/install_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "program/file.hpp"
#include "program/shell_word.hpp"
#include "rt/utc.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

/// A folder made later than this from now was made by a clock that was wrong. A day: no time zone
/// that was taken for UTC is off by more.
constexpr std::int64_t kClockSlack_s = 86'400;

/// Words on a clock that was wrong, if these times look like it.
std::string clock_hint(const std::string& made, const std::string& newest) {
  const std::int64_t now_s = utc_ns() / 1'000'000'000;
  const std::string tomorrow = utc_second(now_s + kClockSlack_s);
  if (newest > tomorrow)
    return fmt::format(
        "; this machine's clock says {}, so a clock was wrong when {} was made, or "
        "is wrong here",
        utc_second(now_s), newest);
  if (made < "2020")
    return "; the clock of the machine that made it was wrong, or is older than this program";
  return "";
}

}  // namespace

void refuse_older(const InstallRequest& request, const std::string& made, const std::string& id,
                  const PlaceBefore& before) {
  const std::string& newest = before.history.newest_made;
  if (request.older == InstallRequest::Older::kAllowed || id == before.current || made >= newest)
    return;
  const InstallPlace& place = request.change.place;
  const auto ids = place.ids();
  const bool there = std::find(ids.begin(), ids.end(), id) != ids.end();
  const std::string when =
      made.empty() ? "does not say when it was made, which counts as older than all that do"
                   : fmt::format("was made {}", made);
  throw Failure(
      Exit::kInput,
      {.code = "E-RT-OLDER",
       .message = fmt::format("{} {}, and one made {} was installed in {} before{}",
                              display_name(request.from), when, newest, display_name(place.folder),
                              made.empty() ? "" : clock_hint(made, newest)),
       .help =
           there ? fmt::format(
                       "to go back on purpose: plumb-rt rollback {} --version {}",
                       "--to " + shell_word(fs::absolute(place.folder).lexically_normal().string()),
                       id)
                 : "if an older one is meant: add --older"});
}

void refuse_other_robot(const InstallRequest& request, const Deployment& next,
                        const PlaceBefore& before) {
  const InstallPlace& place = request.change.place;
  if (before.current.empty()) return;
  std::string serial;
  try {
    serial = load_deployment(place.version(before.current)).model.loaded->model().serial;
  } catch (const Failure&) {
    return;  // the install mends what is there
  }
  const std::string& own = next.model.loaded->model().serial;
  if (own == serial) return;
  throw Failure(
      Exit::kInput,
      {.code = "E-RT-SERIAL",
       .message = fmt::format("{} was made for robot '{}', and {} is that of robot '{}'",
                              display_name(request.from), own, display_name(place.folder), serial),
       .help = "a place for each robot: --to ANOTHER"});
}

void warn_of_clock(const InstallRequest& request, const std::string& made, Outcome& outcome) {
  const std::int64_t now_s = utc_ns() / 1'000'000'000;
  if (made <= utc_second(now_s + kClockSlack_s)) return;
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-RT-CLOCK",
       .message = fmt::format("{} was made {}, and this machine's clock says {}: one of the two "
                              "clocks is wrong, and what is made until then counts as older",
                              display_name(request.from), made, utc_second(now_s)),
       .help = "timedatectl, on both machines"});
}

}  // namespace plumb::drivers::rt
