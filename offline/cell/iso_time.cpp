// SPDX-License-Identifier: Apache-2.0
#include "cell/iso_time.hpp"

#include <fmt/chrono.h>

#include <charconv>
#include <chrono>
#include <string>

namespace plumb::offline {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Eats a text from its front.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  bool at_end() const { return rest_.empty(); }
  bool eat(std::string_view any_of) {
    if (rest_.empty() || any_of.find(rest_.front()) == std::string_view::npos) return false;
    last_ = rest_.front();
    rest_.remove_prefix(1);
    return true;
  }
  char last() const { return last_; }

  /// So many digits, of at most this value.
  std::optional<int> whole(std::size_t digits, int most) {
    if (rest_.size() < digits) return std::nullopt;
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i) {
      if (!is_digit(rest_[i])) return std::nullopt;
      value = 10 * value + (rest_[i] - '0');
    }
    if (value > most) return std::nullopt;
    rest_.remove_prefix(digits);
    return value;
  }

  /// The digits behind a decimal sign.
  std::optional<double> fraction() {
    std::string digits = "0.";
    while (!rest_.empty() && is_digit(rest_.front())) eat("0123456789"), digits += last_;
    double value = 0.0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return digits.size() > 2 ? std::optional(value) : std::nullopt;
  }

 private:
  std::string_view rest_;
  char last_ = 0;
};

std::optional<double> read_date(Reader& in) {
  const auto year = in.whole(4, 9999);
  const bool dashes = in.eat("-");
  const auto month = in.whole(2, 12);
  if (dashes && !in.eat("-")) return std::nullopt;
  const auto day = in.whole(2, 31);
  if (!year || !month || !day) return std::nullopt;
  const auto date = std::chrono::year{*year} / std::chrono::month(static_cast<unsigned>(*month)) /
                    std::chrono::day(static_cast<unsigned>(*day));
  if (!date.ok()) return std::nullopt;
  return 86400.0 * static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

std::optional<double> read_clock(Reader& in) {
  const auto hour = in.whole(2, 24);
  const bool colons = in.eat(":");
  const auto minute = in.whole(2, 59);
  if (!hour || !minute) return std::nullopt;
  double out = *hour * 3600.0 + *minute * 60.0;
  if (colons && !in.eat(":")) return out;
  const auto second = in.whole(2, 60);
  if (!second) return colons ? std::nullopt : std::optional(out);
  out += *second;
  if (!in.eat(".,")) return out;
  const auto part = in.fraction();
  return part ? std::optional(out + *part) : std::nullopt;
}

/// What is ahead of UTC.
std::optional<double> read_zone(Reader& in) {
  if (in.at_end() || in.eat("Z")) return 0.0;
  in.eat(" ");
  if (!in.eat("+-")) return std::nullopt;
  const double sign = in.last() == '+' ? 1.0 : -1.0;
  const auto hours = in.whole(2, 23);
  if (!hours) return std::nullopt;
  if (in.at_end()) return sign * *hours * 3600.0;
  in.eat(":");
  const auto minutes = in.whole(2, 59);
  return minutes ? std::optional(sign * (*hours * 3600.0 + *minutes * 60.0)) : std::nullopt;
}

}  // namespace

std::optional<double> iso_seconds(std::string_view text) {
  Reader in(text);
  const auto date = read_date(in);
  if (!date || !in.eat("T ")) return std::nullopt;
  const auto clock = read_clock(in);
  if (!clock) return std::nullopt;
  const auto zone = read_zone(in);
  if (!zone || !in.at_end()) return std::nullopt;
  return *date + *clock - *zone;
}

std::string iso_utc(std::time_t seconds) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(seconds));
}

}  // namespace plumb::offline
