// Files are read in pieces and written beside their target, synced and renamed, so that neither a
// crash nor a full disk leaves half a file under the name. Messages name files without their
// folder.
#include "core/io/file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include "core/io/posix_file.h"
#include "core/io/sha256.h"
#include "core/io/unique_fd.h"

namespace farhorizon {

namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 16U;

std::string Quoted(const std::filesystem::path& path) {
  std::string quoted(1, '"');
  return quoted.append(path.filename().string()).append(1, '"');
}

Error FromErrno(const std::string& what, const std::filesystem::path& path, int number) {
  Error error = ErrorFromErrno(what + " " + Quoted(path), number);
  if (number == ENOENT || number == ENOTDIR) error.code = ErrorCode::kNotFound;
  return error;
}

// Opens a regular file and calls `take` with its bytes, piece by piece, until one call fails.
template <typename Take>
Status ReadPieces(const std::filesystem::path& path, Take take) {
  const UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) return FromErrno("cannot open", path, errno);
  struct stat about {};
  if (::fstat(file.get(), &about) != 0) return FromErrno("cannot read", path, errno);
  if (!S_ISREG(about.st_mode)) {
    return Error{ErrorCode::kIo, Quoted(path) + " is not a regular file"};
  }
  std::vector<char> piece(kPieceBytes);
  for (;;) {
    const std::int64_t got = ReadSome(file.get(), piece);
    if (got < 0) return FromErrno("cannot read", path, errno);
    if (got == 0) return Ok{};
    if (Status taken = take(std::string_view(piece.data(), static_cast<std::size_t>(got)));
        !taken) {
      return taken;
    }
  }
}

// Writes and syncs `file`, which is renamed only when this has succeeded.
Status FillAndSync(UniqueFd& file, const std::filesystem::path& path, std::string_view bytes) {
  if (!WriteAll(file.get(), bytes)) return FromErrno("cannot write", path, errno);
  if (::fchmod(file.get(), 0644) != 0) return FromErrno("cannot write", path, errno);
  if (::fsync(file.get()) != 0) return FromErrno("cannot sync", path, errno);
  if (!file.Close()) return FromErrno("cannot close", path, errno);
  return Ok{};
}

}  // namespace

std::filesystem::path AbsolutePath(const std::filesystem::path& path) {
  std::error_code failure;
  const std::filesystem::path found = std::filesystem::absolute(path, failure);
  const std::filesystem::path absolute = (failure ? path : found).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

Result<std::string> Sha256OfFile(const std::filesystem::path& path) {
  Sha256 sum;
  Status read = ReadPieces(path, [&](std::string_view piece) -> Status {
    sum.Add(piece);
    return Ok{};
  });
  if (!read) return std::move(read.error());
  return sum.Finish().Hex();
}

Result<std::string> ReadFile(const std::filesystem::path& path, std::uintmax_t max_bytes) {
  std::string bytes;
  Status read = ReadPieces(path, [&](std::string_view piece) -> Status {
    if (piece.size() > max_bytes - bytes.size()) {
      return Error{ErrorCode::kResourceExhausted, Quoted(path) + " has more than the " +
                                                      std::to_string(max_bytes) + " bytes allowed"};
    }
    bytes += piece;
    return Ok{};
  });
  if (!read) return std::move(read.error());
  return bytes;
}

Status WriteFile(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::string beside = (folder / path.filename()).string() + ".XXXXXX";
  UniqueFd file(::mkostemp(beside.data(), O_CLOEXEC));
  if (!file) return FromErrno("cannot create", path, errno);
  if (Status filled = FillAndSync(file, path, bytes); !filled) {
    ::unlink(beside.c_str());
    return filled;
  }
  if (::rename(beside.c_str(), path.c_str()) != 0) {
    const int number = errno;
    ::unlink(beside.c_str());
    return FromErrno("cannot put in place", path, number);
  }
  // The rename itself is durable only when the folder is synced; some file systems cannot.
  [[maybe_unused]] const bool synced = SyncDirectory(folder);
  return Ok{};
}

}  // namespace farhorizon
