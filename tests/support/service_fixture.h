#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/json_schema.h"
#include "tests/support/service_process.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {

/// Hills of 20 x 20 posts, without a reference system.
inline std::string SmallGrid() {
  std::string text =
      "ncols 20\nnrows 20\nxllcorner 7\nyllcorner 46\ncellsize 0.001\nNODATA_value -9999\n";
  for (int i = 0; i < 400; ++i) {
    text += std::to_string(500 + (i * 37 + i / 20 * 53) % 101) + (i % 20 == 19 ? "\n" : " ");
  }
  return text;
}

/// The real program as a service on a free port of loopback, with a data folder of its own.
class ServiceE2e : public testing::Test {
 protected:
  void Start(std::vector<std::string> settings = {}) {
    std::filesystem::remove(folder_ / "log");
    settings.push_back("SECRET=1");
    service_ = std::make_unique<Process>(Command(), settings, folder_ / "log");
    port_ = PortOf(folder_ / "log");
    ASSERT_NE(port_, 0) << SlurpFile(folder_ / "log");
  }
  /// The words that start the service.
  [[nodiscard]] std::vector<std::string> Command() const {
    return {FARHORIZON_PROGRAM, "serve",  "--listen",
            "127.0.0.1:0",      "--data", (folder_ / "data").string()};
  }
  void StartStandIn(std::vector<std::string> settings = {}) {
    settings.push_back(std::string("FARHORIZON_WORKER_PROGRAM=") + STAND_IN_WORKER);
    Start(std::move(settings));
  }
  /// The path of a new job. name: of its file; further parameters may follow it, "a.asc&levels=1".
  std::string Submit(const std::string& name, const std::string& headers = "",
                     const std::string& body = SmallGrid()) {
    const RawAnswer answer = Ask(port_, "POST", "/jobs?crs=EPSG:4326&filename=" + name,
                                 "Content-Type: application/octet-stream\r\n" + headers, body);
    EXPECT_EQ(answer.status, 201) << answer.head << answer.body;
    return answer.status == 201 ? "/jobs/" + nlohmann::json::parse(answer.body).value("jobID", "")
                                : "";
  }
  nlohmann::json StatusOf(const std::string& path) {
    const RawAnswer answer = Ask(port_, "GET", path);
    return answer.status == 200 ? nlohmann::json::parse(answer.body) : nlohmann::json();
  }
  std::string WaitFor(const std::string& path, const std::set<std::string>& states,
                      std::chrono::seconds most = std::chrono::seconds(120)) {
    const auto deadline = std::chrono::steady_clock::now() + most;
    const nlohmann::json shape = nlohmann::json::parse(
        SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/schemas/status-info.schema.json"));
    std::string state;
    while (std::chrono::steady_clock::now() < deadline) {
      const nlohmann::json info = StatusOf(path);
      state = info.is_object() ? info.value("status", "") : "none";
      if (info.is_object()) {
        EXPECT_THAT(SchemaOffences(info, shape), testing::IsEmpty()) << info;
      }
      if (states.count(state) != 0) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return state;
  }
  std::string WaitForEnd(const std::string& path) {
    return WaitFor(path, {"successful", "failed", "dismissed"});
  }
  std::string FailureOf(const std::string& path) {
    return nlohmann::json::parse(Ask(port_, "GET", path + "/results").body).value("code", "");
  }
  int Run(std::vector<std::string> words) {
    words.insert(words.begin(), FARHORIZON_PROGRAM);
    return Process(words, {}, folder_ / "stderr").Wait(std::chrono::seconds(300));
  }
  /// Entries of a folder of the service's data that stay. A job's end is seen before its working
  /// folder is gone, so there is a moment's grace.
  [[nodiscard]] std::size_t LeftOver(const char* sub) const {
    std::size_t count = 0;
    for (int tries = 0; tries < 100; ++tries) {
      const std::filesystem::directory_iterator entries(folder_ / "data" / sub);
      count = static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
      if (count == 0) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return count;
  }

  TempDir folder_;
  std::unique_ptr<Process> service_;
  std::uint16_t port_ = 0;
};

}  // namespace farhorizon
