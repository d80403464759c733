#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "core/base/result.h"
#include "service/jobs/coding.h"

namespace farhorizon {

/// Bytes in, the same compressed out. Neither a name nor a time is in it: same bytes, same result.
class Compressor {
 public:
  using Sink = std::function<Status(std::string_view piece)>;
  /// What has to be out when a call returns: what the compressor likes, all that is in, or the end.
  enum class Flush { kNone, kAll, kEnd };

  virtual ~Compressor() = default;

  /// Errors: those of the sink; kResourceExhausted "resource-exhausted" for want of memory.
  virtual Status Add(std::string_view bytes, Flush flush) = 0;
};

/// gzip takes 0.3 MiB and some 20 ms a MB, zstd 10 MiB and some 250.
/// Requires: `coding` is not kIdentity.
std::unique_ptr<Compressor> MakeCompressor(Coding coding, Compressor::Sink sink);

}  // namespace farhorizon
