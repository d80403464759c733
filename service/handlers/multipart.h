#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace farhorizon {

/// The boundary of a Content-Type multipart/form-data; nullopt if there is none, or if it is not
/// one to 70 of the characters that [RFC 2046, section 5.1.1] allows.
std::optional<std::string> MultipartBoundary(std::string_view content_type);

/// The head of a part [RFC 7578, section 4.2].
///
/// filename: as the client means it. A backslash escapes a quote or a backslash and is itself
/// before any other character, as in the paths that browsers on Windows send; %22, %0D and %0A are
/// what browsers write for a quote and the ends of lines; filename* comes before filename
/// [RFC 8187].
struct PartHead {
  std::string name;
  std::optional<std::string> filename;
  /// The part's Content-Encoding or Content-Transfer-Encoding; unset where its bytes are sent as
  /// they are.
  std::optional<std::string> coding;
};

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
