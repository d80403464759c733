#include "tests/support/http_stub.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sys/socket.h>
#include <sys/time.h>
#include <utility>

namespace farhorizon {

namespace {

// The head and the body that its Content-Length tells of; what came where the client stops before.
std::string ReadRequest(int client) {
  std::string request;
  std::array<char, 4096> piece{};
  for (;;) {
    const std::size_t end = request.find("\r\n\r\n");
    if (end != std::string::npos) {
      const std::size_t field = request.find("Content-Length: ");
      const std::size_t body =
          field < end ? std::strtoul(request.c_str() + field + 16, nullptr, 10) : 0;
      if (request.size() >= end + 4 + body) return request;
    }
    const ssize_t got = ::recv(client, piece.data(), piece.size(), 0);
    if (got <= 0) return request;
    request.append(piece.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

void HttpStub::AnswerEach(std::vector<std::string> responses) {
  const std::lock_guard lock(mutex_);
  answers_ = std::move(responses);
}

void HttpStub::Before(std::function<bool(int client)> work) {
  const std::lock_guard lock(mutex_);
  before_ = std::move(work);
}

std::vector<std::string> HttpStub::requests() const {
  const std::lock_guard lock(mutex_);
  return requests_;
}

std::string HttpStub::Response(int status, const std::string& body, const std::string& fields) {
  return "HTTP/1.1 " + std::to_string(status) +
         " X\r\nContent-Length: " + std::to_string(body.size()) + "\r\nConnection: close\r\n" +
         fields + "\r\n" + body;
}

void HttpStub::Serve(int client) {
  // So that the test's end waits for nobody.
  const struct timeval most { 5, 0 };
  ::setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
  const std::string request = ReadRequest(client);
  std::function<bool(int)> before;
  std::string answer;
  {
    const std::lock_guard lock(mutex_);
    requests_.push_back(request);
    before = before_;
    if (!answers_.empty()) answer = answers_.front();
    if (answers_.size() > 1) answers_.erase(answers_.begin());
  }
  if (before && before(client)) return;
  for (std::size_t sent = 0; sent < answer.size();) {
    const ssize_t size = ::send(client, answer.data() + sent, answer.size() - sent, MSG_NOSIGNAL);
    if (size <= 0) return;
    sent += static_cast<std::size_t>(size);
  }
}

}  // namespace farhorizon
