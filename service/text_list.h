#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace farhorizon {

/// The entries of a list with commas, without the blanks around them; empty ones are left out.
std::vector<std::string> CommaList(std::string_view text);

}  // namespace farhorizon
