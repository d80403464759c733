#include "service/http/request_head.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

namespace farhorizon {

namespace {

// Ten to the fifteenth fits an int64 and is more than any limit on bodies.
constexpr std::size_t kMaxLengthDigits = 15;

Problem Bad(const std::string& why) { return {"bad-request", why}; }

bool IsToken(std::string_view text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  };
  return !text.empty() && std::all_of(text.begin(), text.end(), allowed);
}

bool IsVisible(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c > 0x20 && c < 0x7F; });
}

bool IsFieldValue(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return c == '\t' || (c >= 0x20 && c < 0x7F); });
}

bool IsHost(std::string_view text) {
  return !text.empty() && text.size() <= 255 && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view(".-_:[]%").find(c) != std::string_view::npos;
  });
}

std::optional<Problem> ReadRequestLine(std::string_view line, const RequestHeadLimits& limits,
                                       HttpRequest& request) {
  const std::size_t first = line.find(' ');
  const std::size_t second = first == std::string_view::npos ? first : line.find(' ', first + 1);
  if (second == std::string_view::npos) return Bad("the request line is not METHOD TARGET VERSION");
  const std::string_view method = line.substr(0, first);
  const std::string_view target = line.substr(first + 1, second - first - 1);
  const std::string_view version = line.substr(second + 1);
  if (!IsToken(method) || method.size() > 20) return Bad("the method is no token");
  if (version != "HTTP/1.1" && version != "HTTP/1.0") {
    if (version.substr(0, 5) != "HTTP/") return Bad("the version is not HTTP/1.1");
    return Problem{"version-not-supported", "speak HTTP/1.1"};
  }
  if (target.size() > limits.target_bytes) {
    return Problem{"target-too-long",
                   "the target has more than " + std::to_string(limits.target_bytes) + " bytes"};
  }
  const bool asterisk = target == "*" && method == "OPTIONS";
  if (!asterisk && (target.empty() || target[0] != '/')) {
    return Bad("the target must start with a slash");
  }
  if (!IsVisible(target) || target.find('#') != std::string_view::npos) {
    return Bad("the target has characters that must be percent-encoded");
  }
  request.method = method;
  request.target = target;
  request.path = target.substr(0, target.find('?'));
  if (request.path.size() < target.size()) request.query = target.substr(request.path.size() + 1);
  request.version = version == "HTTP/1.1" ? 11 : 10;
  return std::nullopt;
}

std::optional<Problem> ReadField(std::string_view line, HttpRequest& request) {
  if (line[0] == ' ' || line[0] == '\t') return Bad("a header field is folded over two lines");
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || !IsToken(line.substr(0, colon))) {
    return Bad("a header field has no valid name before its colon");
  }
  const std::string_view value = Trimmed(line.substr(colon + 1));
  if (!IsFieldValue(value)) return Bad("a header field has characters other than visible ASCII");
  request.headers.emplace_back(LowerCase(line.substr(0, colon)), value);
  return std::nullopt;
}

std::optional<Problem> CheckOnce(const HttpRequest& request, std::string_view name) {
  const auto count = std::count_if(request.headers.begin(), request.headers.end(),
                                   [&](const auto& field) { return field.first == name; });
  if (count <= 1) return std::nullopt;
  return Bad("the field " + std::string(name) + " stands more than once");
}

// Where the body ends [RFC 9112, section 6.3]. No body if neither field is there.
std::optional<Problem> ReadFraming(HttpRequest& request) {
  const std::string* length = request.Header("content-length");
  const std::string* coding = request.Header("transfer-encoding");
  if (length != nullptr && coding != nullptr) {
    return Bad("Content-Length and Transfer-Encoding exclude each other");
  }
  if (coding != nullptr) {
    if (request.version == 10) return Bad("HTTP/1.0 knows no Transfer-Encoding");
    if (LowerCase(*coding) != "chunked") {
      return Problem{"transfer-encoding-not-implemented",
                     "the only Transfer-Encoding taken is chunked"};
    }
    request.chunked = true;
  }
  if (length != nullptr) {
    std::int64_t value = 0;
    const char* end = length->data() + length->size();
    const bool digits = !length->empty() && length->size() <= kMaxLengthDigits &&
                        length->find_first_not_of("0123456789") == std::string::npos;
    if (!digits || std::from_chars(length->data(), end, value).ptr != end) {
      return Bad("the Content-Length is no number, or too large");
    }
    request.content_length = value;
  }
  return std::nullopt;
}

std::optional<Problem> ReadConnection(HttpRequest& request) {
  request.keep_alive = request.version == 11;
  if (const std::string* connection = request.Header("connection")) {
    if (LowerCase(*connection).find("close") != std::string::npos) request.keep_alive = false;
  }
  if (const std::string* expect = request.Header("expect")) {
    if (LowerCase(*expect) != "100-continue") {
      return Problem{"expectation-failed", "the only expectation met is 100-continue"};
    }
    request.expects_continue = request.version == 11 && request.HasBody();
  }
  return std::nullopt;
}

std::optional<Problem> CheckFields(HttpRequest& request) {
  // Each of these fields decides where the request goes, where it ends or what it means.
  for (const std::string_view name :
       {"host", "content-length", "transfer-encoding", "content-type", "expect", "range",
        "if-range", "if-match", "if-none-match", "idempotency-key", "authorization",
        "tus-resumable", "upload-length", "upload-offset", "upload-defer-length", "upload-metadata",
        "upload-checksum", "x-http-method-override"}) {
    if (auto problem = CheckOnce(request, name)) return problem;
  }
  const std::string* host = request.Header("host");
  if (host == nullptr && request.version == 11) return Bad("the field Host is missing");
  if (host != nullptr && !IsHost(*host)) return Bad("the field Host names no host");
  if (auto problem = ReadFraming(request)) return problem;
  return ReadConnection(request);
}

}  // namespace

std::variant<HttpRequest, Problem> ReadRequestHead(std::string_view head,
                                                   const RequestHeadLimits& limits) {
  HttpRequest request;
  bool first = true;
  for (;;) {
    const std::size_t end = head.find("\r\n");
    if (end == std::string_view::npos) return Bad("the head is not whole");
    const std::string_view line = head.substr(0, end);
    head.remove_prefix(end + 2);
    if (line.find_first_of(std::string_view("\r\n\0", 3)) != std::string_view::npos) {
      return Bad("a line has a control character, or ends in other than CR LF");
    }
    if (first) {
      if (auto problem = ReadRequestLine(line, limits, request)) return *problem;
      first = false;
      continue;
    }
    if (line.empty()) break;
    if (request.headers.size() == limits.header_fields) {
      return Problem{
          "too-many-header-fields",
          "there are more than " + std::to_string(limits.header_fields) + " header fields"};
    }
    if (auto problem = ReadField(line, request)) return *problem;
  }
  if (auto problem = CheckFields(request)) return *problem;
  return request;
}

}  // namespace farhorizon
