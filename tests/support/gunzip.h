#pragma once

#include <string>
#include <string_view>

#include "core/io/gzip.h"

namespace farhorizon {

/// What the one member of a gzip file holds; empty where `bytes` is no whole one and nothing else.
inline std::string Gunzip(std::string_view bytes) {
  return Gunzip(bytes, std::size_t{1} << 30U).value_or("");
}

}  // namespace farhorizon
