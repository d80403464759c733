#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace farhorizon {

/// The values of a query's or a form's parameters, by name.
using Parameters = std::map<std::string, std::string>;

/// `text` with every byte except the unreserved characters of [RFC 3986] as %XX.
std::string PercentEncode(std::string_view text);

/// The inverse of PercentEncode; nullopt if a % is not followed by two hexadecimal digits.
std::optional<std::string> PercentDecode(std::string_view text);

/// "a=1&b=2", percent-encoded, in the order of the names.
std::string EncodeQuery(const Parameters& parameters);

/// The inverse of EncodeQuery. lists: the names that may occur more than once; their values are
/// joined by commas. nullopt if a name is empty, or occurs twice and is not in `lists`, or if a
/// percent-encoding is broken.
///
/// A + in a value is what the client meant by it. It stands for itself [RFC 3986, section 2.2] to
/// clients that write a space as %20, and for a space to those that write queries as HTML forms do,
/// which write a plus as %2B. So in a value with %2B it is a space, else in one with %20 a plus. A
/// value with neither does not tell: there a plus is what begins it, or stands between codes
/// ("EPSG:4326+5773") or in the exponent of a number ("3.4e+38"); any other + is a space.
std::optional<Parameters> DecodeQuery(std::string_view query,
                                      const std::vector<std::string_view>& lists = {});

}  // namespace farhorizon
