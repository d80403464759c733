#include "service/s3/s3_bucket.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <optional>
#include <unistd.h>
#include <utility>

#include "core/io/posix_file.h"
#include "service/s3/s3_xml.h"

namespace farhorizon {

namespace {

using std::chrono::milliseconds;

// A part is what is sent again where a connection breaks: a second of a good line.
constexpr std::int64_t kPartBytes = std::int64_t{16} << 20U;
constexpr std::int64_t kLargestPut = 2 * kPartBytes;
constexpr std::int64_t kMostParts = 9000;  // of 10,000 that S3 takes
constexpr std::size_t kMostDeletes = 1000;
constexpr milliseconds kProbeTime{2000};
constexpr milliseconds kAsLongAsBytesMove{0};
// Amazon joins the parts of a large object while it answers.
constexpr std::chrono::seconds kJoinTime{120};

Error Unexpected(const S3Request& request, const S3Answer& answer) {
  const std::optional<S3Fault> fault = ReadS3Fault(answer.body);
  return {ErrorCode::kIo,
          request.method + " " + request.key + ": the storage of objects answered " +
              std::to_string(answer.status) + (fault ? " " + fault->code : ""),
          "storage"};
}

bool IsNoSuchKey(const S3Answer& answer) {
  if (answer.status != 404) return false;
  const std::optional<S3Fault> fault = ReadS3Fault(answer.body);
  return fault && fault->code == "NoSuchKey";
}

std::int64_t PartBytes(std::int64_t bytes) { return std::max(kPartBytes, bytes / kMostParts + 1); }

// The value of a query, as it is signed [SigV4].
std::string Escaped(const std::string& text) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string escaped;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '.' || c == '_' || c == '~';
    const auto byte = static_cast<unsigned char>(c);
    if (plain) {
      escaped += c;
    } else {
      escaped += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
    }
  }
  return escaped;
}

bool Restart(int fd) { return ::ftruncate(fd, 0) == 0 && ::lseek(fd, 0, SEEK_SET) == 0; }

}  // namespace

Result<S3Answer> S3Bucket::Ask(const S3Request& request) {
  Result<S3Answer> answer = client_.Send(request);
  if (!answer || answer->status == 200) return answer;
  if (IsNoSuchKey(*answer)) return Error{ErrorCode::kNotFound, "no such object"};
  return Unexpected(request, *answer);
}

Status S3Bucket::Do(const S3Request& request) {
  Result<S3Answer> answer = Ask(request);
  return answer ? Status(Ok{}) : std::move(answer.error());
}

Status S3Bucket::PutText(const std::string& key, const std::string& text) {
  return Do({.method = "PUT", .key = Key(key), .body = text});
}

Status S3Bucket::TryPutText(const std::string& key, const std::string& text) {
  return Do({.method = "PUT", .key = Key(key), .body = text, .most = kProbeTime, .once = true});
}

Result<bool> S3Bucket::PutNewText(const std::string& key, const std::string& text) {
  const S3Request request{
      .method = "PUT", .key = Key(key), .headers = {"If-None-Match: *"}, .body = text};
  Result<S3Answer> answer = client_.Send(request);
  if (!answer) return std::move(answer.error());
  if (answer->status == 200) return true;
  if (answer->status == 412) return false;
  return Unexpected(request, *answer);
}

Result<std::string> S3Bucket::GetText(const std::string& key) {
  Result<S3Answer> answer = Ask({.key = Key(key)});
  if (!answer) return std::move(answer.error());
  return std::move(answer->body);
}

Status S3Bucket::PutFile(const std::string& key, int fd, std::int64_t bytes) {
  if (bytes > kLargestPut) return PutParts(Key(key), fd, bytes);
  return Do({.method = "PUT",
             .key = Key(key),
             .file = FilePart{fd, 0, bytes},
             .most = kAsLongAsBytesMove});
}

Status S3Bucket::PutParts(const std::string& key, int fd, std::int64_t bytes) {
  const S3Request request{.method = "POST", .key = key, .query = "uploads="};
  Result<S3Answer> begun = Ask(request);
  if (!begun) return std::move(begun.error());
  const std::string id = ReadS3UploadId(begun->body);
  if (id.empty()) return Unexpected(request, *begun);
  const std::string upload = "uploadId=" + Escaped(id);
  Result<std::string> list = PutEachPart({.method = "PUT", .key = key}, upload, fd, bytes);
  Status stored = list ? Status(Ok{}) : Status(list.error());
  if (stored) {
    stored = Do({.method = "POST",
                 .key = key,
                 .query = upload,
                 .body = *list,
                 .most = kJoinTime,
                 .silence = kJoinTime});
  }
  if (!stored) {
    (void)client_.Send({.method = "DELETE", .key = key, .query = upload, .once = true});
  }
  return stored;
}

Result<std::string> S3Bucket::PutEachPart(S3Request request, const std::string& upload, int fd,
                                          std::int64_t bytes) {
  const std::int64_t part_bytes = PartBytes(bytes);
  std::string list = "<CompleteMultipartUpload>";
  std::int64_t number = 1;
  for (std::int64_t offset = 0; offset < bytes; offset += part_bytes, ++number) {
    request.query = "partNumber=" + std::to_string(number) + "&" + upload;
    request.file = FilePart{fd, offset, std::min(part_bytes, bytes - offset)};
    request.most = kAsLongAsBytesMove;
    Result<S3Answer> answer = Ask(request);
    if (!answer) return std::move(answer.error());
    if (answer->etag.empty()) return Unexpected(request, *answer);
    list += "<Part><PartNumber>" + std::to_string(number) + "</PartNumber><ETag>" + answer->etag +
            "</ETag></Part>";
  }
  return list + "</CompleteMultipartUpload>";
}

Status S3Bucket::GetFile(const std::string& key, int fd) {
  Status written = Ok{};
  const auto take = [&](std::string_view piece) {
    const bool good = piece.empty() ? Restart(fd) : WriteAll(fd, piece);
    if (!good) {
      written = ErrorFromErrno("write a copy of an object", errno);
      written.error().kind = "storage";
      if (written.error().code == ErrorCode::kResourceExhausted) written.error().kind = "no-space";
    }
    return good;
  };
  const S3Request request{.key = Key(key), .sink = take, .most = kAsLongAsBytesMove};
  if (!Restart(fd)) return Error{ErrorCode::kIo, "cut a file", "storage"};
  Status got = Do(request);
  return written ? got : written;
}

Status S3Bucket::Copy(const std::string& from, const std::string& to) {
  return Do({.method = "PUT",
             .key = Key(to),
             .headers = {"x-amz-copy-source: /" + client_.location().bucket + "/" + Key(from)},
             .most = kJoinTime,
             .silence = kJoinTime});
}

Status S3Bucket::Delete(const std::string& key) {
  const S3Request request{.method = "DELETE", .key = Key(key)};
  Result<S3Answer> answer = client_.Send(request);
  if (!answer) return std::move(answer.error());
  const bool gone = answer->status / 100 == 2 || IsNoSuchKey(*answer);
  return gone ? Status(Ok{}) : Unexpected(request, *answer);
}

Status S3Bucket::DeleteAll(const std::vector<std::string>& keys) {
  for (std::size_t at = 0; at < keys.size(); at += kMostDeletes) {
    std::string body = "<Delete><Quiet>true</Quiet>";
    for (std::size_t i = at; i < std::min(keys.size(), at + kMostDeletes); ++i) {
      body += "<Object><Key>" + Key(keys[i]) + "</Key></Object>";
    }
    Status deleted = Do({.method = "POST", .query = "delete=", .body = body + "</Delete>"});
    if (!deleted) return deleted;
  }
  return Ok{};
}

Result<std::vector<std::string>> S3Bucket::List(const std::string& folder) {
  const std::string prefix = Key(folder);
  std::vector<std::string> names;
  // The last key of a page, where the next one goes on: unlike a token, it needs no escapes.
  std::string last;
  for (;;) {
    const std::string after = last.empty() ? "" : "&start-after=" + last;
    const S3Request request{.query = "list-type=2&prefix=" + Escaped(prefix) + after};
    Result<S3Answer> answer = Ask(request);
    if (!answer) return std::move(answer.error());
    std::optional<S3Page> page = ReadS3Page(answer->body);
    if (!page) return Unexpected(request, *answer);
    for (const std::string& key : page->keys) {
      if (key.rfind(prefix, 0) == 0) names.push_back(key.substr(prefix.size()));
    }
    if (!page->more || page->keys.empty()) return names;
    last = Escaped(page->keys.back());
  }
}

}  // namespace farhorizon
