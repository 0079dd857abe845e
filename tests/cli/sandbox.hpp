// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// A run of the built program.
struct Ran {
  int exit = -1;
  std::string out;
  std::string err;
  nlohmann::ordered_json json() const;
};

/// A CSV file as text, column by column. Written apart from the program's own reader.
struct Csv {
  std::vector<std::string> header;
  std::map<std::string, std::vector<std::string>> columns;
  std::vector<double> numbers(const std::string& column) const;
  std::size_t rows() const;
  /// The file again, but for these columns.
  std::string without(const std::vector<std::string>& names) const;
};

/// A folder of its own, removed at the end; programs run inside it.
class Sandbox {
 public:
  Sandbox();
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// plumb with these words; -1 if a signal ended it.
  Ran plumb(const std::vector<std::string>& words) const;

  /// The same, with stdout going to `file` instead.
  Ran plumb_into(const std::string& file, const std::vector<std::string>& words) const;

  /// The same, with SIGINT after `ms` milliseconds.
  Ran plumb_interrupted(int ms, const std::vector<std::string>& words) const;

  /// The same on a terminal of so many columns, without colour and without stderr.
  Ran plumb_on_terminal(unsigned short columns, const std::vector<std::string>& words) const;

  std::string read(const std::string& file) const;
  void write(const std::string& file, const std::string& text) const;
  Csv csv(const std::string& file) const;

  /// Every file and folder inside, sorted.
  std::vector<std::string> listing() const;

 private:
  std::filesystem::path path_;
};

Csv parse_csv(const std::string& text);
