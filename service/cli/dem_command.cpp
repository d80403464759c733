#include "service/cli/dem_command.h"

namespace farhorizon {

void AddDem(Command& command, DemArguments& arguments, const char* help) {
  command.Add({.names = "DEM", .type = "", .help = help, .required = true}, arguments.path);
}

void AddRunFlags(Command& command, DemArguments& arguments) {
  AddThreads(command, arguments.flags);
  AddReporterOptions(command, arguments.reporter);
}

}  // namespace farhorizon
