// SPDX-License-Identifier: Apache-2.0
#include "workbench/response.hpp"

#include <map>

namespace plumb::offline::workbench {
namespace {

const char* policy_of(Response::Content content) {
  switch (content) {
    case Response::Content::kPage:
      return "default-src 'none'; script-src 'self'; style-src 'self'; "
             "img-src 'self' data: blob:; connect-src 'self'; frame-src 'self'; "
             "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
    case Response::Content::kPicture:
      return "default-src 'none'; style-src 'unsafe-inline'; sandbox";
    case Response::Content::kReport:
      return "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
             "img-src data:; sandbox allow-scripts";
    default:
      return "default-src 'none'; frame-ancestors 'none'";
  }
}

int status_of(const std::string& code, Exit exit) {
  static const std::map<std::string, int> kOfCode{
      {"E-RUN-MISSING", 404},   {"E-PLOT-NAME", 404},   {"E-PLOT-RUN", 404},
      {"E-RUN-DATA", 409},      {"E-EXISTS", 409},      {"E-SERVE-STATE", 409},
      {"E-SERVE-MISSING", 404}, {"E-SERVE-QUEUE", 429}, {"E-CELL-BUSY", 409}};
  if (const auto found = kOfCode.find(code); found != kOfCode.end()) return found->second;
  switch (exit) {
    case Exit::kUsage:
      return 400;
    case Exit::kInput:
    case Exit::kNumbersSayNo:
    case Exit::kGateFailed:
      return 422;
    default:
      return 500;
  }
}

}  // namespace

Bytes bytes(std::string text) { return std::make_shared<const std::string>(std::move(text)); }

std::vector<std::pair<std::string, std::string>> headers_of(const Response& response) {
  std::vector<std::pair<std::string, std::string>> out{
      {"Content-Type", response.type},
      {"Content-Security-Policy", policy_of(response.content)},
      {"Cache-Control", response.etag.empty() ? "no-store" : "no-cache"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Referrer-Policy", "no-referrer"},
      {"X-Content-Type-Options", "nosniff"}};
  if (!response.etag.empty()) out.emplace_back("ETag", '"' + response.etag + '"');
  if (response.encoding == Response::Encoding::kGzip) out.emplace_back("Content-Encoding", "gzip");
  return out;
}

std::string json_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Response json_response(Bytes json) { return {.body = std::move(json)}; }

Response json_response(std::string json) { return {.body = bytes(std::move(json))}; }

Response json_response(const Json& json) { return json_response(json_line(json)); }

Response error_response(int status, const Problem& problem) {
  Json error = problem_json(problem);
  error.erase("severity");
  Response out = json_response(Json{{"error", error}});
  out.status = status;
  return out;
}

Response failure_response(const Outcome& failed) {
  const Problem& problem = failed.errors.front();
  return error_response(status_of(problem.code, failed.exit), problem);
}

}  // namespace plumb::offline::workbench
