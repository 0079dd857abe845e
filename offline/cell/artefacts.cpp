// SPDX-License-Identifier: Apache-2.0
#include "cell/artefacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "cell/table_place.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline {
namespace {

constexpr const char* kPointCode = "E-CSV-POINT";

/// Two statements of one length that differ by more than this contradict each other [m].
constexpr double kSameLength_m = 1e-6;

/// A reading beyond this is a mistake.
constexpr double kFarthest_m = 100.0;

std::string with_article(const std::string& noun) {
  return (noun.front() == 'a' ? "an " : "a ") + noun;
}

std::string in_small_letters(std::string label) {
  for (char& c : label) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return label;
}

bool all_different(const Column& labels) {
  return std::set<std::string_view>(labels.text.begin(), labels.text.end()).size() ==
         labels.text.size();
}

/// What the descriptor's value is called in this table: an extension is a distance less a length
/// that nobody knows.
const Column* find_value(const Table& table, const ReadingDescriptor& kind) {
  if (kind.value == nullptr) return nullptr;
  const Column* column = table.find(kind.value);
  return column == nullptr && kind.kind == ReadingKind::kDistance ? table.find("extension")
                                                                  : column;
}

/// Lists artefacts and distances in the order in which rows name them.
class ArtefactList {
 public:
  ArtefactList(MeasurementSettings& settings, ProblemList& problems)
      : m_(settings), problems_(problems) {}

  void read(const Table& table) {
    kind_ = kind_of(table);
    const Column& label = *table.find_text(descriptor_of(kind_).label);
    const Column* position = table.find_text("position");
    check_columns(table, label);
    int without = 0;
    for (int row = 0; row < table.rows(); ++row)
      if (label.text[row].empty() && without++ == 0)
        problems_.error(kPointCode,
                        fmt::format("this row does not say which {} it touches", noun()),
                        place_in_row(table, row, label, "empty"),
                        fmt::format("write the label of the {}, or delete the row", noun()));
      else
        list(table, row, label, position);
  }

  /// After all points are listed.
  void read_lengths(const Table& table) {
    if (kind_of(table) != ReadingKind::kPoint) return;
    const Column* to = table.find_text("to_point");
    const Column* distance = table.find("distance");
    if (to == nullptr || distance == nullptr) return one_without_the_other(table, to, distance);
    const Column& from = *artefact_column(table);
    for (int row = 0; row < table.rows(); ++row)
      if (!to->text[row].empty()) length(table, row, from.text[row], *to, *distance);
  }

 private:
  const char* noun() const { return descriptor_of(kind_).noun; }

  /// A file has one kind of reading, and each row of it has one.
  void check_columns(const Table& table, const Column& label) {
    const std::string own = label.name;
    for (const char* other : {"point", "plane", "sphere", "anchor"})
      if (const Column* column = table.find_text(other); column != nullptr && own != other)
        problems_.error(kPointCode,
                        fmt::format("columns '{}' and '{}': a row is about one of them",
                                    label.header, column->header),
                        place_in_header(table, *column, "the second one"),
                        "write rows of the other kind into a file of their own");
    for (const auto& [other, label_of] :
         {std::pair{"height", "plane"}, std::pair{"radius", "sphere"},
          std::pair{"extension", "anchor"}, std::pair{"to_point", "point"}})
      if (const Column* column = table.find(other); column != nullptr && own != label_of)
        no_place_for(table, *column, label);
    const Column* distance = table.find("distance");
    const bool twice = own == "anchor" && table.find("extension") != nullptr;
    if (distance != nullptr && (twice || (own != "anchor" && own != "point")))
      no_place_for(table, *distance, label);
    const Column* value = find_value(table, descriptor_of(kind_));
    if (kind_ == ReadingKind::kDistance && value == nullptr)
      return problems_.error(kPointCode, "nothing says how far the target is from the anchor",
                             place_in_header(table, label, "needs one more column"),
                             "add 'distance_mm', or 'extension_mm' if the zero of the wire is not "
                             "known");
    const bool distances = value != nullptr && value == distance;
    for (int row = 0; value != nullptr && row < table.rows(); ++row)
      if (const double read = value->values[row];
          !(std::abs(read) < kFarthest_m) || (distances && !(read > 0.0)))
        return problems_.error(
            kPointCode,
            fmt::format("column '{}' holds {} here", value->header,
                        std::isfinite(read) ? fmt::format("{:g} mm", read * 1e3) : "no number"),
            place_in_row(table, row, *value, "no reading of an arm"),
            "write what was read there, or delete the row");
  }

  void no_place_for(const Table& table, const Column& column, const Column& label) {
    problems_.error(kPointCode,
                    fmt::format("column '{}' says nothing of '{}'", column.header, label.header),
                    place_in_header(table, column, "not used"),
                    "delete the column, or name in another one what it is about");
  }

  /// One artefact has one spelling.
  void check_spelling(const Table& table, int row, const Column& label) {
    const std::string& name = label.text[row];
    const auto [first, is_new] = spelt_.emplace(in_small_letters(name), name);
    if (is_new) return;
    problems_.error(
        kPointCode, fmt::format("'{}' here is '{}' in a row before", name, first->second),
        place_in_row(table, row, label, "differs in capital letters only"),
        fmt::format("write one label for one {}, or labels that differ clearly", noun()));
  }

  /// One artefact stands in one place.
  void check_position(const Table& table, int row, const Column* position, const Setup& setup) {
    if (position == nullptr || position->text[row] == setup.position) return;
    problems_.error(kPointCode,
                    fmt::format("'{}' stands at '{}' here and at '{}' in a row before", setup.name,
                                position->text[row], setup.position),
                    place_in_row(table, row, *position, "contradicts it"),
                    "give it another label where it was moved");
  }

  void list(const Table& table, int row, const Column& label, const Column* position) {
    const std::string& name = label.text[row];
    if (name.empty()) return;
    const auto [at, is_new] = index_.emplace(name, static_cast<int>(m_.setups.size()));
    if (is_new) check_spelling(table, row, label);
    if (is_new) add(table, name, position == nullptr ? "" : position->text[row]);
    Setup& setup = m_.setups[static_cast<std::size_t>(at->second)];
    check_position(table, row, position, setup);
    const bool extension = kind_ == ReadingKind::kDistance && table.find("distance") == nullptr;
    if (setup.reads == ReadingKind::kDistance && kind_ == ReadingKind::kDistance &&
        setup.fit_length != extension)
      return problems_.error(
          kPointCode, fmt::format("'{}' has distances in one file and extensions in another", name),
          place_in_row(table, row, label, "two kinds of reading"),
          "give one of them another label");
    if (std::string_view(descriptor_of(setup.reads).label) != descriptor_of(kind_).label)
      return problems_.error(
          kPointCode,
          fmt::format("'{}' is {} here and {} in another file", name, with_article(noun()),
                      with_article(descriptor_of(setup.reads).noun)),
          place_in_row(table, row, label, "has two meanings"), "give one of them another label");
    if (setup.reads == ReadingKind::kSphere) take_radius(table, row, is_new, setup);
  }

  void add(const Table& table, const std::string& name, const std::string& position) {
    Setup setup;
    setup.name = name;
    setup.reads = kind_;
    setup.position = position;
    setup.fit_length = setup.reads == ReadingKind::kDistance && table.find("distance") == nullptr;
    setup.fit_target = m_.fit_target || !m_.setups.empty();
    setup.target_T = m_.target_T;
    if (first_ < 0)
      first_ = static_cast<int>(m_.setups.size());
    else
      setup.target_of = first_;
    m_.setups.push_back(std::move(setup));
  }

  /// The radius that the first row of a sphere states is that of the sphere; none: it is fitted.
  void take_radius(const Table& table, int row, bool is_new, Setup& setup) {
    const Column* radius = table.find("radius");
    const bool stated = radius != nullptr && std::isfinite(radius->values[row]);
    if (is_new) {
      setup.fit_length = !stated;
      setup.length_m = stated ? radius->values[row] : 0.0;
    }
    if (!stated) return;
    const double here = radius->values[row];
    if (!(here > 0.0))
      problems_.error(kPointCode, "the radius of a sphere is greater than 0",
                      place_in_row(table, row, *radius, "not greater than 0"),
                      "write how far the target is from the centre");
    else if (setup.fit_length || std::abs(setup.length_m - here) > kSameLength_m)
      problems_.error(kPointCode,
                      fmt::format("the radius of '{}' is {:g} mm here and {} in a row before",
                                  setup.name, here * 1e3,
                                  setup.fit_length ? std::string("not stated")
                                                   : fmt::format("{:g} mm", setup.length_m * 1e3)),
                      place_in_row(table, row, *radius, "contradicts it"), "correct one of them");
  }

  void one_without_the_other(const Table& table, const Column* to, const Column* distance) {
    const Column* alone = to != nullptr ? to : distance;
    if (alone == nullptr) return;
    problems_.error(kPointCode,
                    fmt::format("column '{}' is of no use alone: a known distance between two "
                                "points needs 'to_point' and 'distance_mm'",
                                alone->header),
                    place_in_header(table, *alone, "the other one is missing"),
                    "add the other column, or delete this one");
  }

  void length(const Table& table, int row, const std::string& from, const Column& to,
              const Column& distance) {
    const std::string& other = to.text[row];
    const auto end = index_.find(other);
    if (end == index_.end() || other == from || !is_point(end->second))
      return problems_.error(kPointCode,
                             other == from
                                 ? fmt::format("'{}' is the point of this row itself", other)
                                 : fmt::format("no row touches the point '{}'", other),
                             place_in_row(table, row, to, "no other point"),
                             "write the label of another point that rows touch");
    const double length_m = distance.values[row];
    if (!(length_m > 0.0))
      return problems_.error(kPointCode, "the distance of two points is greater than 0",
                             place_in_row(table, row, distance, "not greater than 0"),
                             "write the distance between the two points");
    const int a = index_.at(from), b = end->second;
    const auto [known, is_new] = lengths_.emplace(std::minmax(a, b), length_m);
    if (is_new)
      m_.lengths.push_back({a, b, length_m});
    else if (std::abs(known->second - length_m) > kSameLength_m)
      problems_.error(
          kPointCode,
          fmt::format("'{}' and '{}' are {:g} mm apart here and {:g} mm in a row before", from,
                      other, length_m * 1e3, known->second * 1e3),
          place_in_row(table, row, distance, "contradicts it"), "correct one of them");
  }

  bool is_point(int setup) const {
    return m_.setups[static_cast<std::size_t>(setup)].reads == ReadingKind::kPoint;
  }

  MeasurementSettings& m_;
  ProblemList& problems_;
  ReadingKind kind_ = ReadingKind::kPosition;  // of the table that is read
  std::map<std::string, int> index_;
  std::map<std::string, std::string> spelt_;  // by the label in small letters
  std::map<std::pair<int, int>, double> lengths_;
  int first_ = -1;
};

}  // namespace

ReadingKind kind_of(const Table& table) {
  if (table.find("x") != nullptr || table.find("y") != nullptr || table.find("z") != nullptr)
    return ReadingKind::kPosition;
  ReadingKind out = ReadingKind::kPosition;
  for (const ReadingDescriptor& kind : artefact_readings()) {
    const Column* label = table.find_text(kind.label);
    if (label == nullptr || all_different(*label)) continue;
    const bool first = out == ReadingKind::kPosition;
    const bool richer = !first && std::string_view(descriptor_of(out).label) == kind.label;
    if ((first && (kind.value == nullptr || kind.kind == ReadingKind::kDistance)) ||
        (richer && find_value(table, kind) != nullptr))
      out = kind.kind;
  }
  return out;
}

const Column* artefact_column(const Table& table) {
  return table.find_text(descriptor_of(kind_of(table)).label);
}

const Column* value_column(const Table& table) {
  return find_value(table, descriptor_of(kind_of(table)));
}

void list_artefacts(const std::vector<Table>& tables, MeasurementSettings& m) {
  std::erase_if(m.setups, [](const Setup& s) { return s.is_artefact(); });  // of an earlier reading
  m.lengths.clear();
  const std::ptrdiff_t count = std::count_if(tables.begin(), tables.end(), reads_artefact);
  if (count == 0) return;
  if (m.setups.empty() && count < static_cast<std::ptrdiff_t>(tables.size())) {
    Setup tracker;
    tracker.name = "measured positions";
    tracker.fit_frame = m.fit_frame;
    tracker.X_MB = m.X_MB;
    tracker.fit_target = m.fit_target;
    tracker.target_T = m.target_T;
    m.setups.push_back(std::move(tracker));
  }
  ProblemList problems;
  ArtefactList list(m, problems);
  for (const auto& table : tables)
    if (reads_artefact(table)) list.read(table);
  for (const auto& table : tables)
    if (reads_artefact(table)) list.read_lengths(table);
  problems.stop_on_errors();
}

namespace {

/// Whether so many readings of an artefact tell no more than where it is.
bool says_nothing(const Setup& setup, const Measurements& measured, const std::vector<int>& rows) {
  return measured.axes(rows.front()) * static_cast<int>(rows.size()) <=
         kNumbersOfArtefact + (setup.fit_length ? 1 : 0);
}

void ignore_few_readings(const MeasurementSettings& m, MeasurementFiles& measured) {
  std::map<int, std::vector<int>> rows;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.of_artefact(i) && measured.set[static_cast<std::size_t>(i)] != SetMark::kIgnore)
      rows[measured.setup[static_cast<std::size_t>(i)]].push_back(i);
  std::map<std::string, std::vector<std::string>> names;  // by the word for the artefact
  for (const auto& [setup, of_one] : rows) {
    const Setup& one = m.setups[static_cast<std::size_t>(setup)];
    if (!says_nothing(one, measured, of_one)) continue;
    for (const int row : of_one) measured.set[static_cast<std::size_t>(row)] = SetMark::kIgnore;
    names[descriptor_of(one.reads).noun].push_back(one.name);
  }
  if (names.empty()) return;
  auto& table = *std::find_if(measured.tables.begin(), measured.tables.end(), reads_artefact);
  for (const auto& [noun, which] : names)
    table.remarks.push_back(
        {Severity::kWarning, "W-CSV-POINT",
         noun == "point"
             ? fmt::format("a point that is touched only once says nothing, and its row is not "
                           "used: {}",
                           fmt::join(which, ", "))
             : fmt::format("{} with so few readings says nothing, and they are not used: {}",
                           with_article(noun), fmt::join(which, ", ")),
         place_in_header(table, *artefact_column(table), "labels"),
         fmt::format("give rows of one {} the same label, or measure it again from other "
                     "directions",
                     noun)});
}

}  // namespace

void assign_placements(const MeasurementSettings& settings, MeasurementFiles& measured) {
  if (std::none_of(measured.tables.begin(), measured.tables.end(), reads_artefact)) return;
  measured.placement.clear();
  std::map<std::string, int> number;
  for (const auto& table : measured.tables) {
    const Column* label = reads_artefact(table) ? artefact_column(table) : nullptr;
    const Column* position = table.find_text("position");
    for (int row = 0; row < table.rows(); ++row) {
      if (label == nullptr) {
        measured.placement.push_back(-1);
        continue;
      }
      const bool placed = position != nullptr && !position->text[row].empty();
      const std::string key =
          placed ? "position " + position->text[row] : "point " + label->text[row];
      measured.placement.push_back(
          number.emplace(key, static_cast<int>(number.size())).first->second);
    }
  }
  ignore_few_readings(settings, measured);
}

bool lacks_length(const Cell& cell) {
  const MeasurementSettings& m = cell.measurement;
  const auto slides = [](const format::JointRow& row) {
    return row.type == format::JointType::kPrismatic;
  };
  // A height above a plane is a length, but of some millimetres only.
  const auto tells_size = [](const Setup& s) {
    const bool radius = s.reads == ReadingKind::kSphere && !s.fit_length;
    return !s.is_artefact() || radius || s.reads == ReadingKind::kDistance;
  };
  return std::none_of(cell.nominal.joints.begin(), cell.nominal.joints.end(), slides) &&
         !m.setups.empty() && m.lengths.empty() &&
         std::none_of(m.setups.begin(), m.setups.end(), tells_size);
}

}  // namespace plumb::offline
