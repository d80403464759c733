#include "service/cli/command.h"

#include <cstdio>

namespace farhorizon {

int ReportError(const Error& error) {
  std::fprintf(stderr, "farhorizon: %s\n", error.message.c_str());
  switch (error.code) {
    case ErrorCode::kInvalidArgument:
      return kExitCall;
    case ErrorCode::kCancelled:
      return kExitInterrupted;
    case ErrorCode::kNotFound:
    case ErrorCode::kUnsupportedData:
    case ErrorCode::kResourceExhausted:
    case ErrorCode::kIo:
      return kExitData;
  }
  return kExitBug;
}

int ExitStatusOf(Status status) { return status ? kExitDone : ReportError(status.error()); }

}  // namespace farhorizon
