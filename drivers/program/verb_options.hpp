// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

// The library that reads the command line costs every file that includes it several seconds of
// compiling; only verb_options.cpp and program.cpp do.
namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace plumb {

/// A condition on a word of the command line. A word that breaks it is a usage error.
class WordRule {
 public:
  explicit WordRule(CLI::Validator rule);
  ~WordRule();
  WordRule(WordRule&&) noexcept;

  const CLI::Validator& rule() const { return *rule_; }

 private:
  std::unique_ptr<CLI::Validator> rule_;
};

/// A whole number from `low` to `high`.
WordRule whole_number_between(long low, long high);

/// A finite number from `low` to `high`.
WordRule number_between(double low, double high);

/// Finite and greater than 0: a gate or a duration.
WordRule greater_than_zero();

/// A whole number from 0 to 2^53, as [measurement] seed in cell.toml.
WordRule seed_number();

enum class InHelp { kShown, kHidden };

/// One of these words. `help`: whether the help lists them.
WordRule one_of(const std::vector<std::string>& words, InHelp help = InHelp::kShown);

/// A handle to one option of a verb, with which it is described further. Copies refer to the same
/// option.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option type_name(const std::string& name) const;  ///< name of its value in the help: "MM"
  Option check(const WordRule& rule) const;
  Option required() const;
  Option shows_default() const;             ///< the help states its present value
  Option delimiter(char between) const;     ///< one word may hold several values
  Option one_value_each() const;            ///< list: the option is repeated for every value
  Option take_all() const;                  ///< text: if repeated, all values, one per line
  Option needs(const Option& other) const;  ///< an error unless `other` is given, too

 private:
  CLI::Option* option_;
};

/// The options of one verb. Each writes into the caller's variable when the command line is read;
/// the variables must live until then. `names` as "-o,--output"; without a dash it is a positional
/// word.
class VerbOptions {
 public:
  explicit VerbOptions(CLI::App* verb) : verb_(verb) {}

  Option add_flag(const std::string& names, bool& set, const std::string& help);

  /// Value: one of the types that verb_options.cpp lists at its end.
  template <class Value>
  Option add_option(const std::string& names, Value& value, const std::string& help);

  /// An option that was added before, found by one of its names.
  Option get_option(const std::string& name) const;

 private:
  CLI::App* verb_;
};

}  // namespace plumb
