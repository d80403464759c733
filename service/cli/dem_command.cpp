#include "service/cli/dem_command.h"

namespace farhorizon {

void AddDem(CLI::App& command, DemArguments& arguments, const char* help) {
  command.add_option("DEM", arguments.path, help)->required()->type_name("");
}

void AddRunFlags(CLI::App& command, DemArguments& arguments) {
  AddThreads(command, arguments.flags);
  AddReporterOptions(command, arguments.reporter);
}

}  // namespace farhorizon
