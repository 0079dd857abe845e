// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/measurements.hpp"

namespace plumb::offline {

/// W-CSV-COLUMN: a column that means nothing here, but whose name is that of a known one but for a
/// slip. Added to the table's remarks.
void warn_of_misspelt(Table& table);

/// W-CSV-VALUE: loads of tonnes, temperatures in kelvin or Fahrenheit under another name, moves of
/// many turns. Added to the table's remarks.
void warn_of_values(Table& table);

/// W-CSV-DOUBLE: a row copied by mistake counts twice and makes the noise look smaller than it is.
/// Added to the table's remarks, once a file.
void warn_of_doubles(Table& table);

/// W-CSV-POSE: one name for different poses would turn the arm's motion into noise. Added to the
/// remarks of the tables, once a file.
void warn_of_names(MeasurementFiles& measurements);

/// W-CSV-SIGMA: a standard deviation of zero, which some trackers write where they have none, would
/// give its reading all the weight. It is replaced by the smallest one above zero of its axis, or
/// of any axis; where all are zero none is used. Added to the remarks of the tables, once a file.
void replace_zero_sigmas(MeasurementFiles& measurements);

}  // namespace plumb::offline
