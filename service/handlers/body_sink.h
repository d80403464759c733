#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "core/base/result.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// Where the pieces of a request's body go as they come in.
class BodySink {
 public:
  BodySink() = default;
  virtual ~BodySink() = default;
  BodySink(const BodySink&) = delete;
  BodySink& operator=(const BodySink&) = delete;

  /// Errors end the request: they are answered, and the connection is closed.
  virtual Status Write(std::string_view piece) = 0;
};

/// What a route says from a request's head alone, before its body is asked for: an answer already,
/// or a place for the body.
struct Admission {
  std::optional<HttpResponse> answer;
  std::unique_ptr<BodySink> sink;
};

}  // namespace farhorizon
