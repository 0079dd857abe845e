// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "answers/answers.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "figures/run_results.hpp"
#include "program/json.hpp"
#include "workbench/response.hpp"

namespace plumb::offline::workbench {

/// A cell as it is now, read again whenever a file of it changes, from a shell or from here. Every
/// call first looks at the files. May be called from any thread; one call at a time is served.
/// Functions throw Failure with what is wrong with the cell, the measurements or the run.
///
/// Keeps the results of two runs and 32 MB of finished answers.
class LiveCell {
 public:
  /// `slow_figure`: draws what needs more than a run, a diagnosis for instance; called without the
  /// lock. `run` is 0 for that of the present cell.
  using SlowFigure = std::function<std::string(const std::string& name, int run, int width)>;
  LiveCell(std::filesystem::path cell_toml, SlowFigure slow_figure);

  /// Grows whenever cell.toml, a measurement file, a run or a file of the folder changes, and from
  /// one server to the next. Begins with the time of the start [ms].
  std::int64_t state();

  // As JSON. A broken cell.toml is no failure of `cell`, but its "problem". run 0: the current one.
  Bytes cell();
  Bytes runs();
  Bytes run(int number);
  Bytes poses(int number);
  Bytes frames(int number, int row);
  Bytes figures(int number);

  /// The bytes of `plumb plot NAME --run N --width W`.
  Bytes figure(const std::string& name, int number, int width);

  /// Replaces cell.toml if it is still that of `if_state`; the new text is read first. Throws
  /// Failure E-SERVE-STATE if it is not, and what read_cell would.
  void replace_text(const std::string& toml, std::int64_t if_state);

 private:
  /// A run with what its figures are drawn from; the members refer to each other.
  struct RunView {
    std::shared_ptr<const Cell> cell;
    MeasurementFiles measured;
    Run run;
    std::optional<figures::RunResults> results;
    Answers answers;
  };
  struct RunRow {
    std::string stamp;
    Json row;  // as `plumb runs --json` lists it; null if the run is damaged
    std::string fit_sha256;
    std::vector<std::string> data;
    std::optional<Problem> problem;
  };

  void look();
  void read_cell_again();
  void read_data_again();
  const Cell& present_cell() const;
  const MeasurementFiles& present_data() const;
  std::vector<std::filesystem::path> data_files() const;
  void look_at_runs();
  Json run_list();
  bool is_current(const RunRow& row) const;
  int current() const;
  int number_or_current(int number) const;
  const RunView& view(int number);
  Bytes kept(const std::string& key, const std::function<std::string()>& make);
  Json cell_json() const;
  Json finding_of(int run);
  Json data_json() const;

  const std::filesystem::path file_;
  const std::filesystem::path folder_;
  const SlowFigure slow_figure_;

  std::mutex mutex_;
  std::int64_t state_;
  std::string folder_stamps_, data_stamps_;
  std::string text_;                      // of cell.toml
  std::shared_ptr<const Cell> cell_;      // null: it cannot be read
  std::optional<MeasurementFiles> data_;  // none: they cannot be read
  std::string cell_sha256_, fit_sha256_;
  std::vector<std::string> data_sha256_;
  std::optional<Problem> cell_problem_, data_problem_;
  std::map<int, RunRow> rows_;
  std::deque<std::unique_ptr<RunView>> views_;  // the last used one first
  std::map<std::string, Bytes> answers_;
  std::size_t answer_bytes_ = 0;
};

}  // namespace plumb::offline::workbench
