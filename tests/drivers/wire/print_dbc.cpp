// SPDX-License-Identifier: Apache-2.0
// Prints the DBC of a default six-axis layout with the given words changed, for dbc_peer.py.
#include <cstdio>
#include <set>
#include <string>

#include "bus_text/dbc.hpp"

int main(int argc, char** argv) {
  using namespace plumb::drivers;
  const std::set<std::string> words(argv + 1, argv + argc);
  const auto form = words.contains("offset") ? CorrectionForm::kOffset : CorrectionForm::kPose;
  BusLayout layout = default_layout(6, 0.004, 0, form);
  if (words.contains("fd")) layout.can_format = CanFrame::Format::kFd;
  if (words.contains("big")) layout.byte_order = ByteOrder::kBig;
  if (words.contains("extended")) layout.id_kind = CanFrame::Id::kExtended;
  std::fputs(write_dbc(layout, "Line (F08-1234)").c_str(), stdout);
}
