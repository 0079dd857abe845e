// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace plumb::offline::workbench {

struct ServeSettings {
  std::filesystem::path cell_toml;  // it need not be readable
  int port = 0;                     // 0: any that is free
};

/// Serves the workbench of one cell on 127.0.0.1 until SIGINT or SIGTERM. `ready`: called once with
/// the address to open. Throws Failure (kEnvironment): E-SERVE-PORT; E-SERVE-OFF if this program
/// was built without it.
void serve(const ServeSettings& settings, const std::function<void(const std::string& url)>& ready);

/// Opens an address in the browser of the desktop; false if there is none.
bool open_in_browser(const std::string& url);

}  // namespace plumb::offline::workbench
