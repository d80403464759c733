#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/base/result.h"
#include "core/base/stage.h"
#include "service/url_query.h"

namespace farhorizon {

/// What a worker is asked to do; stands as task.json in its working directory.
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

/// What a worker says, a JSON object a line on its descriptor 3: how far it is, and once at its end
/// that it is done or why not.
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
/// nullopt for anything that WriteMessage does not write: a worker may have been taken over by what
/// it reads.
std::optional<WorkerMessage> ReadMessage(std::string_view line);

}  // namespace farhorizon
