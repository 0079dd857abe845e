// SPDX-License-Identifier: Apache-2.0
#include "import/cell_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>

#include "import/number_text.hpp"
#include "import/words.hpp"
#include "program/utf8.hpp"

namespace plumb::offline {
namespace {

/// Days since 1900, as spreadsheets count them, of the years 1954 and 2119.
constexpr double kFirstDay = 20000.0, kLastDay = 80000.0;
/// Seconds since 1970 of the years 1998 and 2128.
constexpr double kFirstEpoch_s = 9e8, kLastEpoch_s = 5e9;

std::optional<double> seconds_of(int year, int month, int day) {
  if (month < 1 || day < 1) return std::nullopt;
  const auto date = std::chrono::year{year} / std::chrono::month(static_cast<unsigned>(month)) /
                    std::chrono::day(static_cast<unsigned>(day));
  if (!date.ok()) return std::nullopt;
  return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count()) * kDay_s;
}

/// Takes text from its front, piece by piece.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  void blanks() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  bool sign(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  char any_of(std::string_view signs) {
    if (rest_.empty() || signs.find(rest_.front()) == signs.npos) return '\0';
    const char c = rest_.front();
    rest_.remove_prefix(1);
    return c;
  }
  /// Digits, up to `most`; their count in `length`.
  std::optional<int> whole(std::size_t most, std::size_t& length) {
    length = 0;
    while (length < rest_.size() && std::isdigit(static_cast<unsigned char>(rest_[length])))
      ++length;
    if (length == 0 || length > most) return std::nullopt;
    int value = 0;
    std::from_chars(rest_.data(), rest_.data() + length, value);
    rest_.remove_prefix(length);
    return value;
  }
  std::string letters() {
    std::size_t length = 0;
    while (length < rest_.size() && (std::isalpha(static_cast<unsigned char>(rest_[length])) ||
                                     static_cast<unsigned char>(rest_[length]) >= 0x80))
      ++length;
    std::string out = folded(rest_.substr(0, length));
    rest_.remove_prefix(length);
    return out;
  }
  std::optional<double> number() {
    std::size_t length = 0;
    while (length < rest_.size() &&
           (std::isdigit(static_cast<unsigned char>(rest_[length])) || rest_[length] == '.'))
      ++length;
    double value = 0.0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + length, value);
    if (length == 0 || error != std::errc{} || end != rest_.data() + length) return std::nullopt;
    rest_.remove_prefix(length);
    return value;
  }
  bool done() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

int month_named(const std::string& word) {
  static constexpr std::array<std::string_view, 12> kMonths{
      "jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"};
  if (word.size() < 3) return 0;
  for (std::size_t m = 0; m < kMonths.size(); ++m)
    if (word.starts_with(kMonths[m])) return static_cast<int>(m) + 1;
  if (word == "mai") return 5;
  if (word.starts_with("okt")) return 10;
  if (word.starts_with("dez")) return 12;
  return 0;
}

int full_year(int year, std::size_t digits) { return digits == 2 ? 2000 + year : year; }

/// "20.10.2022", "2022-10-20", "10/20/22", "20-Oct-2022", "20 Oct 2022", "Oct 20, 2022".
std::optional<CellTime> date(Scanner& s) {
  std::size_t digits[3] = {0, 0, 0};
  int n[3] = {0, 0, 0};
  if (const int month = month_named(s.letters()); month > 0) {
    s.sign('.');
    s.blanks();
    const auto day = s.whole(2, digits[0]);
    s.sign(',');
    s.blanks();
    const auto year = s.whole(4, digits[1]);
    if (!day || !year || digits[1] != 4) return std::nullopt;
    const auto t = seconds_of(*year, month, *day);
    return CellTime{"month by name", t, t};
  }
  auto first = s.whole(4, digits[0]);
  if (!first) return std::nullopt;
  n[0] = *first;
  char separator = s.any_of("./- ");
  if (separator == '.') s.blanks();
  if (const std::string word = s.letters(); !word.empty()) {
    const int month = month_named(word);
    s.any_of(".-/");
    s.blanks();
    const auto year = s.whole(4, digits[2]);
    if (month == 0 || !year || (digits[2] != 4 && digits[2] != 2)) return std::nullopt;
    const auto t = seconds_of(full_year(*year, digits[2]), month, n[0]);
    return CellTime{"month by name", t, t};
  }
  if (separator == '\0' || separator == ' ') return std::nullopt;
  for (int k = 1; k < 3; ++k) {
    if (k == 2 && !s.sign(separator)) return std::nullopt;
    const auto next = s.whole(4, digits[k]);
    if (!next) return std::nullopt;
    n[k] = *next;
  }
  if (digits[0] == 4) {
    const auto t = seconds_of(n[0], n[1], n[2]);
    return CellTime{separator == '-' ? "ISO 8601" : fmt::format("YYYY{0}MM{0}DD", separator), t, t};
  }
  // With dashes, a year of two digits may stand first or last, so such a date is not accepted.
  if (digits[2] != 4 && (digits[2] != 2 || separator == '-')) return std::nullopt;
  const int year = full_year(n[2], digits[2]);
  return CellTime{fmt::format("{}", separator), seconds_of(year, n[1], n[0]),
                  seconds_of(year, n[0], n[1]), true};
}

/// "16:57", "16:57:03.5", "4:57:03 PM", with a Z or +02:00 behind it. Seconds of the day.
std::optional<double> time_of_day(Scanner& s, bool& has_seconds) {
  std::size_t digits = 0;
  const auto hour = s.whole(2, digits);
  if (!hour || !s.sign(':')) return std::nullopt;
  const auto minute = s.whole(2, digits);
  if (!minute || digits != 2) return std::nullopt;
  double second = 0.0;
  has_seconds = s.sign(':');
  if (has_seconds) {
    const auto read = s.number();
    if (!read) return std::nullopt;
    second = *read;
  }
  if (*hour > 24 || *minute > 59 || second >= 61.0) return std::nullopt;
  double out = *hour * 3600.0 + *minute * 60.0 + second;
  s.blanks();
  if (const char zone = s.any_of("+-"); zone != '\0') {
    const auto hours = s.whole(4, digits);
    if (!hours) return std::nullopt;
    int minutes = digits == 4 ? *hours % 100 : 0;
    const int whole = digits == 4 ? *hours / 100 : *hours;
    if (s.sign(':')) minutes = s.whole(2, digits).value_or(0);
    return out - (zone == '+' ? 1.0 : -1.0) * (whole * 3600.0 + minutes * 60.0);
  }
  const std::string word = s.letters();
  if (word.empty() || word == "z" || word == "uhr" || word == "utc" || word == "h") return out;
  if ((word != "am" && word != "pm") || *hour > 12 || *hour < 1) return std::nullopt;
  if (*hour == 12) out -= 12.0 * 3600.0;
  return word == "pm" ? out + 12.0 * 3600.0 : out;
}

/// "20260304T123000Z" with the signs of ISO 8601.
std::optional<std::string> without_signs(const std::string& text) {
  const auto digits = [&](std::size_t from, std::size_t count) {
    return text.size() >= from + count &&
           std::all_of(text.begin() + static_cast<std::ptrdiff_t>(from),
                       text.begin() + static_cast<std::ptrdiff_t>(from + count),
                       [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  if (!digits(0, 8) || !digits(9, 4) || text[8] != 'T') return std::nullopt;
  return fmt::format("{}-{}-{}T{}:{}{}{}", text.substr(0, 4), text.substr(4, 2), text.substr(6, 2),
                     text.substr(9, 2), text.substr(11, 2), digits(13, 2) ? ":" : "",
                     text.substr(13));
}

std::optional<CellTime> dated(const std::string& text) {
  if (text.size() == 14 &&
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); })) {
    const auto part = [&](int from, int count) { return std::stoi(text.substr(from, count)); };
    auto t = seconds_of(part(0, 4), part(4, 2), part(6, 2));
    if (!t || part(8, 2) > 24 || part(10, 2) > 59 || part(12, 2) > 60) return std::nullopt;
    *t += part(8, 2) * 3600.0 + part(10, 2) * 60.0 + part(12, 2);
    return CellTime{"YYYYMMDDhhmmss", t, t};
  }
  if (const auto whole = without_signs(text)) return dated(*whole);
  Scanner s(text);
  auto out = date(s);
  if (!out) return std::nullopt;
  s.sign(',');
  s.blanks();
  (void)(s.sign('T') || s.sign('t'));
  s.blanks();
  bool has_seconds = false;
  const auto t = time_of_day(s, has_seconds);
  s.blanks();
  if (!t || !s.done()) return std::nullopt;
  if (out->day_first) *out->day_first += *t;
  if (out->month_first) *out->month_first += *t;
  if (!out->day_first && !out->month_first) return std::nullopt;
  if (out->format != "ISO 8601") out->format += has_seconds ? " hh:mm:ss" : " hh:mm";
  return out;
}

std::optional<CellTime> clock(const std::string& text) {
  Scanner s(text);
  bool has_seconds = false;
  const auto t = time_of_day(s, has_seconds);
  s.blanks();
  if (!t || !s.done() || !has_seconds || *t < 0.0 || *t >= kDay_s) return std::nullopt;
  return CellTime{"clock", t, t};
}

std::string with_points(std::string_view cell, char decimal) {
  std::string out(trimmed(cell));
  if (decimal == ',' || out.find(':') != out.npos) {
    const auto comma = out.rfind(',');
    if (comma != out.npos && comma + 1 < out.size() &&
        std::isdigit(static_cast<unsigned char>(out[comma + 1])))
      out[comma] = '.';
  }
  return out;
}

}  // namespace

std::optional<CellTime> cell_time(std::string_view cell, char decimal) {
  const std::string text = with_points(cell, decimal);
  if (auto found = dated(text)) return found;
  if (auto found = clock(text)) return found;
  const auto number = number_in(cell, decimal);
  if (!number || cell.find_first_of("eE") != cell.npos) return std::nullopt;
  if (*number > kFirstDay && *number < kLastDay)
    return CellTime{"spreadsheet days", *number * kDay_s, *number * kDay_s};
  static constexpr std::pair<const char*, double> kParts[] = {
      {"seconds", 1.0}, {"milliseconds", 1e3}, {"microseconds", 1e6}, {"nanoseconds", 1e9}};
  for (const auto& [name, in_a_second] : kParts)
    if (const double t = *number / in_a_second; may_be_epoch(t))
      return CellTime{fmt::format("{} since 1970", name), t, t};
  return std::nullopt;
}

bool may_be_epoch(double seconds) { return seconds > kFirstEpoch_s && seconds < kLastEpoch_s; }

bool may_be_date(double number) {
  return (number > kFirstDay && number < kLastDay) || number > kFirstEpoch_s;
}

}  // namespace plumb::offline
