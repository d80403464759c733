#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

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
};

std::string WriteTask(const WorkerTask& task);
/// Errors: kInvalidArgument.
Result<WorkerTask> ReadTask(const std::string& text);

/// Writes `directory`/task.json. Errors: kIo "storage".
Status WriteTaskFile(const std::filesystem::path& directory, const WorkerTask& task);
/// Reads task.json of the working directory. Errors: as ReadFile and ReadTask.
Result<WorkerTask> ReadTaskFile();

/// A worker's messages, one JSON object a line: progress any number of times, then at most once
/// that the work is done or the error that stopped it.
struct WorkerProgress {
  Stage stage = Stage::kRead;
  double done = 0;
};
struct WorkerDone {
  std::map<std::string, double> timings;  ///< seconds by stage
};
using WorkerMessage = std::variant<WorkerProgress, WorkerDone, Error>;

/// One line, with its newline.
std::string WriteMessage(const WorkerMessage& message);
/// nullopt for anything that WriteMessage does not write: a hostile raster may have taken control
/// of the worker.
std::optional<WorkerMessage> ReadMessage(std::string_view line);

}  // namespace farhorizon
