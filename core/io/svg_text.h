#pragma once

#include <string>

namespace farhorizon {

/// The shortest text of `value` rounded to a tenth, of a pixel; never "-0".
std::string SvgNumber(double value);

/// `text` with the characters escaped that may not stand between tags.
std::string SvgText(const std::string& text);

}  // namespace farhorizon
