#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/unique_fd.h"

namespace farhorizon {

/// The folder with a service's state. Its lock file is locked while this object lives, so that one
/// process at a time uses the folder.
struct DataDirectory {
  std::filesystem::path root;
  UniqueFd lock;

  [[nodiscard]] std::filesystem::path Jobs() const { return root / "jobs.sqlite"; }
  [[nodiscard]] std::filesystem::path Objects() const { return root / "objects"; }
  [[nodiscard]] std::filesystem::path Spool() const { return root / "spool"; }
  [[nodiscard]] std::filesystem::path Work() const { return root / "work"; }
};

/// Makes the folder if it is missing, locks it, and empties spool and work of what an earlier
/// process left there.
/// Errors: kIo, with the folder and the remedy: it cannot be made or written, belongs to another
///   user, or another process uses it.
Result<DataDirectory> OpenDataDirectory(const std::filesystem::path& root);

}  // namespace farhorizon
