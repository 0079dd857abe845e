// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb {

/// The number of this process, for names of files that no other process may use at the same time.
int own_process_number();

/// Whether a process of that number (positive) exists, whoever it belongs to.
bool process_exists(int number);

}  // namespace plumb
