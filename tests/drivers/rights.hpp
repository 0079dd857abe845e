// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grp.h>
#include <sys/resource.h>
#include <unistd.h>

namespace plumb::tests {

/// For children of a test, which end where something cannot be given up.

inline void set_limit(auto resource, rlim_t value) {
  const rlimit limit{value, value};
  if (::setrlimit(resource, &limit) != 0) ::_exit(200);
}

/// From now on an ordinary user.
inline void become_nobody() {
  constexpr int kNobody = 65534;
  if (::geteuid() != 0) return;
  if (::setgroups(0, nullptr) != 0 || ::setgid(kNobody) != 0 || ::setuid(kNobody) != 0)
    ::_exit(201);
}

/// From now on a user to whom nothing real-time is granted.
inline void drop_rights() {
  set_limit(RLIMIT_RTPRIO, 0);
  set_limit(RLIMIT_MEMLOCK, 0);
  become_nobody();
}

}  // namespace plumb::tests
