// SPDX-License-Identifier: Apache-2.0
#include "workbench/router.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "draw/sheet.hpp"
#include "program/guarded.hpp"
#include "workbench/names.hpp"
#include "workbench/target.hpp"

namespace plumb::offline::workbench {
namespace {

constexpr int kMostNumber = 1'000'000'000;

[[noreturn]] void malformed(std::string message, std::string help) {
  throw Failure(
      Exit::kUsage,
      {.code = "E-SERVE-REQUEST", .message = std::move(message), .help = std::move(help)});
}

/// A request on its way: the parts of its path that stand at "*" in the table below.
struct Call {
  const Request& request;
  const Target& target;
  Services& services;
  std::vector<std::string> names = {};
};

template <class Number>
std::optional<Number> whole(const std::string& text) {
  Number out{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return out;
}

int number(const std::string& text, const char* what, int low, int high) {
  const auto out = whole<int>(text);
  if (out && *out >= low && *out <= high) return *out;
  malformed(fmt::format("{} must be a whole number from {} to {}", what, low, high),
            "docs/workbench.md lists the parameters");
}

std::optional<std::string> asked(const Call& call, const char* name) {
  const auto found = call.target.query.find(name);
  if (found == call.target.query.end()) return std::nullopt;
  return found->second;
}

int run_of_path(const Call& call) { return number(call.names[0], "the run", 1, kMostNumber); }

/// 0 without ?run=.
int run_of_query(const Call& call) {
  const auto text = asked(call, "run");
  return text ? number(*text, "run", 1, kMostNumber) : 0;
}

const std::string& plain(const std::string& name) {
  if (is_plain_name(name)) return name;
  malformed("the name of a file must be one plain word of its own, without a folder",
            "for example: tracker.csv");
}

Json body_of(const Call& call) {
  Json out = Json::parse(call.request.body, nullptr, false);
  if (out.is_object()) return out;
  malformed("the body must be one JSON object", "docs/workbench.md shows each");
}

std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found != object.end() && found->is_string()) return found->get<std::string>();
  malformed(fmt::format("the body needs a text \"{}\"", key), "docs/workbench.md shows each");
}

Response page(const Call& call) {
  const auto& path = call.target.path;
  auto out = call.services.page(path.empty() ? "index.html" : path.front());
  if (!out)
    return error_response(404, {.code = "E-SERVE-PATH",
                                .message = "this plumb was built without its page",
                                .help = "build it with node and npm installed: docs/workbench.md"});
  // Its headers replace those that the browser kept with the page, the policy too.
  if (!out->etag.empty() && call.request.if_none_match == '"' + out->etag + '"') {
    out->status = 304;
    out->body = bytes("");
  }
  return *out;
}

Response figure(const Call& call) {
  const std::string& file = call.names[0];
  constexpr std::string_view kEnd = ".svg";
  if (!file.ends_with(kEnd)) malformed("a figure is NAME.svg", "GET /api/figures lists them");
  const auto text = asked(call, "width");
  const int width = text ? number(*text, "width", static_cast<int>(draw::kNarrowest),
                                  static_cast<int>(draw::kWidest))
                         : static_cast<int>(draw::kUsualWidth);
  const int run = run_of_query(call);
  const std::string state = std::to_string(call.services.state());
  Response out{.type = "image/svg+xml",
               .body = bytes(""),
               .etag = state,
               .content = Response::Content::kPicture};
  if (call.request.if_none_match == '"' + state + '"') {
    out.status = 304;
    return out;
  }
  out.body = call.services.figure(file.substr(0, file.size() - kEnd.size()), run, width);
  return out;
}

Response frames(const Call& call) {
  const auto row = asked(call, "row");
  if (!row) malformed("which row?", "frames?row=0");
  return json_response(
      call.services.frames(run_of_path(call), number(*row, "row", 0, kMostNumber)));
}

Response put_file(const Call& call) {
  const std::string& name = plain(call.names[0]);
  const auto force = asked(call, "force");
  return json_response(call.services.put_file(
      name, call.request.body, force == "1" ? Services::Replace::kYes : Services::Replace::kNo));
}

Response put_cell(const Call& call) {
  std::string tag = call.request.if_match;
  if (tag.size() >= 2 && tag.front() == '"' && tag.back() == '"')
    tag = tag.substr(1, tag.size() - 2);
  const auto state = whole<std::int64_t>(tag);
  if (!state)
    malformed("the header If-Match must name the state that was edited",
              "GET /api/cell says it as \"state\"");
  return json_response(call.services.put_cell(text_of(body_of(call), "toml"), *state));
}

Response start_job(const Call& call) {
  const Json body = body_of(call);
  JobRequest job{.verb = text_of(body, "verb"), .args = {}};
  if (body.contains("args")) {
    if (!body["args"].is_array())
      malformed("\"args\" must be a list of texts", "[\"--n\", \"30\"]");
    for (const auto& arg : body["args"]) {
      if (!arg.is_string()) malformed("\"args\" must be a list of texts", "[\"--n\", \"30\"]");
      job.args.push_back(arg.get<std::string>());
    }
  }
  return json_response(call.services.start_job(job));
}

int job_of(const Call& call) { return number(call.names[0], "the job", 1, kMostNumber); }

Response monitor(const Call& call) {
  const auto folder = asked(call, "folder");
  return json_response(call.services.monitor(folder ? plain(*folder) : ""));
}

Response drive(const Call& call) {
  const Json body = body_of(call);
  const std::string action = text_of(body, "action"), folder = plain(text_of(body, "folder"));
  if (action != "start" && action != "stop")
    malformed("\"action\" must be start or stop",
              "{\"action\": \"start\", \"folder\": \"deploy\"}");
  return json_response(call.services.drive(
      folder, action == "start" ? Services::Drive::kStart : Services::Drive::kStop));
}

struct Route {
  const char* method;
  std::vector<std::string> path;  // "*": any name
  Response (*answer)(const Call&);
};

const std::vector<Route>& routes() {
  static const std::vector<Route> all{
      {"GET", {}, page},
      {"GET", {"index.html"}, page},
      {"GET", {"app.js"}, page},
      {"GET", {"app.css"}, page},
      {"GET", {"api", "cell"}, [](const Call& c) { return json_response(c.services.cell()); }},
      {"PUT", {"api", "cell"}, put_cell},
      {"GET", {"api", "runs"}, [](const Call& c) { return json_response(c.services.runs()); }},
      {"GET",
       {"api", "runs", "*"},
       [](const Call& c) { return json_response(c.services.run(run_of_path(c))); }},
      {"GET",
       {"api", "runs", "*", "poses"},
       [](const Call& c) { return json_response(c.services.poses(run_of_path(c))); }},
      {"GET", {"api", "runs", "*", "frames"}, frames},
      {"GET",
       {"api", "figures"},
       [](const Call& c) { return json_response(c.services.figures(run_of_query(c))); }},
      {"GET", {"fig", "*"}, figure},
      {"GET", {"api", "files"}, [](const Call& c) { return json_response(c.services.files()); }},
      {"GET",
       {"api", "files", "*"},
       [](const Call& c) { return c.services.file(plain(c.names[0])); }},
      {"PUT", {"api", "files", "*"}, put_file},
      {"GET", {"api", "jobs"}, [](const Call& c) { return json_response(c.services.jobs()); }},
      {"POST", {"api", "jobs"}, start_job},
      {"GET",
       {"api", "jobs", "*"},
       [](const Call& c) { return json_response(c.services.job(job_of(c))); }},
      {"DELETE",
       {"api", "jobs", "*"},
       [](const Call& c) { return json_response(c.services.stop_job(job_of(c))); }},
      {"GET", {"api", "monitor"}, monitor},
      {"POST", {"api", "monitor"}, drive}};
  return all;
}

/// The parts at "*" if the path is that of the route.
std::optional<std::vector<std::string>> match(const Route& route,
                                              const std::vector<std::string>& path) {
  if (route.path.size() != path.size()) return std::nullopt;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (route.path[i] == "*")
      names.push_back(path[i]);
    else if (route.path[i] != path[i])
      return std::nullopt;
  }
  return names;
}

Response dispatch(const Request& request, const Target& target, Services& services) {
  bool known = false;
  for (const Route& route : routes()) {
    auto names = match(route, target.path);
    if (!names) continue;
    known = true;
    if (request.method == route.method)
      return route.answer({request, target, services, std::move(*names)});
  }
  if (known)
    return error_response(405, {.code = "E-SERVE-METHOD",
                                .message = "this path does not take that method",
                                .help = "docs/workbench.md lists what the server answers"});
  return error_response(404, {.code = "E-SERVE-PATH",
                              .message = "there is nothing at this path",
                              .help = "docs/workbench.md lists what the server answers"});
}

}  // namespace

Response answer(const Request& request, const Access& access, Services& services) {
  if (auto refused = refusal(request, access)) return *refused;
  if (request.body.size() > most_body(request))
    return error_response(413, {.code = "E-SERVE-SIZE",
                                .message = "the body of the request is too large",
                                .help = "a measurement file may have 16 MB"});
  Outcome outcome;
  Response out;
  guarded(
      "plumb",
      [&] {
        const auto target = parse_target(request.target);
        if (!target)
          malformed("the path of the request cannot be read", "docs/workbench.md lists the paths");
        out = dispatch(request, *target, services);
      },
      outcome);
  return outcome.errors.empty() ? out : failure_response(outcome);
}

}  // namespace plumb::offline::workbench
