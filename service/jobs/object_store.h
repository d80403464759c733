#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/unique_fd.h"

namespace farhorizon {

/// A stored object, open for reading from its start.
struct OpenObject {
  UniqueFd fd;
  std::int64_t bytes = 0;
};

struct StoredObject {
  std::string sha256;
  std::int64_t bytes = 0;
};

/// Write-once files named by their content: uploads and artifacts.
///
/// Properties, which the conformance suite holds every implementation to:
/// (1) What PutFile answered is durable and reads back byte for byte until Remove.
/// (2) An object is never seen in part. (3) Putting the same bytes twice stores them once.
/// Threads: safe; Remove of an object while it is put is the caller's to prevent.
class ObjectStore {
 public:
  ObjectStore() = default;
  virtual ~ObjectStore() = default;
  ObjectStore(const ObjectStore&) = delete;
  ObjectStore& operator=(const ObjectStore&) = delete;

  /// Takes the file in, leaving `file` absent or as it was. Requires: a regular file, no link.
  /// Errors: kIo, kResourceExhausted "no-space".
  virtual Result<StoredObject> PutFile(const std::filesystem::path& file) = 0;

  /// Errors: kNotFound.
  virtual Result<OpenObject> Open(const std::string& sha256) = 0;

  /// Puts the object where a program that must not see the store can read it, as `target`.
  virtual Status Materialise(const std::string& sha256, const std::filesystem::path& target) = 0;

  /// Absent ones are no error.
  virtual Status Remove(const std::string& sha256) = 0;
  virtual Result<std::vector<std::string>> List() = 0;
};

/// Whether `text` is a SHA-256 in lower-case hexadecimal.
bool IsSha256(const std::string& text);

}  // namespace farhorizon
