// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

namespace plumb::offline {

/// Where the lines of each reading stand among all lines of a least-squares problem: a point gives
/// three, a pose six, a distance one. Readings follow each other in the order of the rows.
class LineTable {
 public:
  LineTable() = default;

  /// The number of lines of each reading.
  explicit LineTable(const std::vector<int>& counts) {
    begin_.reserve(counts.size() + 1);
    for (const int count : counts) {
      reading_.insert(reading_.end(), static_cast<std::size_t>(count), readings());
      begin_.push_back(begin_.back() + count);
      most_ = std::max<Eigen::Index>(most_, count);
    }
  }

  Eigen::Index readings() const { return static_cast<Eigen::Index>(begin_.size()) - 1; }
  Eigen::Index lines() const { return begin_.back(); }

  /// The most lines of one reading.
  Eigen::Index most() const { return most_; }

  /// Its first line, and how many it has. begin(readings()) is the number of all lines.
  Eigen::Index begin(Eigen::Index reading) const {
    return begin_[static_cast<std::size_t>(reading)];
  }
  Eigen::Index count(Eigen::Index reading) const { return begin(reading + 1) - begin(reading); }

  /// The lines of the readings from `first` up to but without `last`.
  Eigen::Index count(Eigen::Index first, Eigen::Index last) const {
    return begin(last) - begin(first);
  }

  /// The reading to which a line belongs.
  Eigen::Index reading(Eigen::Index line) const { return reading_[static_cast<std::size_t>(line)]; }

  /// The table of some readings, in this order, and their lines.
  LineTable picked(const std::vector<Eigen::Index>& some) const {
    std::vector<int> counts;
    for (const Eigen::Index i : some) counts.push_back(static_cast<int>(count(i)));
    return LineTable(counts);
  }
  std::vector<Eigen::Index> lines_of(const std::vector<Eigen::Index>& some) const {
    std::vector<Eigen::Index> out;
    for (const Eigen::Index i : some)
      for (Eigen::Index line = begin(i); line < begin(i + 1); ++line) out.push_back(line);
    return out;
  }

 private:
  std::vector<Eigen::Index> begin_{0}, reading_;
  Eigen::Index most_ = 0;
};

}  // namespace plumb::offline
