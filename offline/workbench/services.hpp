// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "workbench/response.hpp"

namespace plumb::offline::workbench {

/// One action of the page: what would be typed behind `plumb`.
struct JobRequest {
  std::string verb;
  std::vector<std::string> args;
};

/// What the router calls once it has read and checked a request. Every function may throw Failure,
/// is called from several threads, and gets names only that passed `is_plain_name`.
class Services {
 public:
  virtual ~Services() = default;

  /// Our own page: "index.html", "app.js", "app.css".
  virtual std::optional<Response> page(const std::string& name) = 0;

  virtual std::int64_t state() = 0;

  // Texts are JSON. run 0: that of the present cell and data.
  virtual Bytes cell() = 0;
  virtual Bytes runs() = 0;
  virtual Bytes run(int number) = 0;
  virtual Bytes poses(int run) = 0;
  virtual Bytes frames(int run, int row) = 0;
  virtual Bytes figures(int run) = 0;
  virtual Bytes figure(const std::string& name, int run, int width) = 0;

  virtual std::string files() = 0;
  virtual Response file(const std::string& name) = 0;
  enum class Replace { kNo, kYes };
  virtual std::string put_file(const std::string& name, const std::string& content,
                               Replace replace) = 0;
  virtual std::string put_cell(const std::string& toml, std::int64_t if_state) = 0;

  virtual std::string jobs() = 0;
  virtual std::string job(int number) = 0;
  virtual std::string start_job(const JobRequest& job) = 0;
  virtual std::string stop_job(int number) = 0;

  virtual std::string monitor(const std::string& folder) = 0;
  enum class Drive { kStart, kStop };
  virtual std::string drive(const std::string& folder, Drive what) = 0;
};

}  // namespace plumb::offline::workbench
