#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace farhorizon {

/// `text` without what of `blanks` is at its ends.
std::string_view Trimmed(std::string_view text, const char* blanks = " \t");

/// The entries of a list with commas, without the blanks around them; empty ones are left out.
std::vector<std::string> CommaList(std::string_view text);

}  // namespace farhorizon
