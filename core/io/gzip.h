#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace farhorizon {

/// `bytes` as one member of gzip [RFC 1952], without a name or a time: same bytes, same result.
/// Errors: kResourceExhausted, kind "resource-exhausted", for want of memory.
Result<std::string> Gzip(std::string_view bytes);

}  // namespace farhorizon
