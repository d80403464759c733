#include "tests/support/s3_server.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <unistd.h>

#include <nlohmann/json.hpp>

namespace farhorizon {

namespace {

constexpr const char* kPython = "/usr/bin/python3";
constexpr const char* kBucket = "tests";

}  // namespace

bool S3Server::IsInstalled() { return ::access(kPython, X_OK) == 0; }

S3Server::S3Server() {
  MakeBucket(kBucket);
  Start();
}

void S3Server::Start() {
  const std::filesystem::path log = folder_ / "port";
  SpillFile(log, "");
  std::vector<std::string> words = {kPython, "-B", S3_SERVER, folder_.path().string()};
  if (port_ != 0) words.push_back(std::to_string(port_));
  process_ = std::make_unique<Process>(words, std::vector<std::string>(), log);
  for (int tries = 0; tries < 1000; ++tries) {
    const std::string text = SlurpFile(log);
    if (!text.empty() && text.back() == '\n') {
      port_ = static_cast<std::uint16_t>(std::stoi(text));
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  throw std::runtime_error("the S3 server does not start");
}

void S3Server::Kill() {
  process_->Signal(SIGKILL);
  process_->Wait();
}

std::vector<std::string> S3Server::Environment() const {
  return {"AWS_ENDPOINT_URL=" + Url(), "AWS_ACCESS_KEY_ID=test-key-id",
          "AWS_SECRET_ACCESS_KEY=test/secret+of-the-store"};
}

void S3Server::SetFaults(const std::string& json) const {
  if (Ask(port_, "POST", "/-/faults", "", json).status != 200) {
    throw std::runtime_error("the S3 server does not answer");
  }
}

int S3Server::Count(const std::string& method) const {
  return nlohmann::json::parse(Ask(port_, "GET", "/-/count").body).value(method, 0);
}

void S3Server::MakeBucket(const std::string& name) const {
  for (const char* part : {"objects", "uploads", "temp"}) {
    std::filesystem::create_directories(folder_.path() / name / part);
  }
}

std::vector<std::string> S3Server::Files(const std::string& what) const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / kBucket / what)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path S3Server::FileOf(const std::string& key) const {
  std::string name = key;
  std::replace(name.begin(), name.end(), '/', '~');
  return folder_.path() / kBucket / "objects" / name;
}

}  // namespace farhorizon
