#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Puts a worker's files into the store: those that `directory`/manifest.json lists, and the
/// manifest. Every size and SHA-256 of the manifest is checked against the file's bytes.
/// Errors: kUnsupportedData "worker-crashed" where the manifest is malformed or differs from the
///   files; those of the store.
Result<std::vector<Artifact>> CollectArtifacts(const std::filesystem::path& directory,
                                               ObjectStore& objects);

}  // namespace farhorizon
