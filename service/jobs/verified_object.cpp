#include "service/jobs/verified_object.h"

#include <algorithm>
#include <cerrno>
#include <functional>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

// As much as is sent at a time; a request for one byte reads and hashes one piece.
constexpr std::int64_t kPieceBytes = 65536;
// 32 bytes for each 64 KiB: 16 MiB of sums for 32 GiB of results. Beyond that, all are found anew.
constexpr std::int64_t kMostSums =
    (std::int64_t{16} << 20U) / static_cast<std::int64_t>(Digest::kBytes);

Digest SumOf(std::string_view bytes) {
  Sha256 sum;
  sum.Add(bytes);
  return sum.Finish();
}

// Fills `into` with the bytes from `offset` on; false where there are fewer.
bool ReadAt(int fd, std::int64_t offset, std::string& into) {
  std::size_t done = 0;
  while (done < into.size()) {
    const ssize_t size = ::pread(fd, into.data() + done, into.size() - done,
                                 offset + static_cast<std::int64_t>(done));
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return false;
    done += static_cast<std::size_t>(size);
  }
  return true;
}

std::size_t PieceSize(std::int64_t piece, std::int64_t bytes) {
  return static_cast<std::size_t>(std::min(kPieceBytes, bytes - piece * kPieceBytes));
}

// The file of the object, without its sums.
Result<PieceSums> FileOf(const OpenObject& object) {
  struct stat info {};
  if (::fstat(object.fd.get(), &info) != 0) return StorageError("look at an object");
  PieceSums file;
  file.device = info.st_dev;
  file.inode = info.st_ino;
  file.modified_ns = info.st_mtim.tv_sec * 1'000'000'000LL + info.st_mtim.tv_nsec;
  return file;
}

// Adds the sums of all pieces; false where the whole is not what its name says.
bool SumPieces(const OpenObject& object, const std::string& sha256, PieceSums& into) {
  Sha256 whole;
  std::string bytes;
  for (std::int64_t piece = 0; piece * kPieceBytes < object.bytes; ++piece) {
    bytes.resize(PieceSize(piece, object.bytes));
    if (!ReadAt(object.fd.get(), piece * kPieceBytes, bytes)) return false;
    whole.Add(bytes);
    into.sums.push_back(SumOf(bytes));
  }
  return whole.Finish().Hex() == sha256;
}

}  // namespace

Error ResultCorrupt() {
  return {ErrorCode::kIo, "this artifact is damaged or lost; submit the DEM again",
          "result-corrupt"};
}

Result<std::string_view> VerifiedObject::Read(std::int64_t offset, std::int64_t most) {
  const std::int64_t piece = offset / kPieceBytes;
  if (piece != piece_) {
    piece_ = -1;
    buffer_.resize(PieceSize(piece, object_.bytes));
    if (!ReadAt(object_.fd.get(), piece * kPieceBytes, buffer_) ||
        SumOf(buffer_) != sums_->sums.at(static_cast<std::size_t>(piece))) {
      *sums_->broken = true;
      return ResultCorrupt();
    }
    piece_ = piece;
  }
  const auto start = static_cast<std::size_t>(offset - piece * kPieceBytes);
  return std::string_view(buffer_).substr(start, static_cast<std::size_t>(most));
}

Result<std::shared_ptr<VerifiedObject>> ObjectVerifier::Open(OpenObject object,
                                                             const std::string& sha256) {
  Result<PieceSums> file = FileOf(object);
  if (!file) return std::move(file.error());
  const std::lock_guard lock(reading_.at(std::hash<std::string>()(sha256) % reading_.size()));
  std::shared_ptr<const PieceSums> sums = Known(sha256, *file);
  if (!sums) {
    if (!SumPieces(object, sha256, *file)) return ResultCorrupt();
    sums = std::make_shared<const PieceSums>(*std::move(file));
    Remember(sha256, sums);
  }
  return std::make_shared<VerifiedObject>(std::move(object), std::move(sums));
}

std::shared_ptr<const PieceSums> ObjectVerifier::Known(const std::string& sha256,
                                                       const PieceSums& file) {
  const std::lock_guard lock(mutex_);
  const auto found = known_.find(sha256);
  if (found == known_.end()) return nullptr;
  const PieceSums& known = *found->second;
  const bool same = known.device == file.device && known.inode == file.inode &&
                    known.modified_ns == file.modified_ns;
  return same && !*known.broken ? found->second : nullptr;
}

void ObjectVerifier::Remember(const std::string& sha256, std::shared_ptr<const PieceSums> sums) {
  const std::lock_guard lock(mutex_);
  const auto count = static_cast<std::int64_t>(sums->sums.size()) + 1;
  if (remembered_ + count > kMostSums) {
    known_.clear();
    remembered_ = 0;
  }
  remembered_ += count;
  known_[sha256] = std::move(sums);
}

}  // namespace farhorizon
