#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace farhorizon {

/// Parameters by name, as text.
using Parameters = std::map<std::string, std::string>;

/// Everything but RFC 3986's unreserved characters as %XX.
std::string PercentEncode(std::string_view text);

/// nullopt where a % is not followed by two hexadecimal digits. plus_is_space: as in forms.
std::optional<std::string> PercentDecode(std::string_view text, bool plus_is_space);

/// "a=1&b=2", by name.
std::string EncodeQuery(const Parameters& parameters);

/// nullopt where a name is empty or stands twice, or an escape is broken.
std::optional<Parameters> DecodeQuery(std::string_view query);

}  // namespace farhorizon
