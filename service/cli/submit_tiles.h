#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "service/cli/job_client.h"
#include "service/cli/reporter.h"
#include "service/url_query.h"

namespace farhorizon {

/// Many DEMs, the same parameters for each.
struct TileSubmission {
  std::vector<std::string> tiles;  ///< as ReadTileList gives them
  Parameters parameters;
  std::filesystem::path directory;  ///< a folder for each in it, and the table jobs.tsv
  int at_once = 4;
};

/// Sends the DEMs, waits and fetches, some at once. A further run goes on where this one was cut
/// off: a DEM with the same parameters has the same idempotency key, and so the same job.
/// Returns the exit status: 0 all are there, 1 some cannot be, 75 another run may fetch the rest.
/// Errors: those of the table's file.
Result<int> SubmitTiles(const JobClient& client, const TileSubmission& submission,
                        Reporter& reporter);

}  // namespace farhorizon
