#pragma once

#include <filesystem>
#include <string>

namespace farhorizon {

/// The scope of every call of GDAL in this folder. While a session lives, only the few drivers of
/// this program are registered and no plug-in, settings of this thread keep GDAL from opening or
/// writing any file but the one at `path`, and its errors are collected instead of printed.
///
/// Each setting was found necessary with a hostile file: overview, mask and side-car redirections,
/// network names, PAM files.
/// Threads: one session a thread at a time.
class GdalSession {
 public:
  explicit GdalSession(const std::filesystem::path& path);
  ~GdalSession();
  GdalSession(const GdalSession&) = delete;
  GdalSession& operator=(const GdalSession&) = delete;

  /// " (GDAL: ...)" with the first failure since the last Forget, or "". Names no directory.
  [[nodiscard]] std::string Complaint() const;
  [[nodiscard]] bool Failed() const { return !first_failure_.empty(); }
  void Forget() { first_failure_.clear(); }

  /// For GDAL's error handler: keeps the first message.
  void Hear(const char* message);

 private:
  std::filesystem::path path_;
  std::string first_failure_;
};

}  // namespace farhorizon
