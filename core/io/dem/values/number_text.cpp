#include "core/io/dem/values/number_text.h"

#include <array>
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

}  // namespace farhorizon
