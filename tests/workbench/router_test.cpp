// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "no_services.hpp"
#include "workbench/job.hpp"
#include "workbench/names.hpp"
#include "workbench/router.hpp"
#include "workbench/target.hpp"

namespace plumb::offline::workbench {
namespace {

const Access kAccess{.port = 8040, .token = "0123456789abcdef0123456789abcdef"};

Request to(const std::string& method, const std::string& target, const std::string& body = "") {
  return {.method = method,
          .target = target,
          .host = "127.0.0.1:8040",
          .token = kAccess.token,
          .body = body};
}

int status_of(const Request& request) {
  NoServices services;
  return answer(request, kAccess, services).status;
}

TEST(Target, PathAndQueryAreDecodedOnce) {
  const auto target = parse_target("/api/files/tracker%20B%2525.csv?a=1+2&b=%C3%A9&c");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, (std::vector<std::string>{"api", "files", "tracker B%25.csv"}));
  EXPECT_EQ(target->query.at("a"), "1 2");
  EXPECT_EQ(target->query.at("b"), "\u00e9");
  EXPECT_EQ(target->query.at("c"), "");
}

TEST(Target, WhatLeadsElsewhereIsNoPath) {
  for (const char* text :
       {"", "x", "//", "/a//b", "/..", "/a/../b", "/%2e%2e/x", "/a%2fb", "/a%5cb", "/%00", "/%0a",
        "/%zz", "/%2", "/%ff", "/a/", "/a#b", "/?a=1&a=2", "/?=1", "/a/b/c/d/e/f/g/h/i"})
    EXPECT_FALSE(parse_target(text)) << text;
  EXPECT_FALSE(parse_target("/" + std::string(kLongestTarget, 'a')));
  EXPECT_TRUE(parse_target("/"));
}

TEST(Access, OnlyThisServersOwnPageMayAsk) {
  for (const char* host : {"127.0.0.1:8040", "localhost:8040", "LOCALHOST:8040"}) {
    Request request = to("GET", "/api/cell");
    request.host = host;
    EXPECT_EQ(status_of(request), 200) << host;
  }
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:80", "evil.example:8040", "[::1]:8040",
                           "127.0.0.1:8040,evil.example", "127.0.0.1:8040.evil.example"}) {
    Request request = to("GET", "/api/cell");
    request.host = host;
    EXPECT_EQ(status_of(request), 403) << host;
  }
  for (const char* origin : {"null", "https://127.0.0.1:8040", "http://evil.example",
                             "http://127.0.0.1:80", "http://127.0.0.1:8040.evil.example"}) {
    Request request = to("GET", "/api/cell");
    request.origin = origin;
    EXPECT_EQ(status_of(request), 403) << origin;
  }
}

TEST(Access, WhatWritesNeedsTheToken) {
  for (const auto& [method, target] :
       std::vector<std::pair<std::string, std::string>>{{"PUT", "/api/cell"},
                                                        {"PUT", "/api/files/a.csv"},
                                                        {"POST", "/api/jobs"},
                                                        {"DELETE", "/api/jobs/1"},
                                                        {"POST", "/api/monitor"}})
    for (const std::string& token : {std::string(), std::string("0"), std::string(32, '0'),
                                     kAccess.token + "0", kAccess.token.substr(1)}) {
      Request request = to(method, target, "{}");
      request.token = token;
      NoServices services;
      EXPECT_EQ(answer(request, kAccess, services).status, 403) << method << target;
      EXPECT_TRUE(services.asked.empty());
    }
  Request socket = to("GET", "/api/ws?token=" + kAccess.token);
  EXPECT_FALSE(socket_refusal(socket, kAccess));
  for (const char* target : {"/api/ws", "/api/ws?token=", "/api/ws?token=0", "/api/cell"}) {
    socket.target = target;
    EXPECT_TRUE(socket_refusal(socket, kAccess)) << target;
  }
}

TEST(Router, NamesAndNumbersAreChecked) {
  for (const char* target : {"/api/runs/0", "/api/runs/-1", "/api/runs/1x", "/api/runs/99999999999",
                             "/api/runs/1/frames", "/api/runs/1/frames?row=-1", "/fig/order",
                             "/fig/order.svg?width=3", "/fig/x.svg?run=0", "/api/files/.ssh",
                             "/api/files/-o", "/api/monitor?folder=..", "/api/monitor?folder=a/b"})
    EXPECT_EQ(status_of(to("GET", target)), 400) << target;
  for (const char* target : {"/api", "/api/x", "/x.js", "/api/runs/1/x"})
    EXPECT_EQ(status_of(to("GET", target)), 404) << target;
  EXPECT_EQ(status_of(to("POST", "/api/cell", "{}")), 405);
  EXPECT_EQ(status_of(to("PATCH", "/api/cell")), 405);
  for (const char* body : {"", "[]", "{", "{\"verb\": 1}", "{\"verb\": \"fit\", \"args\": [1]}"})
    EXPECT_EQ(status_of(to("POST", "/api/jobs", body)), 400) << body;
  EXPECT_EQ(status_of(to("PUT", "/api/files/a.csv", std::string(kMostUpload + 1, 'x'))), 413);
  EXPECT_EQ(status_of(to("POST", "/api/jobs", std::string(kMostJsonBytes + 1, 'x'))), 413);
}

TEST(Router, NoAnswerLetsAnotherOriginRead) {
  NoServices services;
  for (const char* target : {"/", "/api/cell", "/fig/order.svg", "/nowhere"}) {
    const Response response = answer(to("GET", target), kAccess, services);
    bool policy = false;
    for (const auto& [name, value] : headers_of(response)) {
      EXPECT_FALSE(name.starts_with("Access-Control")) << target;
      policy =
          policy || (name == "Content-Security-Policy" && value.starts_with("default-src 'none'"));
    }
    EXPECT_TRUE(policy) << target;
  }
  Request again = to("GET", "/");
  again.if_none_match = "\"abc\"";
  EXPECT_EQ(status_of(again), 304);
}

// A browser puts the headers of a 304 in the place of those that it kept with the page.
TEST(Router, WhatIsUnchangedIsSaidWithTheHeadersOfTheWhole) {
  NoServices services;
  for (const char* target : {"/", "/fig/order.svg"}) {
    Request request = to("GET", target);
    const Response whole = answer(request, kAccess, services);
    request.if_none_match = '"' + whole.etag + '"';
    const Response unchanged = answer(request, kAccess, services);
    EXPECT_EQ(unchanged.status, 304) << target;
    EXPECT_TRUE(unchanged.body->empty()) << target;
    EXPECT_EQ(headers_of(unchanged), headers_of(whole)) << target;
  }
}

TEST(Job, OnlyVerbsOfACellOnFilesOfItsFolder) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("plumb-job-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::filesystem::create_symlink("/etc", folder / "out");
  const auto refused = [&](const std::string& verb, const std::vector<std::string>& args) {
    try {
      check_job({verb, args}, folder);
      return false;
    } catch (const Failure&) {
      return true;
    }
  };
  for (const char* verb : {"", "serve", "demo", "new", "-C", "fit; ls"})
    EXPECT_TRUE(refused(verb, {})) << verb;
  for (const char* word :
       {"-C", "-C/etc", "/etc/passwd", "../x", "a/../../x", "-o/etc/x", "-o../x", "--output=/etc/x",
        "file:/etc/passwd", "a=../b", "out/passwd", "a,/b", "a\nb\x01"})
    EXPECT_TRUE(refused("fit", {word})) << word;
  EXPECT_TRUE(refused("fit", std::vector<std::string>(65, "x")));
  EXPECT_FALSE(refused("fit", {"--seed", "3", "--held-out", "file:verify.csv"}));
  EXPECT_FALSE(refused("add", {"formula", "--formula", "dq2 = k*tau2/(1 + x)", "--parameter",
                               "k [rad/(N m)] ~ 1e-6"}));
  EXPECT_FALSE(refused("compile", {"-o", "robot.plumb", "--force"}));
  const auto words = job_process({"fit", {"--seed", "3"}}, folder).words;
  EXPECT_EQ(words.back(), "--json");
  EXPECT_EQ(words[1], "-C");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace plumb::offline::workbench
