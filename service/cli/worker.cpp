#include <memory>

#include "service/cli/command.h"
#include "service/worker/run_task.h"

namespace farhorizon {

void AddWorker(Command& program, SelectedCommand& selected) {
  const auto probe = std::make_shared<bool>(false);
  Command command = program.AddCommand("worker", "What the service starts for each job");
  command.Hide();  // only the service starts it
  command.AddSwitch("--probe", "only read the DEM", *probe);
  command.Select(selected, [probe] { return RunTask(*probe); });
}

}  // namespace farhorizon
