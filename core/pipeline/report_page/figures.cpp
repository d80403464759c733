// Three digits are what these measures are good for, and more would hide the first. A bound is
// rounded up and never down, so that the page claims nothing that report.json does not.
#include "core/pipeline/report_page/figures.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/io/geojson_text.h"

namespace farhorizon {

namespace {

// Decimals after which three digits of `value` have been written.
int DecimalsOf(double value) {
  if (!(std::abs(value) > 0)) return 0;
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 12);
}

// The same where `rounded`, the value in units of the last decimal, may have got a fourth digit.
int DecimalsOf(double value, double (*rounded)(double)) {
  const int decimals = DecimalsOf(value);
  return decimals > 0 && rounded(std::abs(value) * std::pow(10.0, decimals)) >= 1000 ? decimals - 1
                                                                                     : decimals;
}

std::string Fixed(double value, int decimals) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals);
  return {text.data(), end.ptr};
}

// The digits before the point of a number's text in groups of three.
std::string GroupDigits(std::string text) {
  const std::size_t first = text.find_first_of("0123456789");
  const std::size_t point = std::min(text.find('.'), text.size());
  for (std::size_t at = point; at > first + 3;) {
    at -= 3;
    text.insert(at, ",");
  }
  return text;
}

}  // namespace

std::string Grouped(std::int64_t value) { return GroupDigits(std::to_string(value)); }

std::string ThreeDigits(double value) {
  if (std::abs(value) >= 999.5) return Grouped(std::llround(value));
  return Fixed(value, DecimalsOf(value, std::round));
}

std::string ThreeDigitsUp(double value) {
  if (value > 999) return Grouped(static_cast<std::int64_t>(std::ceil(value)));
  const int decimals = DecimalsOf(value, std::ceil);
  const double scale = std::pow(10.0, decimals);
  double up = std::ceil(value * scale) / scale;
  // The quotient is rounded, to below `value` where that has few digits more.
  if (up < value) up = (std::ceil(value * scale) + 1) / scale;
  return Fixed(up, decimals);
}

std::string Shortest(double value) {
  if (std::abs(value) >= 999.5) return Grouped(std::llround(value));
  return Rounded(value, DecimalsOf(value));
}

std::string ByteCount(std::int64_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (bytes < 1000) return std::to_string(bytes) + " B";
  if (bytes < 999'500) return ThreeDigits(value / 1e3) + " kB";
  return ThreeDigits(value / 1e6) + " MB";
}

std::string PercentOf(double part, double whole) {
  return ThreeDigits(whole > 0 ? 100 * part / whole : 0) + " %";
}

std::string Counted(std::int64_t count, const std::string& one, const std::string& many) {
  return Grouped(count) + " " + (count == 1 ? one : many);
}

}  // namespace farhorizon
