#include "service/s3/s3_transfer.h"

#include <algorithm>
#include <cerrno>
#include <unistd.h>
#include <utility>

#include "core/base/lower.h"
#include "core/io/base64.h"
#include "core/io/checksum.h"
#include "core/io/sha256.h"
#include "service/curl.h"
#include "service/text_list.h"

namespace farhorizon {

namespace {

constexpr long kConnectMs = 3000;
// A transfer that is slower than this has stalled.
constexpr long kLeastBytesPerSecond = 1024;
constexpr std::size_t kPieceBytes = std::size_t{1} << 18U;
constexpr std::size_t kMostIdle = 16;

// pread that fills as much as there is; -1 on failure.
ssize_t ReadAt(const FilePart& part, std::int64_t done, char* into, std::size_t most) {
  const auto left = static_cast<std::size_t>(part.bytes - done);
  for (;;) {
    const ssize_t size = ::pread(part.fd, into, std::min(most, left), part.offset + done);
    if (size >= 0 || errno != EINTR) return size;
  }
}

struct Sums {
  std::string sha256;              // hexadecimal
  std::optional<std::string> md5;  // base64; nullopt where the system's policy leaves it out
};

// nullopt where the file cannot be read, or is shorter than it was.
std::optional<Sums> SumsOf(const S3Request& request) {
  Sha256 sha256;
  std::optional<Checksum> md5 = Checksum::Named("md5");
  const auto add = [&](std::string_view piece) {
    sha256.Add(piece);
    if (md5) md5->Add(piece);
  };
  if (!request.file) {
    add(request.body);
  } else {
    std::string piece(kPieceBytes, '\0');
    for (std::int64_t done = 0; done < request.file->bytes;) {
      const ssize_t size = ReadAt(*request.file, done, piece.data(), piece.size());
      if (size <= 0) return std::nullopt;
      add(std::string_view(piece).substr(0, static_cast<std::size_t>(size)));
      done += size;
    }
  }
  Sums sums{sha256.Finish().Hex(), std::nullopt};
  if (md5) {
    const std::string sum = md5->Finish();
    sums.md5 = ToBase64({reinterpret_cast<const unsigned char*>(sum.data()), sum.size()});
  }
  return sums;
}

// What libcurl's callbacks read and write during one attempt.
struct Flow {
  const S3Request& request;
  CURL* curl;
  S3Answer& answer;
  std::int64_t sent = 0;
  bool begun = false;
  bool too_long = false;
  bool refused = false;  ///< by the sink, or by the file that is sent
};

std::size_t GiveBody(char* into, std::size_t size, std::size_t count, void* context) {
  auto& flow = *static_cast<Flow*>(context);
  const std::size_t most = size * count;
  if (flow.request.file) {
    const ssize_t read = ReadAt(*flow.request.file, flow.sent, into, most);
    flow.refused = read < 0;
    if (flow.refused) return CURL_READFUNC_ABORT;
    flow.sent += read;
    return static_cast<std::size_t>(read);
  }
  const auto at = static_cast<std::size_t>(flow.sent);
  const std::size_t piece = flow.request.body.copy(into, most, at);
  flow.sent += static_cast<std::int64_t>(piece);
  return piece;
}

// Where a kept connection turns out to be closed, libcurl sends the body again on a new one.
int Rewind(void* context, curl_off_t offset, int origin) {
  if (origin != SEEK_SET) return CURL_SEEKFUNC_CANTSEEK;
  static_cast<Flow*>(context)->sent = offset;
  return CURL_SEEKFUNC_OK;
}

std::size_t TakeBody(char* bytes, std::size_t size, std::size_t count, void* context) {
  auto& flow = *static_cast<Flow*>(context);
  const std::string_view piece(bytes, size * count);
  long status = 0;
  ::curl_easy_getinfo(flow.curl, CURLINFO_RESPONSE_CODE, &status);
  if (flow.request.sink && status == 200) {
    flow.refused = (!flow.begun && !flow.request.sink({})) || !flow.request.sink(piece);
    flow.begun = true;
    return flow.refused ? 0 : piece.size();
  }
  flow.too_long = flow.answer.body.size() + piece.size() > kMostAnswerBytes;
  if (flow.too_long) return 0;
  flow.answer.body += piece;
  return piece.size();
}

std::size_t TakeHeader(char* bytes, std::size_t size, std::size_t count, void* context) {
  const std::string_view line(bytes, size * count);
  const std::size_t colon = std::min(line.find(':'), line.size() - 1);
  if (Lower(std::string(line.substr(0, colon))) == "etag") {
    static_cast<Flow*>(context)->answer.etag = Trimmed(line.substr(colon + 1), " \t\r\n");
  }
  return line.size();
}

}  // namespace

class S3Transfer::Handle : public CurlHandle {
 public:
  void SetBody(Flow& flow);
  void SetLimits(const S3Request& request);
};

void S3Transfer::Handle::SetBody(Flow& flow) {
  Set(CURLOPT_WRITEFUNCTION, &TakeBody);
  Set(CURLOPT_WRITEDATA, static_cast<void*>(&flow));
  Set(CURLOPT_HEADERFUNCTION, &TakeHeader);
  Set(CURLOPT_HEADERDATA, static_cast<void*>(&flow));
  const std::string& method = flow.request.method;
  if (method == "GET") return;
  if (method == "DELETE") return Set(CURLOPT_CUSTOMREQUEST, "DELETE");
  const auto length = flow.request.file ? flow.request.file->bytes
                                        : static_cast<std::int64_t>(flow.request.body.size());
  Set(CURLOPT_UPLOAD, 1L);
  Set(CURLOPT_CUSTOMREQUEST, method.c_str());
  Set(CURLOPT_INFILESIZE_LARGE, static_cast<curl_off_t>(length));
  Set(CURLOPT_READFUNCTION, &GiveBody);
  Set(CURLOPT_READDATA, static_cast<void*>(&flow));
  Set(CURLOPT_SEEKFUNCTION, &Rewind);
  Set(CURLOPT_SEEKDATA, static_cast<void*>(&flow));
}

void S3Transfer::Handle::SetLimits(const S3Request& request) {
  Set(CURLOPT_NOSIGNAL, 1L);
  Set(CURLOPT_PROTOCOLS_STR, "http,https");
  Set(CURLOPT_FOLLOWLOCATION, 0L);
  Set(CURLOPT_CONNECTTIMEOUT_MS, kConnectMs);
  Set(CURLOPT_LOW_SPEED_LIMIT, kLeastBytesPerSecond);
  Set(CURLOPT_LOW_SPEED_TIME, static_cast<long>(request.silence.count()));
  Set(CURLOPT_TIMEOUT_MS, static_cast<long>(request.most.count()));
  Set(CURLOPT_BUFFERSIZE, static_cast<long>(kPieceBytes));
  Set(CURLOPT_UPLOAD_BUFFERSIZE, static_cast<long>(kPieceBytes));
}

S3Transfer::S3Transfer(std::string url, std::string region)
    : url_(std::move(url)), region_(std::move(region)) {}

S3Transfer::~S3Transfer() = default;

std::unique_ptr<S3Transfer::Handle> S3Transfer::Take() {
  const std::lock_guard lock(mutex_);
  if (idle_.empty()) return std::make_unique<Handle>();
  std::unique_ptr<Handle> handle = std::move(idle_.back());
  idle_.pop_back();
  return handle;
}

S3Answer S3Transfer::Attempt(const S3Request& request, const S3Keys& keys) {
  const std::optional<Sums> sums = SumsOf(request);
  if (!sums) return {-1, {}, "the file to be sent cannot be read"};
  S3Answer answer;
  std::unique_ptr<Handle> handle = Take();
  ::curl_easy_reset(handle->get());
  Flow flow{request, handle->get(), answer};
  CurlList headers;
  headers.Add("x-amz-content-sha256: " + sums->sha256);
  if (request.method == "PUT" || request.method == "POST") {
    if (sums->md5) headers.Add("Content-MD5: " + *sums->md5);
    headers.Add("Content-Type: application/octet-stream");
  }
  if (!keys.token.empty()) headers.Add("x-amz-security-token: " + keys.token);
  for (const std::string& header : request.headers) headers.Add(header);

  const std::string url = url_ + request.key + (request.query.empty() ? "" : "?" + request.query);
  const std::string signing = "aws:amz:" + region_ + ":s3";
  std::string words(CURL_ERROR_SIZE, '\0');
  handle->SetLimits(request);
  handle->SetBody(flow);
  handle->Set(CURLOPT_URL, url.c_str());
  handle->Set(CURLOPT_HTTPHEADER, headers.get());
  handle->Set(CURLOPT_AWS_SIGV4, signing.c_str());
  handle->Set(CURLOPT_USERNAME, keys.id.c_str());
  handle->Set(CURLOPT_PASSWORD, keys.secret.c_str());
  handle->Set(CURLOPT_ERRORBUFFER, words.data());
  const CURLcode ended = ::curl_easy_perform(handle->get());
  long status = 0;
  ::curl_easy_getinfo(handle->get(), CURLINFO_RESPONSE_CODE, &status);
  handle->Set(CURLOPT_ERRORBUFFER, nullptr);
  if (ended != CURLE_OK) {
    words.resize(std::min(words.find('\0'), words.size()));
    answer = {0, {}, words.empty() ? ::curl_easy_strerror(ended) : words};
    if (flow.too_long) answer.body = "the answer is too long";
    if (flow.refused) answer = {-1, {}, "this machine could not read or write its own file"};
    return answer;  // the connection goes with its handle
  }
  answer.status = static_cast<int>(status);
  const std::lock_guard lock(mutex_);
  if (idle_.size() < kMostIdle) idle_.push_back(std::move(handle));
  return answer;
}

}  // namespace farhorizon
