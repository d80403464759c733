#include "service/cli/dem_command.h"

#include <fstream>

#include <nlohmann/json.hpp>

namespace farhorizon {

void AddDem(CLI::App& command, DemArguments& arguments, const char* help) {
  command.add_option("DEM", arguments.path, help)->required()->type_name("");
}

void AddRunFlags(CLI::App& command, DemArguments& arguments) {
  AddThreads(command, arguments.flags);
  AddReporterOptions(command, arguments.reporter);
}

void AddTimings(CLI::App& command, DemArguments& arguments, const char* help) {
  command.add_option("--timings", arguments.timings, help)->type_name("FILE");
}

Status WriteTimings(const std::string& path, const StageSeconds& seconds) {
  std::ofstream file(path);
  file << nlohmann::json(seconds).dump(2) << "\n";
  file.close();
  if (file) return Ok{};
  return Error{ErrorCode::kIo, "cannot write the timings to " + path};
}

}  // namespace farhorizon
