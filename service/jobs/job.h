#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "service/jobs/object_store.h"
#include "service/url_query.h"

namespace farhorizon {

/// The state of a job, in the words of OGC API - Processes.
enum class JobState { kAccepted, kRunning, kSuccessful, kFailed, kDismissed };

/// "accepted", "running", …
const char* JobStateName(JobState state);
/// The state that has this name; nullopt for any other text.
std::optional<JobState> JobStateOf(std::string_view name);

/// True for the states that no other state follows.
bool IsTerminal(JobState state);

/// The state machine: accepted -> running -> successful | failed; running -> accepted (the worker
/// or the service stopped); accepted -> failed (its deadline has passed); accepted | running ->
/// dismissed. A terminal state is the last.
bool MayFollow(JobState from, JobState to);

/// A UUIDv7 in lower-case text: 48 bits of time, 74 random ones.
std::string NewJobId(std::int64_t now_ms);
/// The same, and greater than `last`, whatever the clock says: ids have the order in which they
/// were given out. Requires: `last` is a job's id.
std::string NextJobId(std::int64_t now_ms, const std::string& last);
/// True for a UUID in lower-case text. Requests with any other text as an id are refused before
/// they reach a store.
bool IsJobId(std::string_view text);

/// Which of the waiting jobs comes first.
enum class Priority { kLow, kNormal, kHigh };
inline constexpr std::array kPriorityNames = {"low", "normal", "high"};

/// What a client asks of the queue, beside what it asks of the build.
struct JobTerms {
  Priority priority = Priority::kNormal;
  std::int64_t deadline_seconds = 0;  ///< from its acceptance to its end; 0: none
  std::int64_t timeout_seconds = 0;   ///< of each run; 0: as long as a worker may take
};

/// What a run is expected to need at most; 0: not known.
struct JobCost {
  std::int64_t memory_bytes = 0;
  std::int64_t seconds = 0;  ///< of one core
};

/// The processes that a job may be of, by their names in OGC API - Processes. What a job does is
/// terrain-lod; echo gives back what it is sent.
inline constexpr const char* kTerrainProcess = "terrain-lod";
inline constexpr const char* kEchoProcess = "echo";

/// One piece of work, as it is stored. Times are milliseconds since 1970.
struct Job {
  std::string id;
  JobState state = JobState::kAccepted;
  std::string filename;  ///< sanitised: SafeFilename
  Parameters parameters;
  std::string input_sha256;
  std::int64_t input_bytes = 0;
  int progress = 0;  ///< percent; never falls
  std::string message;
  std::int64_t created_ms = 0;
  std::optional<std::int64_t> started_ms;
  std::optional<std::int64_t> finished_ms;
  std::int64_t updated_ms = 0;
  std::string client;        ///< whose turn it takes: its owner, or the address it came from
  std::int64_t run = 0;      ///< number of starts so far; identifies the current one
  std::int64_t attempt = 0;  ///< of those, the starts that the job has spent: not those that a stop
                             ///< of the service or a fault of the machine has ended
  std::int64_t crash_count = 0;
  std::int64_t retries = 0;                ///< starts that a fault of the machine has ended
  std::optional<std::int64_t> expires_ms;  ///< when retention removes it; JobService sets it
  std::optional<Error> failure;            ///< set if and only if state is kFailed
  std::map<std::string, double> timings;   ///< seconds by stage, of the run that succeeded
  Assumptions assumptions;                 ///< of the last run that has read the DEM, or the probe
  Priority priority = Priority::kNormal;
  std::optional<std::int64_t> deadline_ms;  ///< when it fails unless it has ended
  std::int64_t timeout_seconds = 0;         ///< as JobTerms has it
  JobCost cost;
  std::string process = kTerrainProcess;
  std::string answer;  ///< how its results are to be answered, for the handlers; empty: as always
  std::string owner;   ///< whose key it came with; empty: no key was asked for
  std::string source;  ///< as NewJob has it
};

/// One output file of a job.
struct Artifact {
  std::string name;
  std::string media_type;
  std::int64_t bytes = 0;
  std::string sha256;
  std::optional<StoredObject> gzip = {};  ///< the same, compressed; where that pays
  std::optional<StoredObject> zstd = {};
};

/// The objects of artifacts: the copies of some, too.
std::vector<std::string> ObjectsOf(const std::vector<Artifact>& artifacts);

/// The Error of a call that names a job which does not exist: kNotFound "no-such-job".
Error NoSuchJob();

/// The name of a DEM that came without one.
inline constexpr const char* kNoFilename = "dem";

/// A name that is safe for a file and in a header: of the part after the last slash or backslash,
/// the ASCII letters, digits, '.', '_' and '-' from the first that is neither '.' nor '-', at most
/// the last 100; kNoFilename where none is left, and before an ending that alone is left:
/// "dem.tif".
std::string SafeFilename(std::string_view path);

/// True for a name that SafeFilename would return unchanged.
bool IsArtifactName(std::string_view name);

}  // namespace farhorizon
