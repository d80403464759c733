#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace farhorizon {

/// The boundary of a multipart/form-data Content-Type; nullopt where there is none or it breaks
/// RFC 2046's rules (1 to 70 of its characters).
std::optional<std::string> MultipartBoundary(std::string_view content_type);

/// One part's head.
struct PartHead {
  std::string name;
  std::optional<std::string> filename;
};

/// Where parts go. Errors of either end the parse.
struct PartReceiver {
  std::function<Status(const PartHead&)> begin;
  std::function<Status(std::string_view)> data;
};

/// Reads multipart/form-data (RFC 7578) piece by piece, in constant memory.
/// Errors: kInvalidArgument "invalid-multipart": no end, no name, a head of more than 8 KiB, more
///   than 16 parts, or bytes that belong to no part.
class MultipartParser {
 public:
  MultipartParser(const std::string& boundary, PartReceiver receiver);

  Status Feed(std::string_view piece);
  /// The body is at its end; was the form?
  Status Finish() const;

 private:
  enum class State { kStart, kAfterBoundary, kHead, kData, kEnd };

  /// Whether something was consumed and there may be more to do.
  Result<bool> Step();
  Result<bool> StepAfterBoundary();
  Result<bool> StepHead();
  Result<bool> StepData();

  std::string delimiter_;  ///< with the CRLF before it
  PartReceiver receiver_;
  State state_ = State::kStart;
  std::string buffer_;
  int parts_ = 0;
};

}  // namespace farhorizon
