#pragma once

#include <filesystem>
#include <string>

namespace farhorizon {

/// What every call of GDAL in this folder stands inside: our few drivers registered (and no other,
/// no plug-in), settings of this thread that keep GDAL from opening or writing anything but the
/// file it is shown, and its complaints collected instead of printed.
///
/// The settings are those whose need was measured with hostile files: overview, mask and side-car
/// redirections, network names, PAM files.
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

  /// Called by GDAL's error handler.
  void Hear(const char* message);

 private:
  std::filesystem::path path_;
  std::string first_failure_;
};

}  // namespace farhorizon
