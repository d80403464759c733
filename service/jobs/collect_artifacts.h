#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Of one job: 12 levels of 256 parts, 800 terrain tiles, and what else there is.
constexpr std::size_t kMostArtifacts = 4000;

/// Puts a worker's files into the store: those that `directory`/manifest.json lists, and the
/// manifest. Every size and SHA-256 of the manifest is checked against the file's bytes.
///
/// Nothing that a worker can leave makes the call wait or read another file than the worker's own:
/// pipes, sockets, devices, folders, links and files with a second name are refused, and so are
/// more files than a build makes.
/// Requires: no process writes to `directory` any more.
/// Errors: kUnsupportedData "worker-crashed" where the manifest is malformed or differs from the
///   files, or there is something else than files; those of the store.
Result<std::vector<Artifact>> CollectArtifacts(const std::filesystem::path& directory,
                                               ObjectStore& objects);

}  // namespace farhorizon
