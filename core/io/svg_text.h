#pragma once

#include <string>

namespace farhorizon {

/// A tenth of a pixel, in the shortest text.
std::string SvgNumber(double value);

/// Any text, as it may stand between tags.
std::string SvgText(const std::string& text);

}  // namespace farhorizon
