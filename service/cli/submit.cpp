#include <filesystem>
#include <memory>
#include <set>
#include <system_error>
#include <vector>

#include "core/base/hex.h"
#include "service/cli/command.h"
#include "service/cli/dem_command.h"
#include "service/cli/job_client.h"
#include "service/cli/remote_job.h"
#include "service/cli/submit_tiles.h"
#include "service/cli/tile_list.h"
#include "service/random.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct SubmitArguments {
  DemArguments dem;
  std::vector<std::string> words;
  std::string list;
  ServiceArguments service;
  std::string directory;
  int at_once = 4;
};

// Says each assumption once, of a list that grows, and begins anew where the job is run again.
class AssumptionsSaid {
 public:
  explicit AssumptionsSaid(const RunControl& control) : control_(control) {}

  void Hear(const json& status) {
    const auto list = status.find("assumptions");
    if (list == status.end() || !list->is_array()) return;
    for (const json& one : *list) {
      if (!one.is_object()) continue;
      const Assumption assumption{TextOf(one, "code"), TextOf(one, "text")};
      if (said_.insert(assumption.text).second) control_.Assume(assumption);
    }
  }

 private:
  const RunControl& control_;
  std::set<std::string> said_;
};

// The error, with the name by which the job, which is there, can be asked for.
Error OfJob(const std::string& id, Error error) {
  if (error.code != ErrorCode::kCancelled) error.message += "; the job is /jobs/" + id;
  return error;
}

// Sends one DEM, waits for the end and fetches the artifacts.
Status SubmitOne(const JobClient& client, const SubmitArguments& arguments, const DemRun& run) {
  if (Status made = MakeFolder(arguments.directory); !made) return made;
  AssumptionsSaid assumptions(run.control);
  const Result<json> sent =
      SendDem(client, {arguments.words.at(0), arguments.dem.flags.parameters, ToHex(RandomBytes()),
                       [&](double share) { run.reporter.Show("upload", share, 0); }});
  if (!sent) return sent.error();
  assumptions.Hear(*sent);
  const std::string id = TextOf(*sent, "jobID");
  const Result<json> end = WaitForEnd(client, id, [&](const json& status) {
    assumptions.Hear(status);
    ShowProgress(status, run.reporter);
  });
  if (!end) return OfJob(id, end.error());
  if (Status success = SuccessOf(*end); !success) return success;
  const Status fetched = FetchArtifacts(client, id, arguments.directory, [&](double share) {
    run.reporter.Show("download", share, 100);
  });
  return fetched ? fetched : OfJob(id, fetched.error());
}

int Run(const SubmitArguments& arguments) {
  const Result<std::vector<std::string>> tiles = ReadTileList(arguments.words, arguments.list);
  if (!tiles) return ReportError(tiles.error());
  std::error_code failure;
  const bool one = arguments.list.empty() && arguments.words.size() == 1 &&
                   !fs::is_directory(arguments.words[0], failure);
  // RunOnDem refuses invalid flags before anything is sent.
  const Result<int> status =
      RunOnDem(arguments.dem, Workflow::kBuild, [&](const DemRun& run) -> Result<int> {
        Result<JobClient> client = JobClient::Open(arguments.service, run.control.stop);
        if (!client) return std::move(client.error());
        if (one) {
          Status done = SubmitOne(*client, arguments, run);
          if (!done) return std::move(done.error());
          return kExitDone;
        }
        return SubmitTiles(
            *client,
            {*tiles, arguments.dem.flags.parameters, arguments.directory, arguments.at_once},
            run.reporter);
      });
  return status ? *status : ReportClientError(status.error());
}

}  // namespace

void AddSubmit(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<SubmitArguments>();
  Command command = program.AddCommand("submit", "Send DEMs to a service and fetch the artifacts");
  command.AddList(
      {.names = "DEM",
       .type = "",
       .help = "GeoTIFF, text grid (Arc/Info, GRASS, Surfer, x y z), SRTM HGT, also zipped, DTED, "
               "USGS DEM, Erdas Imagine or Surfer; or a folder of such files"},
      [arguments](const std::vector<std::string>& words) { arguments->words = words; });
  command.Add({.names = "--list",
               .type = "FILE",
               .help = "further DEMs, a path a line; - is standard input"},
              arguments->list);
  AddServiceOptions(command, arguments->service);
  command.Add({.names = "-o,--output",
               .type = "DIR",
               .help = "folder for the artifacts; made if missing. Of a folder, a list or several "
                       "DEMs, each has its own in there, under the DEM's name, and jobs.tsv says "
                       "what became of each: the same command again goes on with what is missing",
               .required = true},
              arguments->directory);
  command.Add({.names = "--at-once", .type = "N", .help = "of several DEMs, so many at once (4)"},
              arguments->at_once, 1, 64);
  AddBuildFlags(command, arguments->dem.flags);
  AddReporterOptions(command, arguments->dem.reporter);
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace farhorizon
