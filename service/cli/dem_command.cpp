#include "service/cli/dem_command.h"

#include <fstream>

#include <nlohmann/json.hpp>

namespace farhorizon {

void AddDem(Command& command, DemArguments& arguments, const char* help) {
  command.Add({.names = "DEM", .type = "", .help = help, .required = true}, arguments.path);
}

void AddRunFlags(Command& command, DemArguments& arguments) {
  AddThreads(command, arguments.flags);
  AddReporterOptions(command, arguments.reporter);
}

void AddTimings(Command& command, DemArguments& arguments, const char* help) {
  command.Add({.names = "--timings", .type = "FILE", .help = help}, arguments.timings);
}

Status WriteTimings(const std::string& path, const StageSeconds& seconds) {
  std::ofstream file(path);
  file << nlohmann::json(seconds).dump(2) << "\n";
  file.close();
  if (file) return Ok{};
  return Error{ErrorCode::kIo, "cannot write the timings to " + path};
}

}  // namespace farhorizon
