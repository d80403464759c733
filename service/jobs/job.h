#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "service/url_query.h"

namespace farhorizon {

/// Where a job stands, in the words of OGC API - Processes.
enum class JobState { kAccepted, kRunning, kSuccessful, kFailed, kDismissed };

/// "accepted", "running", …
const char* JobStateName(JobState state);
std::optional<JobState> JobStateOf(std::string_view name);

/// Whether nothing follows `state`.
bool IsTerminal(JobState state);

/// The state machine: accepted -> running -> successful | failed; running -> accepted (the worker or
/// the service stopped); accepted | running -> dismissed. Nothing leaves a terminal state.
bool MayFollow(JobState from, JobState to);

/// A UUIDv7 in lower-case text: 48 bits of time, 74 random ones.
std::string NewJobId(std::int64_t now_ms);
/// Whether `text` has the form of one: no other text reaches a store.
bool IsJobId(std::string_view text);

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
  std::int64_t attempt = 0;  ///< times it was started; fences off the late word of an earlier one
  std::int64_t crash_count = 0;
  std::optional<Error> failure;           ///< set where state is kFailed
  std::map<std::string, double> timings;  ///< seconds by stage, of the run that succeeded
};

/// A file that a job leaves, by its content.
struct Artifact {
  std::string name;
  std::string media_type;
  std::int64_t bytes = 0;
  std::string sha256;
};

/// A base name that is safe as a file's name and in a header: the part after the last slash or
/// backslash, ASCII letters, digits, '.', '_' and '-', not starting with '.' or '-', at most 100
/// characters; "dem" where nothing is left.
std::string SafeFilename(std::string_view wished);

/// Whether `name` may name an artifact: as SafeFilename leaves it.
bool IsArtifactName(std::string_view name);

}  // namespace farhorizon
