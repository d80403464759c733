#pragma once

#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// Waits as long as the file `input` says (as of WriteEchoTask), then writes its outputs and their
/// manifest into the folder `output`.
/// Errors: as ReadFile, WriteFile and ReadEchoTask; kUnsupportedData where base64 is none.
Status RunEcho(const std::string& input, const std::string& output);

}  // namespace farhorizon
