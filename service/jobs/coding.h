#pragma once

#include <string_view>

namespace farhorizon {

/// A content coding [RFC 9110, section 8.4.1] that a result may be stored in.
enum class Coding { kIdentity, kGzip, kZstd };

/// "identity", "gzip" [RFC 1952], "zstd" [RFC 8878].
std::string_view CodingName(Coding coding);

}  // namespace farhorizon
