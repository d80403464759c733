#include "service/cli/job_commands.h"

#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "service/cli/command.h"
#include "service/cli/job_client.h"
#include "service/cli/remote_job.h"
#include "service/cli/reporter.h"
#include "service/cli/signals.h"

namespace farhorizon {

namespace {

using nlohmann::json;

struct JobArguments {
  std::string job;
  ServiceArguments service;
  ReporterOptions reporter;
  std::string directory;
  int most_seconds = 0;
};

// A job of a service, while a command is busy with it.
struct JobRun {
  const JobArguments& arguments;
  const JobClient& client;
  const std::string& id;
  Reporter& reporter;
};

void Print(const json& status) {
  std::printf("%s\n", status.dump(2, ' ', false, json::error_handler_t::replace).c_str());
}

Status ShowStatus(const JobRun& run) {
  const Result<json> status = run.client.SendForJson("/jobs/" + run.id, 200);
  if (!status) return status.error();
  Print(*status);
  return Ok{};
}

Status Wait(const JobRun& run) {
  const auto heard = [&](const json& status) { ShowProgress(status, run.reporter); };
  std::optional<std::chrono::seconds> most;
  if (run.arguments.most_seconds > 0) most.emplace(run.arguments.most_seconds);
  const Result<json> status = WaitForEnd(run.client, run.id, heard, most);
  run.reporter.Clear();
  if (!status) return status.error();
  Print(*status);
  return SuccessOf(*status);
}

Status Fetch(const JobRun& run) {
  return FetchArtifacts(run.client, run.id, run.arguments.directory, [&](double share) {
    run.reporter.Show("download", share, static_cast<int>(100 * share));
  });
}

Status Cancel(const JobRun& run) {
  ClientRequest request;
  request.method = "DELETE";
  const Result<json> status = run.client.SendForJson("/jobs/" + run.id, 200, std::move(request));
  if (!status) return status.error();
  Print(*status);
  return Ok{};
}

int Run(const JobArguments& arguments, const std::function<Status(const JobRun&)>& work) {
  const Result<std::string> id = ReadJobId(arguments.job);
  if (!id) return ReportError(id.error());
  const StopOnSignal signals;
  const Result<JobClient> client = JobClient::Open(arguments.service, signals.token());
  if (!client) return ReportError(client.error());
  Reporter reporter(arguments.reporter);
  const Status done = work({arguments, *client, *id, reporter});
  reporter.Clear();
  return done ? kExitDone : ReportClientError(done.error());
}

// A command with what all have.
std::pair<Command, std::shared_ptr<JobArguments>> AddOne(
    Command& program, SelectedCommand& selected, const char* name, const char* help,
    std::function<Status(const JobRun&)> work) {
  auto arguments = std::make_shared<JobArguments>();
  Command command = program.AddCommand(name, help);
  command.Add({.names = "JOB", .type = "", .help = "the job's id, or its URL", .required = true},
              arguments->job);
  AddServiceOptions(command, arguments->service);
  command.Select(selected, [arguments, work = std::move(work)] { return Run(*arguments, work); });
  return {command, arguments};
}

}  // namespace

void AddJobCommands(Command& program, SelectedCommand& selected) {
  AddOne(program, selected, "status", "Print how a job of a service stands, as JSON", ShowStatus);
  auto [wait, waiting] =
      AddOne(program, selected, "wait",
             "Wait until a job of a service has ended, and print its status; exit status 0 if it "
             "was successful, 1 if not, 75 if it goes on",
             Wait);
  wait.Add({.names = "--timeout", .type = "SECONDS", .help = "wait no longer (0: to the end)"},
           waiting->most_seconds, 0, 366 * 86400);
  AddReporterOptions(wait, waiting->reporter);
  auto [fetch, fetching] =
      AddOne(program, selected, "fetch",
             "Fetch the artifacts of a job of a service; what was cut off is gone on with", Fetch);
  fetch.Add({.names = "-o,--output",
             .type = "DIR",
             .help = "folder for the artifacts; made if missing",
             .required = true},
            fetching->directory);
  AddReporterOptions(fetch, fetching->reporter);
  AddOne(program, selected, "cancel",
         "Stop a job of a service, or remove one that has ended, with its artifacts", Cancel);
}

}  // namespace farhorizon
