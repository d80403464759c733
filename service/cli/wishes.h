#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "core/base/result.h"
#include "core/pipeline/build.h"
#include "service/url_query.h"

namespace farhorizon {

/// The options of a build as they stand on the command line: under the names that a job's parameters
/// have, so that both ways in are one.
struct Wishes {
  Parameters parameters;
  int threads = 0;  ///< 0: as many as there are cores

  [[nodiscard]] Result<BuildOptions> Options() const;
};

/// --levels, --max-error and the rest. Requires: `wishes` outlives the parse.
void AddBuildWishes(CLI::App& command, Wishes& wishes);
/// --crs, --vertical-datum, --nodata.
void AddReadWishes(CLI::App& command, Wishes& wishes);
/// --work-budget, --approximate.
void AddWorkWishes(CLI::App& command, Wishes& wishes);
/// --threads.
void AddThreads(CLI::App& command, Wishes& wishes);

}  // namespace farhorizon
