#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/io/manifest.h"

namespace farhorizon {

/// Writes artifacts into a folder, one by one, and their manifest last. The destructor removes what
/// was written, and the folder if Open made it, unless Finish has succeeded.
class ArtifactWriter {
 public:
  explicit ArtifactWriter(std::filesystem::path directory);
  ArtifactWriter(const ArtifactWriter&) = delete;
  ArtifactWriter& operator=(const ArtifactWriter&) = delete;
  ~ArtifactWriter();

  /// Makes the folder if there is none. Errors: kIo. Requires: called once, first.
  Status Open();

  /// Writes `bytes` as the artifact `name`. Errors: those of WriteFile.
  Status Add(const std::string& name, std::string_view bytes);
  Status Add(const std::string& name, const std::vector<std::uint8_t>& bytes);

  /// Adds a file that the caller has written to PathOf(name). Errors: those of ReadFile.
  Status AddWritten(const std::string& name);
  [[nodiscard]] std::filesystem::path PathOf(const std::string& name) const;
  /// What was added so far.
  [[nodiscard]] const std::vector<ManifestEntry>& entries() const { return entries_; }

  /// Writes manifest.json, with the artifacts by name. Errors: those of WriteFile.
  Status Finish();

 private:
  std::filesystem::path directory_;
  std::vector<ManifestEntry> entries_;
  bool made_directory_ = false;
  bool finished_ = false;
};

}  // namespace farhorizon
