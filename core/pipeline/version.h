#pragma once

namespace farhorizon {

/// The project's version, from the top CMakeLists.txt, as artifacts and the program state it.
const char* Version();

}  // namespace farhorizon
