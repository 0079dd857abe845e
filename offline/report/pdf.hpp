// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace plumb::offline::report {

/// The browser that prints: the first of chromium, chromium-browser, google-chrome and
/// google-chrome-stable on PATH. Throws Failure (kEnvironment, E-REPORT-BROWSER) if there is none.
std::filesystem::path find_browser();

/// The page printed to A4 by that browser, without a request and with a profile of its own in a
/// temporary folder that is gone afterwards. Throws Failure (kEnvironment, E-REPORT-PDF) if it
/// fails or takes more than two minutes. Cost: some seconds.
std::string printed_pdf(const std::filesystem::path& browser, const std::string& html);

}  // namespace plumb::offline::report
