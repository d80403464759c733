#include "service/outgoing/outgoing_client.h"

#include <algorithm>
#include <cstring>
#include <netinet/in.h>
#include <optional>
#include <sys/socket.h>
#include <utility>

#include "core/base/lower.h"
#include "service/curl.h"
#include "service/text_list.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMostHeadBytes = 65536;
// Slower than that for so long is no transfer.
constexpr long kLeastBytesPerSecond = 1024;
constexpr long kSlowSeconds = 10;

std::optional<IpAddress> AddressOf(const curl_sockaddr& peer) {
  IpAddress bytes{};
  if (peer.family == AF_INET6) {
    struct sockaddr_in6 six {};
    std::memcpy(&six, &peer.addr, sizeof six);
    std::memcpy(bytes.data(), &six.sin6_addr, bytes.size());
    return bytes;
  }
  if (peer.family != AF_INET) return std::nullopt;
  struct sockaddr_in four {};
  std::memcpy(&four, &peer.addr, sizeof four);
  bytes[10] = bytes[11] = 0xFF;
  std::memcpy(bytes.data() + 12, &four.sin_addr, sizeof four.sin_addr);
  return bytes;
}

constexpr const char* kBlanks = " \t\r\n";

// One transfer. libcurl calls its members, by the functions below, in the thread that performs it.
class Transfer {
 public:
  Transfer(const OutgoingRequest& request, const AddressRules& rules, const std::stop_token& stop)
      : request_(request), rules_(rules), stop_(stop) {}

  Result<OutgoingResponse> Run() {
    CurlList headers;
    for (const std::string& header : Headers()) headers.Add(header);
    CurlList resolve;
    for (const std::string& address : request_.resolve) resolve.Add(address);
    SetRequest(headers.get(), resolve.get());
    SetBounds();
    SetCallbacks();
    const CURLcode code = curl_easy_perform(curl_.get());
    Note();
    if (error_) return *std::move(error_);
    // What comes after all that is wanted does not matter.
    if (code != CURLE_OK && !done_) return ErrorOf(code);
    return response_;
  }

  curl_socket_t Open(const curl_sockaddr& peer) {
    const std::optional<IpAddress> address = AddressOf(peer);
    if (!address || !rules_.Allow(*address)) {
      refused_ = true;
      return CURL_SOCKET_BAD;
    }
    tried_ = true;
    return ::socket(peer.family, peer.socktype | SOCK_CLOEXEC, peer.protocol);
  }

  bool TakeHead(std::string_view line) {
    head_bytes_ += line.size();
    if (head_bytes_ > kMostHeadBytes) return Fail("the head of the answer is longer than 64 KiB");
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return true;
    const std::string name = Lower(std::string(Trimmed(line.substr(0, colon), kBlanks)));
    const std::string_view value = Trimmed(line.substr(colon + 1), kBlanks);
    if (name == "location") response_.location = value;
    if (name == "content-encoding" && Lower(std::string(value)) != "identity") coding_ = value;
    return true;
  }

  bool Take(std::string_view piece) {
    Note();
    const bool wanted = request_.take && response_.status == 200;
    if (!wanted) return done_ = true, false;
    if (!coding_.empty()) {
      return Fail("the answer has the Content-Encoding " + Printable(coding_) +
                  ", though none was asked for");
    }
    response_.bytes += static_cast<std::int64_t>(piece.size());
    if (response_.bytes > request_.most_bytes) return TooLarge();
    Status taken = request_.take(piece);
    if (!taken) error_ = std::move(taken.error());
    return !error_;
  }

  [[nodiscard]] bool Stopped() const { return stop_.stop_requested(); }

 private:
  [[nodiscard]] std::vector<std::string> Headers() const {
    std::vector<std::string> headers = request_.headers;
    headers.emplace_back("Accept-Encoding: identity");
    headers.emplace_back("Expect:");  // a second's wait for most servers
    return headers;
  }

  void SetRequest(curl_slist* headers, curl_slist* resolve) {
    curl_.Set(CURLOPT_URL, request_.url.text.c_str());
    curl_.Set(CURLOPT_PATH_AS_IS, 1L);
    curl_.Set(CURLOPT_PROTOCOLS_STR, "http,https");
    curl_.Set(CURLOPT_DISALLOW_USERNAME_IN_URL, 1L);
    curl_.Set(CURLOPT_HTTP_VERSION, long{CURL_HTTP_VERSION_1_1});
    curl_.Set(CURLOPT_HTTP09_ALLOWED, 0L);
    curl_.Set(CURLOPT_USERAGENT, "farhorizon");
    curl_.Set(CURLOPT_HTTPHEADER, headers);
    if (resolve != nullptr) curl_.Set(CURLOPT_RESOLVE, resolve);
    if (request_.is_post) {
      curl_.Set(CURLOPT_POST, 1L);
      curl_.Set(CURLOPT_POSTFIELDSIZE_LARGE, static_cast<curl_off_t>(request_.body.size()));
      curl_.Set(CURLOPT_POSTFIELDS, request_.body.data());
    }
  }

  void SetBounds() {
    curl_.Set(CURLOPT_NOSIGNAL, 1L);
    curl_.Set(CURLOPT_QUICK_EXIT, 1L);  // a look-up of a name that takes longer is left to itself
    curl_.Set(CURLOPT_FOLLOWLOCATION, 0L);
    curl_.Set(CURLOPT_PROXY, "");  // none of the environment's
    curl_.Set(CURLOPT_NOPROXY, "*");
    curl_.Set(CURLOPT_NETRC, long{CURL_NETRC_IGNORED});
    curl_.Set(CURLOPT_SSL_VERIFYPEER, 1L);
    curl_.Set(CURLOPT_SSL_VERIFYHOST, 2L);
    curl_.Set(CURLOPT_FRESH_CONNECT, 1L);
    curl_.Set(CURLOPT_FORBID_REUSE, 1L);
    curl_.Set(CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(request_.connect_time.count()));
    curl_.Set(CURLOPT_TIMEOUT_MS, static_cast<long>(request_.time.count()));
    curl_.Set(CURLOPT_LOW_SPEED_LIMIT, kLeastBytesPerSecond);
    curl_.Set(CURLOPT_LOW_SPEED_TIME, kSlowSeconds);
    // By Content-Length; Take counts.
    if (request_.take) curl_.Set(CURLOPT_MAXFILESIZE_LARGE, curl_off_t{request_.most_bytes});
  }

  void SetCallbacks() {
    const auto open = +[](void* self, curlsocktype /*purpose*/, curl_sockaddr* peer) {
      return static_cast<Transfer*>(self)->Open(*peer);
    };
    curl_.Set(CURLOPT_OPENSOCKETFUNCTION, open);
    curl_.Set(CURLOPT_OPENSOCKETDATA, this);
    const auto head = +[](char* line, std::size_t one, std::size_t size, void* self) {
      return static_cast<Transfer*>(self)->TakeHead({line, one * size}) ? one * size : 0;
    };
    curl_.Set(CURLOPT_HEADERFUNCTION, head);
    curl_.Set(CURLOPT_HEADERDATA, this);
    const auto body = +[](char* piece, std::size_t one, std::size_t size, void* self) {
      return static_cast<Transfer*>(self)->Take({piece, one * size}) ? one * size : 0;
    };
    curl_.Set(CURLOPT_WRITEFUNCTION, body);
    curl_.Set(CURLOPT_WRITEDATA, this);
    const auto progress = +[](void* self, curl_off_t, curl_off_t, curl_off_t, curl_off_t) {
      return static_cast<Transfer*>(self)->Stopped() ? 1 : 0;
    };
    curl_.Set(CURLOPT_XFERINFOFUNCTION, progress);
    curl_.Set(CURLOPT_XFERINFODATA, this);
    curl_.Set(CURLOPT_NOPROGRESS, 0L);
  }

  // What libcurl knows by now.
  void Note() {
    long status = 0;
    curl_easy_getinfo(curl_.get(), CURLINFO_RESPONSE_CODE, &status);
    response_.status = static_cast<int>(status);
    const char* address = nullptr;
    curl_easy_getinfo(curl_.get(), CURLINFO_PRIMARY_IP, &address);
    if (address != nullptr) response_.address = address;
  }

  bool Fail(const std::string& why) {
    error_ = Failed(why);
    return false;
  }
  bool TooLarge() {
    error_ = Error{ErrorCode::kResourceExhausted,
                   "the linked file is larger than " + std::to_string(request_.most_bytes) +
                       " bytes, the most that is taken; link a smaller or compressed DEM",
                   "body-too-large"};
    return false;
  }
  [[nodiscard]] Error Failed(const std::string& why) const {
    return {ErrorCode::kIo, request_.url.host + ": " + why, "href-failed"};
  }

  [[nodiscard]] Error ErrorOf(CURLcode code) {
    if (code == CURLE_ABORTED_BY_CALLBACK && Stopped()) {
      return {ErrorCode::kCancelled, "the service is being stopped; try again soon", "draining"};
    }
    if (code == CURLE_FILESIZE_EXCEEDED) {
      TooLarge();
      return *error_;
    }
    if (refused_ && !tried_) {
      return {ErrorCode::kInvalidArgument,
              request_.url.host +
                  " has no address of the public internet, and others are not connected to",
              "href-not-allowed"};
    }
    if (code == CURLE_OPERATION_TIMEDOUT) {
      return {ErrorCode::kResourceExhausted,
              request_.url.host + " did not answer, or not fast enough, within " +
                  std::to_string(request_.time.count() / 1000) + " seconds",
              "href-timeout"};
    }
    return Failed(curl_easy_strerror(code));
  }

  const OutgoingRequest& request_;
  const AddressRules& rules_;
  const std::stop_token& stop_;
  CurlHandle curl_;
  OutgoingResponse response_;
  std::optional<Error> error_;
  std::string coding_;
  std::size_t head_bytes_ = 0;
  bool refused_ = false;  // an address
  bool tried_ = false;    // an address
  bool done_ = false;     // the rest is not wanted
};

}  // namespace

std::string Printable(std::string_view text) {
  std::string plain;
  for (const char c : text.substr(0, 200)) plain += c >= ' ' && c < '\x7f' ? c : '?';
  return plain;
}

Result<OutgoingResponse> SendOutgoing(const OutgoingRequest& request, const AddressRules& rules,
                                      const std::stop_token& stop) {
  return Transfer(request, rules, stop).Run();
}

}  // namespace farhorizon
