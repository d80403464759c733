#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/io/sha256.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// The SHA-256 of each 64 KiB of an object whose own SHA-256 was found right, and of which file.
struct PieceSums {
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  std::int64_t modified_ns = 0;
  std::vector<Digest> sums;
  /// Set where a piece was found changed since: the whole is to be read again.
  std::shared_ptr<std::atomic<bool>> broken = std::make_shared<std::atomic<bool>>(false);
};

/// kIo "result-corrupt": an artifact is not what was stored, or is gone.
Error ResultCorrupt();

/// An object of which no wrong byte can be read.
/// Threads: for one reader at a time.
class VerifiedObject {
 public:
  VerifiedObject(OpenObject object, std::shared_ptr<const PieceSums> sums)
      : object_(std::move(object)), sums_(std::move(sums)) {}

  [[nodiscard]] std::int64_t bytes() const { return object_.bytes; }

  /// Bytes from `offset` on: at least one, at most `most` and what is left of the piece that has
  /// them; valid until the next call. Requires: 0 <= offset < bytes(), most > 0.
  /// Errors: kIo "result-corrupt" where the piece is not what it was.
  Result<std::string_view> Read(std::int64_t offset, std::int64_t most);

 private:
  OpenObject object_;
  std::shared_ptr<const PieceSums> sums_;
  std::int64_t piece_ = -1;  ///< the one that `buffer_` has
  std::string buffer_;
};

/// Opens objects for readers who must not get a wrong byte. The first time in a process, and again
/// where the file was written to, the whole object is read before its first byte is given out; then
/// each piece is compared as it is read.
/// Threads: safe.
class ObjectVerifier {
 public:
  /// Errors: kIo "result-corrupt" where the bytes are not those of the name; "storage".
  Result<std::shared_ptr<VerifiedObject>> Open(OpenObject object, const std::string& sha256);

 private:
  std::shared_ptr<const PieceSums> Known(const std::string& sha256, const PieceSums& file);
  void Remember(const std::string& sha256, std::shared_ptr<const PieceSums> sums);

  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const PieceSums>> known_;
  std::int64_t remembered_ = 0;  ///< sums in `known_`
  // So that many who ask for one large object at once have it read once.
  std::array<std::mutex, 16> reading_;
};

}  // namespace farhorizon
