#include <memory>

#include "service/cli/command.h"
#include "service/worker/run_task.h"

namespace farhorizon {

void AddWorker(CLI::App& app, Chosen& chosen) {
  const auto probe = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("worker", "What the service starts for each job");
  command->group("");  // no command for people
  command->add_flag("--probe", *probe, "only read the DEM");
  command->callback([probe, &chosen] { chosen = [probe] { return RunTask(*probe); }; });
}

}  // namespace farhorizon
