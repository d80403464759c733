#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace farhorizon {

/// The weight of a parameter "q=0.5" in thousandths; nullopt for what is none [RFC 9110, section
/// 12.4.2].
std::optional<int> WeightOf(std::string_view parameter);

/// The items of a field such as Accept, in lower case and without parameters, with their weights in
/// thousandths: 1000 where none is given. An item whose weight cannot be read has 0.
std::vector<std::pair<std::string, int>> WeightedList(std::string_view field);

}  // namespace farhorizon
