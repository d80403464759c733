#pragma once

#include <string>

namespace farhorizon {

/// `value` in the fewest digits that read back as it, or as the float that it is: "-32767",
/// "-3.4028235e+38", "-inf".
std::string NumberText(double value);

}  // namespace farhorizon
