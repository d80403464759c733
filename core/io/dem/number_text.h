#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace farhorizon {

/// `value` in the fewest digits that read back as it, or as the float that it is: "-32767",
/// "-3.4028235e+38", "-inf".
std::string NumberText(double value);

/// The number that a tag's `text` is, and nothing else, whatever its case: also with a decimal
/// comma, "nan" and "inf", and Windows' "-1.#IND" and "1.#INF". nullopt for other words.
std::optional<double> ParseTagNumber(std::string_view text);

}  // namespace farhorizon
