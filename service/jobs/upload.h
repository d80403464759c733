#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// A DEM that comes in over several requests, each of which goes on where the one before ended.
/// Times are milliseconds since 1970.
struct Upload {
  std::string id;
  std::string owner;       ///< whose key it came with; empty: no key was asked for
  std::string client;      ///< whose limits it counts for: its owner, or the peer's address
  std::string filename;    ///< as SafeFilename gives it
  std::string media_type;  ///< what the client says of it; may be empty
  std::string metadata;    ///< all that the client says of it, as it was sent
  std::optional<std::int64_t> bytes;  ///< unset: the client says later how many
  std::int64_t offset = 0;            ///< bytes that are durable
  std::int64_t turn = 0;  ///< number of requests that wrote to it; identifies the one that may
  std::string sha256;     ///< of the object that has all of it; empty: it is in parts
  std::int64_t created_ms = 0;
  std::int64_t expires_ms = 0;

  [[nodiscard]] bool IsComplete() const { return bytes && *bytes == offset; }
};

/// A piece of an upload, an object.
struct UploadPart {
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
  std::string sha256;
};

/// How much uploads may take that no job has yet; of one whose length is not known that is `each`.
struct UploadBounds {
  std::int64_t all = 1000;
  std::int64_t of_client = 100;
  std::int64_t bytes = std::int64_t{1} << 36U;
  std::int64_t bytes_of_client = std::int64_t{1} << 34U;
  std::int64_t each = std::int64_t{1} << 31U;
};

struct UploadOptions {
  UploadBounds bounds;
  std::int64_t keep_seconds = 86400;  ///< after the last bytes that came, or the last job of it
};

/// The uploads that no job has yet, and the bytes of them that are there.
struct UploadCounts {
  std::int64_t uploads = 0;
  std::int64_t bytes = 0;
};

/// "no-such-upload".
Error NoSuchUpload();
/// "upload-offset-mismatch".
Error UploadOffsetMismatch();

}  // namespace farhorizon
