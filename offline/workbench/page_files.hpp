// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "workbench/response.hpp"

namespace plumb::offline::workbench {

/// One of the page's own files, "index.html", "app.js" or "app.css", from inside the program, where
/// it is compressed. With PLUMB_PAGE=DIR in the environment the file of that folder instead, for
/// those who change the page. Nothing if the program was built without the page.
std::optional<Response> page_file(const std::string& name);

}  // namespace plumb::offline::workbench
