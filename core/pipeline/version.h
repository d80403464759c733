#pragma once

namespace farhorizon {

/// The version that artifacts and the program name: the project's, from the top CMakeLists.txt.
const char* Version();

}  // namespace farhorizon
