#include "service/http/request_log.h"

#include <string>
#include <vector>

#include "service/http/request_ids.h"
#include "service/log.h"

namespace farhorizon {

void LogRequest(const HttpRequest& request, const HttpResponse& response,
                std::chrono::nanoseconds took) {
  const auto took_ms = std::chrono::duration_cast<std::chrono::milliseconds>(took);
  std::vector<LogField> fields = {{"method", request.method},
                                  {"path", request.path},
                                  {"status", std::int64_t{response.status}},
                                  {"bytes", response.BodyBytes()},
                                  {"dur_ms", std::int64_t{took_ms.count()}},
                                  {"peer", request.peer},
                                  {"request_id", request.request_id}};
  const auto add = [&fields](std::string_view name, const std::string& value) {
    if (!value.empty()) fields.emplace_back(name, value);
  };
  add("key_id", request.caller.key_id);
  add("trace_id", TraceIdOf(request));
  add("job_id", response.job_id);
  add("upload_id", response.upload_id);
  add("code", response.code);
  const bool health =
      request.path == "/healthz" || request.path == "/readyz" || request.path == "/metrics";
  Log(health ? LogLevel::kDebug : LogLevel::kInfo, "request", fields);
}

}  // namespace farhorizon
