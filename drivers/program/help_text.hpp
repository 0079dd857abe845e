// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace plumb {

/// Help that begins with the examples, which are kept in the footer.
class ExamplesFirst : public CLI::Formatter {
 public:
  ExamplesFirst() { column_width(34); }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    const std::string examples = app->get_footer();
    const bool first = mode == CLI::AppFormatMode::Normal && !examples.empty();
    return (first ? "Examples:\n" + examples + "\n\n" : "") +
           CLI::Formatter::make_help(app, std::move(name), mode);
  }

  std::string make_footer(const CLI::App*) const override { return "\n"; }
};

}  // namespace plumb
