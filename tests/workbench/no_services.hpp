// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "workbench/services.hpp"

namespace plumb::offline::workbench {

/// Services that do nothing but remember what they were asked, and which names came through.
class NoServices final : public Services {
 public:
  std::vector<std::string> asked, names;

  std::optional<Response> page(const std::string& name) override {
    names.push_back(name);
    return Response{.type = "text/html",
                    .body = bytes("page"),
                    .etag = "abc",
                    .content = Response::Content::kPage};
  }
  std::int64_t state() override { return 17; }
  Bytes cell() override { return said("cell"); }
  Bytes runs() override { return said("runs"); }
  Bytes run(int) override { return said("run"); }
  Bytes poses(int) override { return said("poses"); }
  Bytes frames(int, int) override { return said("frames"); }
  Bytes figures(int) override { return said("figures"); }
  Bytes figure(const std::string&, int, int) override { return said("figure"); }
  std::string files() override { return *said("files"); }
  Response file(const std::string& name) override {
    names.push_back(name);
    return {.body = said("file")};
  }
  std::string put_file(const std::string& name, const std::string&, Replace replace) override {
    names.push_back(name);
    return *said(replace == Replace::kYes ? "write over file" : "write file");
  }
  std::string put_cell(const std::string&, std::int64_t) override { return *said("write cell"); }
  std::string jobs() override { return *said("jobs"); }
  std::string job(int) override { return *said("job"); }
  std::string start_job(const JobRequest&) override { return *said("write job"); }
  std::string stop_job(int) override { return *said("write stop"); }
  std::string monitor(const std::string& folder) override {
    if (!folder.empty()) names.push_back(folder);
    return *said("monitor");
  }
  std::string drive(const std::string& folder, Drive) override {
    names.push_back(folder);
    return *said("write drive");
  }

 private:
  Bytes said(const char* what) {
    asked.emplace_back(what);
    return bytes("{}");
  }
};

}  // namespace plumb::offline::workbench
