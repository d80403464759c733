#include "service/http/client.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <string_view>

#include "service/asio.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

namespace {

using asio::ip::tcp;
using boost::system::error_code;

// For each wait; the service reads an uploaded raster before it answers.
constexpr std::chrono::seconds kPatience{60};
constexpr std::size_t kPieceBytes = 65536;
constexpr std::uint64_t kLargestText = std::uint64_t{64} << 20U;

// One connection, for one request and its response.
class ClientConnection {
 public:
  ClientConnection(const ServiceUrl& url, const ClientRequest& request)
      : url_(url), request_(request), stream_(context_) {}

  Result<ClientResponse> Run(const std::stop_token& stop) {
    Result<ClientResponse> result = Broken("nothing happened", {});
    const std::stop_callback cut(stop,
                                 [this] { asio::post(context_, [this] { context_.stop(); }); });
    asio::co_spawn(
        context_, [&]() -> asio::awaitable<void> { result = co_await Talk(); },
        [](const std::exception_ptr& bug) {
          if (bug) std::rethrow_exception(bug);
        });
    context_.run();
    if (stop.stop_requested()) return Error{ErrorCode::kCancelled, "interrupted"};
    return result;
  }

 private:
  [[nodiscard]] Error Broken(const std::string& doing, const error_code& failure) const {
    return {ErrorCode::kIo,
            "http://" + url_.host + ":" + std::to_string(url_.port) + ": cannot " + doing +
                (failure ? ": " + failure.message() : ""),
            "connection"};
  }

  asio::awaitable<Result<ClientResponse>> Talk() {
    error_code failure;
    tcp::resolver resolver(context_);
    const auto found =
        co_await resolver.async_resolve(url_.host, std::to_string(url_.port), Into(failure));
    if (failure) co_return Broken("find the host", failure);
    stream_.expires_after(kPatience);
    co_await stream_.async_connect(found, Into(failure));
    if (failure) co_return Broken("connect", failure);
    Status sent = co_await SendHead();
    if (sent && request_.upload) sent = co_await SendUpload();
    // The service may refuse before the whole body is sent: read its response even if sending
    // failed.
    Result<ClientResponse> response = co_await Receive();
    if (!response && !sent) co_return std::move(sent.error());
    co_return response;
  }

  asio::awaitable<Status> SendHead() {
    const bool literal = url_.host.find(':') != std::string::npos;
    std::string head = request_.method + " " + url_.prefix + request_.target +
                       " HTTP/1.1\r\nHost: " + (literal ? "[" + url_.host + "]" : url_.host) + ":" +
                       std::to_string(url_.port) +
                       "\r\nUser-Agent: farhorizon\r\nAccept: */*\r\nConnection: close\r\n";
    for (const auto& [name, value] : request_.headers)
      head.append(name).append(": ").append(value).append("\r\n");
    if (const std::uintmax_t have = Have(); have > 0) {
      head +=
          "Range: bytes=" + std::to_string(have) + "-\r\nIf-Range: " + request_.resumes + "\r\n";
    }
    if (request_.upload) {
      error_code none;
      std::error_code failure;
      total_ = std::filesystem::file_size(*request_.upload, failure);
      if (failure) co_return Broken("read " + request_.upload->filename().string(), none);
      head += "Content-Length: " + std::to_string(total_) + "\r\n";
    }
    head += "\r\n";
    error_code failure;
    co_await asio::async_write(stream_, asio::buffer(head), Into(failure));
    if (failure) co_return Broken("send", failure);
    co_return Ok{};
  }

  // Bytes of the download that are there.
  [[nodiscard]] std::uintmax_t Have() const {
    if (!request_.download || request_.resumes.empty()) return 0;
    std::error_code none;
    const std::uintmax_t size = std::filesystem::file_size(*request_.download, none);
    return none ? 0 : size;
  }

  // Opens the file for the body of this response, if it is for one.
  Status OpenDownload(const ClientResponse& response, std::ofstream& file) const {
    if (!request_.download || (response.status != 200 && response.status != 206)) return Ok{};
    const std::string from = "bytes " + std::to_string(Have()) + "-";
    if (response.status == 206 && !response.Header("content-range").starts_with(from)) {
      return Error{ErrorCode::kIo, "the service sent another part than it was asked for"};
    }
    file.open(*request_.download,
              std::ios::binary | (response.status == 206 ? std::ios::app : std::ios::trunc));
    if (file) return Ok{};
    return Error{ErrorCode::kIo, "cannot write " + request_.download->string()};
  }

  asio::awaitable<Status> SendUpload() {
    std::ifstream file(*request_.upload, std::ios::binary);
    std::string piece(kPieceBytes, '\0');
    for (std::uintmax_t sent = 0; sent < total_;) {
      file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
      const auto size = static_cast<std::size_t>(file.gcount());
      if (size == 0) co_return Broken("read the DEM: it has become shorter", {});
      error_code failure;
      stream_.expires_after(kPatience);
      co_await asio::async_write(stream_, asio::buffer(piece.data(), size), Into(failure));
      if (failure) co_return Broken("send", failure);
      sent += size;
      if (request_.uploaded) {
        request_.uploaded(static_cast<double>(sent) / static_cast<double>(total_));
      }
    }
    co_return Ok{};
  }

  asio::awaitable<Result<ClientResponse>> Receive() {
    http::response_parser<http::buffer_body> parser;
    parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // none is 0 in Beast 1.74
    if (request_.method == "HEAD") parser.skip(true);
    error_code failure;
    stream_.expires_after(kPatience);
    co_await http::async_read_header(stream_, buffer_, parser, Into(failure));
    if (failure) co_return Broken("read the answer", failure);
    ClientResponse response;
    response.status = static_cast<int>(parser.get().result_int());
    for (const auto& field : parser.get()) {
      response.headers[LowerCase(std::string(field.name_string()))] = std::string(field.value());
    }
    std::ofstream file;
    if (Status opened = OpenDownload(response, file); !opened) co_return std::move(opened.error());
    std::uintmax_t written = response.status == 206 ? Have() : 0;
    std::string piece(kPieceBytes, '\0');
    while (!parser.is_done() && file) {
      parser.get().body() = {piece.data(), piece.size(), true};
      stream_.expires_after(kPatience);
      co_await http::async_read_some(stream_, buffer_, parser, Into(failure));
      if (failure == http::error::need_buffer) failure = {};
      if (failure) co_return Broken("read the answer", failure);
      const std::size_t size = piece.size() - parser.get().body().size;
      if (file.is_open()) {
        written += size;
        if (written > request_.most_bytes) {
          co_return Error{ErrorCode::kIo, "the service sends more than it says there is",
                          "result-corrupt"};
        }
        file.write(piece.data(), static_cast<std::streamsize>(size));
      } else {
        response.body.append(piece, 0, size);
        if (response.body.size() > kLargestText) co_return Broken("read so long an answer", {});
      }
    }
    if (file.is_open()) file.close();
    if (!file) {
      co_return Error{ErrorCode::kIo, "cannot write " + request_.download->string()};
    }
    co_return response;
  }

  const ServiceUrl& url_;
  const ClientRequest& request_;
  asio::io_context context_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::uintmax_t total_ = 0;
};

}  // namespace

Result<ServiceUrl> ReadServiceUrl(const std::string& text) {
  const Error wrong{ErrorCode::kInvalidArgument,
                    "\"" + text + "\" is no URL of a service; write http://HOST:PORT",
                    "invalid-url"};
  constexpr std::string_view kScheme = "http://";
  if (std::string_view(text).substr(0, kScheme.size()) != kScheme) return wrong;
  std::string_view rest = std::string_view(text).substr(kScheme.size());
  ServiceUrl url;
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  url.prefix = rest.substr(slash);
  while (!url.prefix.empty() && url.prefix.back() == '/') url.prefix.pop_back();
  std::string_view authority = rest.substr(0, slash);
  const std::size_t colon = authority.rfind(':');
  if (colon != std::string_view::npos && authority.find(']', colon) == std::string_view::npos) {
    const char* end = authority.data() + authority.size();
    const auto [stop, failure] = std::from_chars(authority.data() + colon + 1, end, url.port);
    if (failure != std::errc() || stop != end || url.port == 0) return wrong;
    authority = authority.substr(0, colon);
  }
  if (authority.size() > 2 && authority.front() == '[' && authority.back() == ']') {
    authority = authority.substr(1, authority.size() - 2);
  }
  if (authority.empty() || authority.find_first_of("@?# ") != std::string_view::npos ||
      url.prefix.find_first_of("?# ") != std::string::npos) {
    return wrong;
  }
  url.host = authority;
  return url;
}

Result<ClientResponse> SendRequest(const ServiceUrl& url, const ClientRequest& request,
                                   const std::stop_token& stop) {
  return ClientConnection(url, request).Run(stop);
}

}  // namespace farhorizon
