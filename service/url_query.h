#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace farhorizon {

/// The values of a query's or a form's parameters, by name.
using Parameters = std::map<std::string, std::string>;

/// `text` with every byte except the unreserved characters of [RFC 3986] as %XX.
std::string PercentEncode(std::string_view text);

/// The inverse of PercentEncode; nullopt if a % is not followed by two hexadecimal digits.
/// plus_is_space: + is read as a space, as in the query of an HTML form.
std::optional<std::string> PercentDecode(std::string_view text, bool plus_is_space);

/// "a=1&b=2", percent-encoded, in the order of the names.
std::string EncodeQuery(const Parameters& parameters);

/// The inverse of EncodeQuery; + is read as a space. nullopt if a name is empty or occurs twice, or
/// if a percent-encoding is broken.
std::optional<Parameters> DecodeQuery(std::string_view query);

}  // namespace farhorizon
