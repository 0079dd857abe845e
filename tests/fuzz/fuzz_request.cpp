// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "program/json.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/workbench/no_services.hpp"
#include "workbench/router.hpp"

using namespace plumb::offline::workbench;
using plumb::tests::require;

namespace {

/// Up to the next line end.
std::string line(std::string_view& rest) {
  const auto at = rest.find('\n');
  std::string out(rest.substr(0, at));
  rest.remove_prefix(at == std::string_view::npos ? rest.size() : at + 1);
  return out;
}

}  // namespace

/// Lines: method, target, host, origin, token, If-Match; what follows is the body. "=" in the place
/// of host or token stands for the right one.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  const Access access{.port = 8040, .token = "0123456789abcdef0123456789abcdef"};
  Request request;
  for (std::string* part : std::array{&request.method, &request.target, &request.host,
                                      &request.origin, &request.token, &request.if_match})
    *part = line(rest);
  request.body = std::string(rest);
  if (request.host == "=") request.host = "127.0.0.1:8040";
  if (request.token == "=") request.token = access.token;
  NoServices services;
  const Response response = answer(request, access, services);
  require(response.status >= 200 && response.status < 600, "every request has an answer");
  require(response.body != nullptr, "every answer has a body");
  require(response.status < 400 || plumb::Json::accept(*response.body), "an error is JSON");
  for (const auto& name : services.names)
    require(name.find('/') == std::string::npos && name.find("..") != 0 && !name.empty(),
            "no name leads to another folder");
  for (const auto& what : services.asked)
    require(!what.starts_with("write") || request.token == access.token,
            "nothing is written without the token");
  require(services.asked.empty() || request.host == "127.0.0.1:8040" ||
              request.host.size() == std::string_view("localhost:8040").size(),
          "nothing is said to another host");
  return 0;
}
