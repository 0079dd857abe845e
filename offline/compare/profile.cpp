// SPDX-License-Identifier: Apache-2.0
#include "compare/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/constants.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline::compare {
namespace {

struct ValueRange {
  double low = std::numeric_limits<double>::max(), high = -std::numeric_limits<double>::max();
  int count = 0;
};

ValueRange range_of(const std::vector<Sample>& samples) {
  ValueRange out;
  for (const auto& s : samples) {
    if (std::isnan(s.value)) continue;
    out.low = std::min(out.low, s.value);
    out.high = std::max(out.high, s.value);
    ++out.count;
  }
  return out;
}

std::vector<ErrorBin> empty_bins(const ValueRange& range, const std::vector<double>& labels) {
  std::vector<ErrorBin> out;
  for (const double label : labels) out.push_back({.from = label, .to = label});
  if (!labels.empty()) return out;
  const bool flat = !(range.high > range.low);
  const int count = flat ? 1 : std::clamp(range.count / kPosesPerBin, 1, kMostBins);
  const double step = (range.high - range.low) / count;
  for (int k = 0; k < count; ++k)
    out.push_back({.from = range.low + k * step,
                   .to = k + 1 == count ? range.high : range.low + (k + 1) * step});
  return out;
}

/// Index of the bin of a value; -1 if it has none.
int bin_of(double value, const std::vector<ErrorBin>& bins, const std::vector<double>& labels) {
  if (std::isnan(value)) return -1;
  if (!labels.empty()) {
    const auto at = std::find(labels.begin(), labels.end(), value);
    return at == labels.end() ? -1 : static_cast<int>(at - labels.begin());
  }
  const auto count = static_cast<int>(bins.size());
  const double span = bins.back().to - bins.front().from;
  const double place = span > 0.0 ? (value - bins.front().from) / span * count : 0.0;
  return std::clamp(static_cast<int>(place), 0, count - 1);
}

void add(const Sample& sample, ErrorBin& bin) {
  if (sample.set != Sample::Set::kFitted) {
    bin.mean += sample.error;
    ++bin.n;
  }
  if (sample.set != Sample::Set::kJudged) {
    bin.fit_mean += sample.fit_error;
    ++bin.fit_n;
  }
}

/// One-way analysis of variance of the errors over the bins.
void explain(const std::vector<Sample>& samples, const std::vector<int>& bin, ErrorProfile& out) {
  std::vector<double> sum(out.bins.size(), 0.0), count(out.bins.size(), 0.0);
  double total = 0.0, squares = 0.0, n = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (bin[i] < 0 || samples[i].repeat) continue;
    const auto k = static_cast<std::size_t>(bin[i]);
    sum[k] += samples[i].error;
    count[k] += 1.0;
    total += samples[i].error;
    squares += samples[i].error * samples[i].error;
    n += 1.0;
  }
  double between = 0.0, filled = 0.0;
  for (std::size_t k = 0; k < sum.size(); ++k) {
    if (count[k] == 0.0) continue;
    between += sum[k] * sum[k] / count[k];
    filled += 1.0;
  }
  if (n <= filled || filled < 2.0) return;
  const double mean_part = total * total / n;
  const double whole = squares - mean_part, left = squares - between;
  // Errors whose variance is due to rounding only are equal.
  if (!(whole > 1e-20 * squares) || !(left > 0.0)) return;
  out.explained = (between - mean_part) / whole;
  out.ln_p = f_test(between - mean_part, filled - 1.0, left, n - filled).ln_p;
}

}  // namespace

double ErrorProfile::contrast() const {
  double low = std::numeric_limits<double>::max(), high = 0.0;
  for (const auto& bin : bins) {
    if (bin.n == 0) continue;
    low = std::min(low, bin.mean);
    high = std::max(high, bin.mean);
  }
  return low > 0.0 && high > low ? high / low : 1.0;
}

ErrorProfile profile(ErrorProfile out, const std::vector<Sample>& samples,
                     const std::vector<double>& labels) {
  const ValueRange range = range_of(samples);
  if (range.count == 0) return out;
  out.bins = empty_bins(range, labels);
  std::vector<int> bin(samples.size(), -1);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    bin[i] = bin_of(samples[i].value, out.bins, labels);
    if (bin[i] >= 0) add(samples[i], out.bins[static_cast<std::size_t>(bin[i])]);
  }
  for (auto& b : out.bins) {
    if (b.n > 0) b.mean /= b.n;
    if (b.fit_n > 0) b.fit_mean /= b.fit_n;
  }
  explain(samples, bin, out);
  return out;
}

void set_matters(std::vector<ErrorProfile>& profiles) {
  const double limit =
      std::log(kPatternChance / static_cast<double>(std::max<std::size_t>(1, profiles.size())));
  for (auto& p : profiles) p.matters = p.ln_p < limit;
}

}  // namespace plumb::offline::compare
