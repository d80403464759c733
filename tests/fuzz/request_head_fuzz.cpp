// libFuzzer's target: the reader of request heads. An accepted head keeps the rules of HttpRequest,
// is read alike after it is written again, and is framed alike by another reader, Beast's. Bytes
// are ASCII characters, or from 0x80 on the words of kWords: chance alone seldom writes a head that
// is accepted.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <string>
#include <string_view>
#include <variant>

#include "service/asio.h"
#include "service/http/request_head.h"
#include "service/url_query.h"

namespace {

using farhorizon::HttpRequest;

constexpr std::string_view kWords[] = {
    "POST /jobs HTTP/1.1\r\nHost: a\r\n",
    "GET /jobs?a=%41&b=+ HTTP/1.0\r\n",
    "OPTIONS * HTTP/1.1\r\n",
    " HTTP/1.1\r\n",
    "\r\n",
    "\r\n\r\n",
    "\r\n ",
    "Host: ",
    "Content-Length: ",
    "content-length:",
    "Content-Length: 5\r\n",
    "0123456789012345",
    "Transfer-Encoding: ",
    "transfer-encoding: chunked\r\n",
    "chunked",
    ", ",
    "identity",
    "Connection: ",
    "close",
    "keep-alive",
    "upgrade",
    "Upgrade: x\r\n",
    "Expect: 100-continue\r\n",
    "Content-Type: a\r\n",
};

std::string HeadFromBytes(const std::uint8_t* data, std::size_t size) {
  std::string head;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t word = data[i] - std::size_t{0x80};
    if (data[i] >= 0x80 && word < std::size(kWords)) {
      head += kWords[word];
    } else {
      head += static_cast<char>(data[i]);
    }
  }
  return head;
}

void Require(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "offence: " << what << std::endl;
  std::abort();
}

bool IsClean(std::string_view text) {
  return text.find_first_of(std::string_view("\r\n\0", 3)) == std::string_view::npos;
}

void CheckRules(const HttpRequest& request) {
  const bool origin = !request.target.empty() && request.target[0] == '/';
  Require(origin || (request.target == "*" && request.method == "OPTIONS"), "form of the target");
  Require(request.target == request.path || request.target == request.path + "?" + request.query,
          "path and query are the target");
  Require(!request.chunked || !request.content_length, "one framing");
  Require(request.content_length.value_or(0) >= 0, "no negative length");
  Require(request.headers.size() <= farhorizon::RequestHeadLimits().header_fields, "few fields");
  for (const char* once : {"host", "content-length", "transfer-encoding"}) {
    const auto is_it = [&](const auto& field) { return field.first == once; };
    Require(std::count_if(request.headers.begin(), request.headers.end(), is_it) <= 1,
            "fields that decide where a message goes or ends occur once");
  }
  for (const auto& [name, value] : request.headers) {
    Require(IsClean(name) && IsClean(value), "fields are of one line");
    Require(name == farhorizon::LowerCase(name), "names are in lower case");
    Require(value == farhorizon::Trimmed(value), "values have no blanks at their ends");
  }
}

std::string Written(const HttpRequest& request) {
  std::string head = request.method + " " + request.target +
                     (request.version == 11 ? " HTTP/1.1\r\n" : " HTTP/1.0\r\n");
  for (const auto& [name, value] : request.headers) head += name + ": " + value + "\r\n";
  return head + "\r\n";
}

void CheckWrittenAgain(const HttpRequest& request) {
  const auto again = farhorizon::ReadRequestHead(Written(request), {});
  const auto* same = std::get_if<HttpRequest>(&again);
  Require(same != nullptr, "a head that is written again is accepted");
  Require(same->method == request.method && same->target == request.target &&
              same->version == request.version && same->headers == request.headers &&
              same->content_length == request.content_length && same->chunked == request.chunked &&
              same->keep_alive == request.keep_alive,
          "a head that is written again is the same");
}

void CheckAgainstBeast(const std::string& head, const HttpRequest& request) {
  farhorizon::http::request_parser<farhorizon::http::empty_body> parser;
  boost::system::error_code failure;
  parser.put(farhorizon::asio::buffer(head), failure);
  if (failure || !parser.is_header_done()) return;  // refused: nothing to disagree about
  Require(parser.get().method_string() == request.method, "Beast reads the same method");
  Require(parser.get().target() == request.target, "Beast reads the same target");
  Require(parser.chunked() == request.chunked, "Beast sees the same coding");
  const auto length = parser.content_length();
  Require(length.has_value() == request.content_length.has_value() &&
              (!length || *length == static_cast<std::uint64_t>(*request.content_length)),
          "Beast sees the same length");
}

void CheckQuery(const std::string& query) {
  const auto parameters = farhorizon::DecodeQuery(query);
  if (!parameters) return;
  Require(farhorizon::DecodeQuery(farhorizon::EncodeQuery(*parameters)) == parameters,
          "a query that is written again is the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string head = HeadFromBytes(data, size);
  const auto read = farhorizon::ReadRequestHead(head, {});
  const auto* request = std::get_if<HttpRequest>(&read);
  if (request == nullptr) return 0;
  head.resize(head.find("\r\n\r\n") + 4);  // what follows is not of the head
  CheckRules(*request);
  CheckWrittenAgain(*request);
  CheckAgainstBeast(head, *request);
  CheckQuery(request->query);
  return 0;
}
