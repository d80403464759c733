#pragma once

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

/// Reads the header fields of a part, without the empty line after them.
/// Errors: kInvalidArgument "invalid-multipart" where they name no part of a form.
Result<PartHead> ReadPartHead(std::string_view head);

/// "invalid-multipart": what is wrong with the form.
Error BrokenForm(const std::string& why);

}  // namespace farhorizon
