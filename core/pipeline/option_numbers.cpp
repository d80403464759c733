#include "core/pipeline/option_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace farhorizon {

namespace {

// Up to here every whole number is a double, so that one written as a double is what it says.
constexpr double kLargestWholeDouble = 9007199254740992;  // 2^53

template <typename Number>
std::optional<Number> Read(std::string_view text) {
  // std::from_chars takes a minus alone.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number number = 0;
  const char* begin = text.data();
  const char* end = begin + text.size();
  const auto [stop, failure] = std::from_chars(begin, end, number);
  if (failure != std::errc() || stop != end) return std::nullopt;
  return number;
}

// The numbers of a list, each as `read` finds it.
template <typename Number>
std::optional<std::vector<Number>> ReadList(std::string_view text,
                                            std::optional<Number> (*read)(std::string_view)) {
  std::vector<Number> numbers;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    std::string_view part = text.substr(start, end - start);
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
    const std::optional<Number> number = read(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    start = end + 1;
  }
  return numbers;
}

}  // namespace

std::optional<double> NumberIn(std::string_view text) { return Read<double>(text); }

std::optional<std::int64_t> WholeNumberIn(std::string_view text) {
  if (const auto whole = Read<std::int64_t>(text)) return whole;
  const std::optional<double> number = NumberIn(text);
  const bool whole = number && *number == std::trunc(*number);
  if (!whole || std::abs(*number) > kLargestWholeDouble) return std::nullopt;
  return static_cast<std::int64_t>(*number);
}

std::optional<std::vector<double>> NumbersIn(std::string_view text) {
  return ReadList<double>(text, NumberIn);
}

std::optional<std::vector<std::int64_t>> WholeNumbersIn(std::string_view text) {
  return ReadList<std::int64_t>(text, WholeNumberIn);
}

}  // namespace farhorizon
