#include "core/base/result.h"

namespace farhorizon {

const char* ErrorCodeName(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return "invalid-argument";
    case ErrorCode::kNotFound:
      return "not-found";
    case ErrorCode::kUnsupportedData:
      return "unsupported-data";
    case ErrorCode::kResourceExhausted:
      return "resource-exhausted";
    case ErrorCode::kCancelled:
      return "cancelled";
    case ErrorCode::kIo:
      return "io";
  }
  return "unknown";
}

std::optional<ErrorCode> ErrorCodeFromName(std::string_view name) {
  for (const ErrorCode code :
       {ErrorCode::kInvalidArgument, ErrorCode::kNotFound, ErrorCode::kUnsupportedData,
        ErrorCode::kResourceExhausted, ErrorCode::kCancelled, ErrorCode::kIo}) {
    if (name == ErrorCodeName(code)) return code;
  }
  return std::nullopt;
}

Error Error::WithContext(const std::string& where) && {
  return {code, where + ": " + message, kind};
}

void Check(bool holds, const char* what, std::source_location where) {
  if (holds) return;
  throw InternalError(std::string(where.file_name()) + ":" + std::to_string(where.line()) + ": " +
                      what);
}

}  // namespace farhorizon
