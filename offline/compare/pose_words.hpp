// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cell/measurements.hpp"
#include "fit/fit.hpp"

/// Which poses a model is judged by, and how sentences name them.
namespace plumb::offline::compare {

/// Rows by which the model is judged: the held-out ones, or all fitted ones if none was held out;
/// without those that are listed as standing out.
std::vector<int> judged_rows(const Fit& fit);

/// Those of the rows that no headline leaves out because they are listed as standing out.
std::vector<int> usual_rows(const Fit& fit, std::vector<int> rows);

/// "12 held-out poses" or, without any, "80 fitted poses"; one is "1 held-out pose". Of those that
/// count: "57 held-out poses (without 3 readings that stand out)".
std::string judged_words(const Fit& fit);

/// "0.41 mm", "12 µm": two significant digits.
std::string length_text(double metres);

/// "12, 57 and 80", or with the word before them, "poses 12, 57 and 80" or "pose 12"; at most
/// `most` names, long ones cut.
std::string pose_names(const Measurements& measured, std::span<const int> rows, std::size_t most);
std::string pose_list(const Measurements& measured, std::span<const int> rows, std::size_t most);

}  // namespace plumb::offline::compare
