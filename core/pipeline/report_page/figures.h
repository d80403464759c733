#pragma once

#include <cstdint>
#include <string>

namespace farhorizon {

/// Numbers as the page has them, for people; report.json has all digits.

/// "1,234,567".
std::string Grouped(std::int64_t value);

/// Three significant digits or all before the point, without exponent: "0.0123", "12.0", "1,234";
/// "0" for 0.
std::string ThreeDigits(double value);
/// The same, never below `value`: for what is an upper bound. Requires: value >= 0.
std::string ThreeDigitsUp(double value);

/// "312 B", "12.3 kB", "4.56 MB".
std::string ByteCount(std::int64_t bytes);

/// The same without zeros at the end: "12", "0.5".
std::string Shortest(double value);

/// "12.3 %"; "0 %" where the whole is 0.
std::string PercentOf(double part, double whole);

/// "1 edge", "1,234 edges".
std::string Counted(std::int64_t count, const std::string& one, const std::string& many);

}  // namespace farhorizon
