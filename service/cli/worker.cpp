#include <memory>

#include "service/cli/command.h"
#include "service/worker/run_task.h"

namespace farhorizon {

void AddWorker(CLI::App& app, SelectedCommand& selected) {
  const auto probe = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("worker", "What the service starts for each job");
  command->group("");  // not in help: only the service starts it
  command->add_flag("--probe", *probe, "only read the DEM");
  command->callback([probe, &selected] { selected = [probe] { return RunTask(*probe); }; });
}

}  // namespace farhorizon
