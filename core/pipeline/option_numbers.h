#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace farhorizon {

/// The number that the whole of `text` writes: a decimal with or without an exponent, inf or nan,
/// each with a sign of either kind or none. nullopt for any other text, and beyond the doubles.
std::optional<double> NumberIn(std::string_view text);

/// The whole number that `text` writes; also as 3.0 or 1e6, as programs do whose numbers are all
/// doubles. nullopt for any other text.
std::optional<std::int64_t> WholeNumberIn(std::string_view text);

/// The numbers of a list with commas and perhaps blanks between; nullopt if one is none.
std::optional<std::vector<double>> NumbersIn(std::string_view text);

/// Likewise, of whole numbers as WholeNumberIn reads them.
std::optional<std::vector<std::int64_t>> WholeNumbersIn(std::string_view text);

}  // namespace farhorizon
