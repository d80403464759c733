#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/unique_fd.h"
#include "service/jobs/job_store.h"

namespace farhorizon {

/// The folder with a service's state, for its owner's eyes alone. The folder and its lock file are
/// locked while this object lives, so that one process at a time uses the folder, even where the
/// lock file is removed.
struct DataDirectory {
  std::filesystem::path root;
  UniqueFd folder;
  UniqueFd lock;
  PreviousEnd previous_end = PreviousEnd::kKilled;  ///< of the process that had the lock before

  [[nodiscard]] std::filesystem::path Jobs() const { return root / "jobs.sqlite"; }
  [[nodiscard]] std::filesystem::path Objects() const { return root / "objects"; }
  [[nodiscard]] std::filesystem::path Cache() const { return root / "cache"; }
  [[nodiscard]] std::filesystem::path Spool() const { return root / "spool"; }
  [[nodiscard]] std::filesystem::path Work() const { return root / "work"; }
  [[nodiscard]] std::filesystem::path Reserve() const { return root / "reserve"; }

  /// Succeeds while root and lock file are those that were locked. Errors: kIo "data-directory".
  [[nodiscard]] Status CheckHeld() const;
};

/// Makes the folder if it is missing, locks it, takes it from other users' eyes, and empties spool
/// and work of what an earlier process left there.
/// Errors: kIo "data-directory", with the folder and the remedy: it cannot be made or written,
///   belongs to another user, can be written by others, has a link in it, or another process uses
///   it.
Result<DataDirectory> OpenDataDirectory(const std::filesystem::path& root);

/// The same for a folder that must be there, and without emptying anything: for one who looks.
Result<DataDirectory> LockDataDirectory(const std::filesystem::path& root);

}  // namespace farhorizon
