#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "service/handlers/part_head.h"

namespace farhorizon {

/// Takes what the parser finds. An error of either function ends the parse.
struct PartReceiver {
  std::function<Status(const PartHead&)> begin;  ///< called once for each part, in their order
  std::function<Status(std::string_view)> data;  ///< the next piece of the part begun last
};

/// Reads multipart/form-data [RFC 7578] piece by piece, in memory that does not grow with the body.
/// How the body is cut into pieces makes no difference to the parts.
/// Errors: kInvalidArgument "invalid-multipart": no closing boundary, a part without a name or with
///   a head of more than 8 KiB, more than 16 parts, or bytes before the first boundary.
class MultipartParser {
 public:
  MultipartParser(const std::string& boundary, PartReceiver receiver);

  Status Feed(std::string_view piece);
  /// Checks, after the last piece, that the closing boundary has come.
  Status Finish() const;

 private:
  enum class State { kStart, kAfterBoundary, kHead, kData, kEnd };

  /// True if something was consumed and another step may be possible without further bytes.
  Result<bool> Step();
  Result<bool> StepAfterBoundary();
  Result<bool> StepHead();
  Result<bool> StepData();

  std::string delimiter_;  ///< "\r\n--" and the boundary
  PartReceiver receiver_;
  State state_ = State::kStart;
  std::string buffer_;
  int parts_ = 0;
};

}  // namespace farhorizon
