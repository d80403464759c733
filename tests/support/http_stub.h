#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tests/support/loopback_server.h"

namespace farhorizon {

/// An HTTP server on loopback, at any of its addresses, that a test teaches its answers.
class HttpStub {
 public:
  HttpStub() {
    server_.Start([this](int client) { Serve(client); });
  }

  /// The bytes of the next answers, a whole response each: the last one from then on.
  void Answer(std::string response) { AnswerEach({std::move(response)}); }
  void AnswerEach(std::vector<std::string> responses);
  /// What else is done with each connection after its request, before the answer: true closes it.
  void Before(std::function<bool(int client)> work);

  /// The requests that came, heads with their bodies.
  [[nodiscard]] std::vector<std::string> requests() const;
  [[nodiscard]] int connections() const { return server_.connections(); }
  [[nodiscard]] std::uint16_t port() const { return server_.port(); }
  [[nodiscard]] std::string url(const std::string& path = "/") const {
    return "http://127.0.0.1:" + std::to_string(port()) + path;
  }

  /// A response with a length.
  static std::string Response(int status, const std::string& body = "",
                              const std::string& fields = "");

 private:
  void Serve(int client);

  mutable std::mutex mutex_;
  std::vector<std::string> answers_;
  std::vector<std::string> requests_;
  std::function<bool(int)> before_;
  LoopbackServer server_;
};

}  // namespace farhorizon
