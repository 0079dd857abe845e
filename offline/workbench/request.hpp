// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline::workbench {

/// What the server makes of a request before it decides anything: all that it looks at.
struct Request {
  std::string method;  // "GET"
  std::string target;  // as sent: "/api/cell?x=1"
  std::string host = {}, origin = {}, token = {}, if_match = {}, if_none_match = {};
  std::string body = {};
};

}  // namespace plumb::offline::workbench
