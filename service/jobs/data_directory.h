#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "service/unique_fd.h"

namespace farhorizon {

/// The folder that a service keeps its state in, held against every other process while this lives.
struct DataDirectory {
  std::filesystem::path root;
  UniqueFd lock;

  [[nodiscard]] std::filesystem::path Jobs() const { return root / "jobs.sqlite"; }
  [[nodiscard]] std::filesystem::path Objects() const { return root / "objects"; }
  [[nodiscard]] std::filesystem::path Spool() const { return root / "spool"; }
  [[nodiscard]] std::filesystem::path Work() const { return root / "work"; }
};

/// Makes the folder where it is missing, locks it, and clears what a killed process left half-done.
/// Errors: kIo, naming the folder and the remedy: cannot be made or written, another user's, or in
///   use by another process.
Result<DataDirectory> OpenDataDirectory(const std::filesystem::path& root);

}  // namespace farhorizon
