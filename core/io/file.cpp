// Files are read in pieces and written beside their target, synced and renamed, so that neither a
// crash nor a full disk leaves half a file under the name. Messages name files without their
// folder.
#include "core/io/file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "core/io/sha256.h"

namespace farhorizon {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 16U;

std::string Quoted(const std::filesystem::path& path) {
  std::string quoted(1, '"');
  return quoted.append(path.filename().string()).append(1, '"');
}

// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool valid() const { return fd_ >= 0; }
  // Closes now; false where that failed (a late write error, on some file systems).
  bool Close() { return close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

Error FromErrno(const std::string& what, const std::filesystem::path& path, int number) {
  ErrorCode code = ErrorCode::kIo;
  if (number == ENOENT || number == ENOTDIR) code = ErrorCode::kNotFound;
  if (number == ENOSPC || number == EDQUOT || number == EFBIG) code = ErrorCode::kResourceExhausted;
  return {code, what + " \"" + path.filename().string() +
                    "\": " + std::generic_category().message(number)};
}

// Opens a regular file and calls `take` with its bytes, piece by piece, until one call fails.
template <typename Take>
Status ReadPieces(const std::filesystem::path& path, Take take) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.valid()) return FromErrno("cannot open", path, errno);
  struct stat about {};
  if (fstat(file.get(), &about) != 0) return FromErrno("cannot read", path, errno);
  if (!S_ISREG(about.st_mode)) {
    return Error{ErrorCode::kIo, Quoted(path) + " is not a regular file"};
  }
  std::vector<char> piece(kPieceBytes);
  for (;;) {
    const ssize_t got = read(file.get(), piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return FromErrno("cannot read", path, errno);
    if (got == 0) return Done{};
    if (Status taken = take(std::string_view(piece.data(), static_cast<std::size_t>(got)));
        !taken) {
      return taken;
    }
  }
}

Status WriteAll(int fd, const std::filesystem::path& path, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = write(fd, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return FromErrno("cannot write", path, errno);
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  return Done{};
}

// Writes and syncs `file`, which is renamed only when this has succeeded.
Status FillAndSync(Descriptor& file, const std::filesystem::path& path, std::string_view bytes) {
  if (Status written = WriteAll(file.get(), path, bytes); !written) return written;
  if (fchmod(file.get(), 0644) != 0) return FromErrno("cannot write", path, errno);
  if (fsync(file.get()) != 0) return FromErrno("cannot sync", path, errno);
  if (!file.Close()) return FromErrno("cannot close", path, errno);
  return Done{};
}

}  // namespace

Result<std::string> Sha256OfFile(const std::filesystem::path& path) {
  Sha256 sum;
  Status read = ReadPieces(path, [&](std::string_view piece) -> Status {
    sum.Add(piece);
    return Done{};
  });
  if (!read) return std::move(read.error());
  return sum.Finish();
}

Result<std::string> ReadFile(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  std::string bytes;
  Status read = ReadPieces(path, [&](std::string_view piece) -> Status {
    if (piece.size() > max_bytes - bytes.size()) {
      return Error{ErrorCode::kResourceExhausted, Quoted(path) + " has more than the " +
                                                      std::to_string(max_bytes) + " bytes allowed"};
    }
    bytes += piece;
    return Done{};
  });
  if (!read) return std::move(read.error());
  return bytes;
}

Status WriteFile(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::string beside = (folder / path.filename()).string() + ".XXXXXX";
  Descriptor file(mkostemp(beside.data(), O_CLOEXEC));
  if (!file.valid()) return FromErrno("cannot create", path, errno);
  if (Status filled = FillAndSync(file, path, bytes); !filled) {
    unlink(beside.c_str());
    return filled;
  }
  if (rename(beside.c_str(), path.c_str()) != 0) {
    const int number = errno;
    unlink(beside.c_str());
    return FromErrno("cannot put in place", path, number);
  }
  // The rename itself is durable only when the folder is synced; some file systems cannot.
  const Descriptor parent(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (parent.valid()) fsync(parent.get());
  return Done{};
}

}  // namespace farhorizon
