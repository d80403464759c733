#include "core/io/dem/number_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace farhorizon {

namespace {

template <typename T>
std::string Shortest(T value) {
  std::array<char, 32> text{};
  const auto [end, failure] = std::to_chars(text.data(), text.data() + text.size(), value);
  return failure == std::errc() ? std::string(text.data(), end) : "";
}

}  // namespace

std::string NumberText(double value) {
  constexpr double kWholeInDigits = 1e15;
  if (value == std::trunc(value) && std::abs(value) < kWholeInDigits) {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  const bool is_float = std::abs(value) <= std::numeric_limits<float>::max() &&
                        static_cast<double>(static_cast<float>(value)) == value;
  return is_float ? Shortest(static_cast<float>(value)) : Shortest(value);
}

std::optional<double> ParseTagNumber(std::string_view text) {
  std::string word(text);
  std::ranges::transform(word, word.begin(), [](unsigned char c) {
    return c == ',' ? '.' : static_cast<char>(std::tolower(c));
  });
  const std::size_t mark = word.find("1.#");
  if (mark <= 1) {
    const bool infinite = word.compare(mark + 3, 3, "inf") == 0;
    word = (word.starts_with('-') ? "-" : "") + std::string(infinite ? "inf" : "nan");
  }
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* const end = word.data() + word.size();
  double value = 0;
  const auto [stop, failure] = std::from_chars(begin, end, value);
  if (stop != end || begin == end || failure == std::errc::invalid_argument) return std::nullopt;
  if (failure == std::errc::result_out_of_range) {
    // 1e999 and 1e-999: from_chars leaves the value alone.
    const bool tiny = word.find("e-") != std::string::npos;
    value = tiny ? 0 : std::numeric_limits<double>::infinity();
    return word.starts_with('-') ? -value : value;
  }
  return value;
}

}  // namespace farhorizon
