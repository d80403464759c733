#pragma once

#include "service/cli/command_line.h"

namespace farhorizon {

/// What a client asks of a job that a service has: status, wait, fetch, cancel.
void AddJobCommands(Command& program, SelectedCommand& selected);

}  // namespace farhorizon
