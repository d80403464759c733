#pragma once

#include <filesystem>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Takes what a worker left in `directory` into the store: the files that its manifest.json names,
/// and that. Believes the manifest only as far as the bytes bear it out.
/// Errors: kUnsupportedData "worker-crashed" where the two differ; those of the store.
Result<std::vector<Artifact>> CollectArtifacts(const std::filesystem::path& directory,
                                               ObjectStore& objects);

}  // namespace farhorizon
