// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "program/outcome.hpp"
#include "program/problem.hpp"

namespace plumb::offline::workbench {

using Bytes = std::shared_ptr<const std::string>;
Bytes bytes(std::string text);

/// JSON in one line; what is no UTF-8 is replaced.
std::string json_line(const Json& json);

struct Response {
  int status = 200;
  std::string type = "application/json";
  Bytes body;
  std::string etag = {};  // without quotes; empty: none
  enum class Encoding { kPlain, kGzip } encoding = Encoding::kPlain;
  /// What a browser may do with the content: nothing at all with data; run our own scripts in the
  /// page; show a picture; run what a report holds, apart from this server and from its token.
  enum class Content { kData, kPage, kPicture, kReport } content = Content::kData;
};

/// The headers that follow from the response, but for the length: type, content security policy,
/// caching. None of them allows another origin to read anything.
std::vector<std::pair<std::string, std::string>> headers_of(const Response& response);

Response json_response(Bytes json);
Response json_response(std::string json);
Response json_response(const Json& json);

/// {"error": {code, message, place, help}}
Response error_response(int status, const Problem& problem);

/// The same for what a function threw; the status follows from code and exit code.
Response failure_response(const Outcome& failed);

}  // namespace plumb::offline::workbench
