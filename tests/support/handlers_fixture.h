#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/handlers/key_gate.h"
#include "service/handlers/problem.h"
#include "service/handlers/routes.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {

/// The service's router over a data directory of its own, without sockets and workers.
class HandlersTest : public testing::Test {
 protected:
  void SetUp() override {
    JobServiceOptions options = jobs_options_;
    options.data = folder_ / "data";
    options.workers = 0;  // nothing runs: jobs stay where the test puts them
    options.max_waiting = 2;
    options.min_free_bytes = 0;
    options.probe.max_bytes = -1;  // no worker looks at uploads
    auto opened = JobService::Open(options);
    ASSERT_TRUE(opened) << opened.error().message;
    jobs_ = *std::move(opened);
    router_ = std::make_unique<Router>(BuildRouter({*jobs_, "http://x", 1000}));
  }

  HttpResponse Send(const std::string& method, const std::string& target,
                    std::vector<std::pair<std::string, std::string>> headers = {},
                    const std::string& body = "") {
    HttpRequest request;
    request.method = method;
    request.target = target;
    request.path = target.substr(0, target.find('?'));
    if (request.path.size() < target.size()) request.query = target.substr(request.path.size() + 1);
    request.headers = std::move(headers);
    if (!body.empty()) request.content_length = static_cast<std::int64_t>(body.size());
    const Route* route = router_->Find(request);
    if (gate_) {
      if (auto refusal = gate_->Admit(request, route)) return *std::move(refusal);
    }
    Admission admission = router_->Begin(route, request);
    if (const auto* answer = std::get_if<HttpResponse>(&admission)) return *answer;
    Exchange& exchange = *std::get<std::unique_ptr<Exchange>>(admission);
    if (!body.empty()) {
      const Status taken = exchange.Take(body);
      if (!taken) {
        AbandonExchange(exchange, request);
        return ProblemResponse(request, ProblemOf(taken.error()));
      }
    }
    return FinishExchange(exchange, request);
  }
  HttpResponse Post(const std::string& target, const std::string& body,
                    const std::string& type = "image/tiff",
                    std::vector<std::pair<std::string, std::string>> more = {}) {
    more.emplace_back("content-type", type);
    return Send("POST", target, more, body);
  }
  static std::string CodeOf(const HttpResponse& response) {
    return nlohmann::json::parse(response.body).value("code", "");
  }
  static std::string FieldOf(const HttpResponse& response, const std::string& name) {
    for (const auto& [key, value] : response.headers) {
      if (key == name) return value;
    }
    return "";
  }
  /// Files of the data directory except those that a store without jobs has.
  [[nodiscard]] std::size_t FilesLeft() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      const bool own = name == "lock" || name == "reserve" || name == "identity" ||
                       name.find("jobs.sqlite") == 0;
      count += entry.is_regular_file() && !own ? 1 : 0;
    }
    return count;
  }

  const std::string tiff_{"II*\0....", 8};
  TempDir folder_;
  std::unique_ptr<JobService> jobs_;
  std::unique_ptr<Router> router_;
  JobServiceOptions jobs_options_;  ///< what a test sets before SetUp
  std::shared_ptr<KeyGate> gate_;   ///< set by tests with keys
};

}  // namespace farhorizon
