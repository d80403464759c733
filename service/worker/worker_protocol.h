#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/base/stage.h"
#include "service/url_query.h"

namespace farhorizon {

/// The descriptor to which a worker writes its messages.
constexpr int kWorkerMessageFd = 3;

/// The work of one worker process; the file task.json of its working directory.
struct WorkerTask {
  std::string input;      ///< the raster, relative to the working directory
  std::string output;     ///< the folder for the artifacts, likewise
  Parameters parameters;  ///< as of a job
  std::int64_t max_posts = 0;
  int threads = 1;
  bool echo = false;  ///< the input is no raster but what RunEcho gives back
};

std::string WriteTask(const WorkerTask& task);
/// Errors: kInvalidArgument.
Result<WorkerTask> ReadTask(const std::string& text);

/// Writes `directory`/task.json. Errors: kIo "storage".
Status WriteTaskFile(const std::filesystem::path& directory, const WorkerTask& task);
/// Reads task.json of the working directory. Errors: as ReadFile and ReadTask.
Result<WorkerTask> ReadTaskFile();

/// As many assumptions as a worker may send; a longer list than any DEM gives rise to, and short
/// enough to be stored with its job and shown in every status.
constexpr std::size_t kMostAssumptions = 32;

/// A worker sends something at least so often; beats, where it has nothing else to say.
constexpr std::chrono::seconds kBeatInterval{1};

/// A worker's messages, one JSON object a line: beats and progress any number of times, an
/// assumption up to kMostAssumptions times, the DEM's size, then at most once that the work is done
/// or the error that stopped it.
struct WorkerBeat {};
struct WorkerSize {
  std::int64_t posts = 0;
};
struct WorkerProgress {
  Stage stage = Stage::kRead;
  double done = 0;
};
struct WorkerDone {
  std::map<std::string, double> timings;  ///< seconds by stage
  std::int64_t peak_bytes = 0;            ///< resident memory at its peak
};
using WorkerMessage =
    std::variant<WorkerBeat, WorkerSize, WorkerProgress, Assumption, WorkerDone, Error>;

/// One line, with its newline. A text is cut after 2000 bytes.
std::string WriteMessage(const WorkerMessage& message);
/// nullopt for anything that WriteMessage does not write: a hostile raster may have taken control
/// of the worker.
std::optional<WorkerMessage> ReadMessage(std::string_view line);

}  // namespace farhorizon
