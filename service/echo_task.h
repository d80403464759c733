#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// One output of an echo: what came in under its name.
struct EchoOutput {
  std::string name;
  std::string media_type;
  std::string text;
  bool base64 = false;  ///< whether the text stands for bytes
};

/// What the process `echo` is asked for.
struct EchoTask {
  int pause_seconds = 0;  ///< before it answers
  std::vector<EchoOutput> outputs = {};
};

/// The input file of an echo's worker.
std::string WriteEchoTask(const EchoTask& task);
/// The inverse of WriteEchoTask. Errors: kUnsupportedData.
Result<EchoTask> ReadEchoTask(const std::string& text);

}  // namespace farhorizon
