// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "report/html.hpp"

namespace plumb::offline::report {

/// A numbered part of a document. id: of links to it.
struct Section {
  const char* id;
  std::string title;
  Html body;
};

/// A whole HTML file without script, which loads nothing: the first section, a list of contents,
/// and the other sections. The words of `title` are escaped, those of the sections' titles are not.
std::string document(const std::string& title, const std::vector<Section>& sections);

}  // namespace plumb::offline::report
