#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/service_process.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {

/// The server of tests/support/s3_server.py, on a port of loopback, with the bucket "tests" in a
/// temporary folder; it ends with this object.
class S3Server {
 public:
  /// False where there is no python3: tests of it are skipped.
  static bool IsInstalled();

  S3Server();
  S3Server(const S3Server&) = delete;
  S3Server& operator=(const S3Server&) = delete;

  [[nodiscard]] std::string Url() const { return "http://127.0.0.1:" + std::to_string(port_); }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Variables for a service of the bucket: endpoint and keys.
  [[nodiscard]] std::vector<std::string> Environment() const;
  /// As the server's own description has it: "{}" for none.
  void SetFaults(const std::string& json) const;
  /// Requests so far with this method.
  [[nodiscard]] int Count(const std::string& method) const;
  void MakeBucket(const std::string& name) const;
  /// The files that are the objects of the bucket, or, of "uploads", its uploads in parts.
  [[nodiscard]] std::vector<std::string> Files(const std::string& what = "objects") const;
  [[nodiscard]] std::filesystem::path FileOf(const std::string& key) const;
  /// SIGKILL.
  void Kill();
  /// On the port that it had before.
  void Start();
  void Signal(int signal) const { process_->Signal(signal); }

 private:
  TempDir folder_;
  std::unique_ptr<Process> process_;
  std::uint16_t port_ = 0;
};

}  // namespace farhorizon
