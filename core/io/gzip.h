#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace farhorizon {

/// `bytes` as one member of gzip [RFC 1952], without a name or a time: same bytes, same result.
/// Errors: kResourceExhausted, kind "resource-exhausted", for want of memory.
Result<std::string> Gzip(std::string_view bytes);

/// What the one member of a gzip file holds; nullopt where `bytes` is no whole one and nothing
/// else, or holds more than `most` bytes.
std::optional<std::string> Gunzip(std::string_view bytes, std::size_t most);

}  // namespace farhorizon
