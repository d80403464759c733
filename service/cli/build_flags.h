#pragma once

#include "core/base/result.h"
#include "core/pipeline/build.h"
#include "service/cli/command_line.h"
#include "service/url_query.h"

namespace farhorizon {

/// The flags of a build by the names of a job's parameters, so that the command line and the
/// service parse them with the same code.
struct BuildFlags {
  Parameters parameters;
  int threads = 0;  ///< 0: as many as there are cores

  /// The options that the flags mean. Errors: kInvalidArgument, as ParseOptions and CheckOptions.
  [[nodiscard]] Result<BuildOptions> Options() const;
};

/// Adds --levels, --max-error and all other flags of a build. Requires: `flags` outlives the parse.
void AddBuildFlags(Command& command, BuildFlags& flags);
/// Adds --frame, --apron.
void AddTileFlags(Command& command, BuildFlags& flags);
/// Adds --crs, --vertical-datum, --height-unit, --datum-operation, --nodata.
void AddReadFlags(Command& command, BuildFlags& flags);
/// Adds --work-budget, --approximate.
void AddWorkFlags(Command& command, BuildFlags& flags);
/// Adds --threads.
void AddThreads(Command& command, BuildFlags& flags);

}  // namespace farhorizon
