#include <memory>

#include "service/cli/command.h"
#include "service/worker/run_task.h"
#include "service/worker/spawner/spawner_process.h"

namespace farhorizon {

void AddWorker(Command& program, SelectedCommand& selected) {
  const auto probe = std::make_shared<bool>(false);
  const auto spawner = std::make_shared<bool>(false);
  Command command = program.AddCommand("worker", "What the service starts for each job");
  command.Hide();  // only the service starts it
  command.AddSwitch("--probe", "only read the DEM", *probe);
  command.AddSwitch("--spawner", "start others on demand", *spawner);
  command.Select(selected, [probe, spawner] { return *spawner ? RunSpawner() : RunTask(*probe); });
}

}  // namespace farhorizon
