#include <cstdio>
#include <memory>
#include <string>

#include "service/cli/command.h"
#include "service/jobs/fsck/backup_store.h"
#include "service/jobs/fsck/check_store.h"

namespace farhorizon {

namespace {

struct FsckArguments {
  std::string directory;
  std::string data;
  bool repair = false;
};

// Prints a line for each fault.
void Say(const std::string& line) { std::printf("%s\n", line.c_str()); }

int ReportSum(const Result<FsckSum>& sum) {
  if (!sum) return ReportError(sum.error());
  std::fprintf(stderr,
               "farhorizon: %lld jobs, %lld objects of %lld bytes; %lld faults, %lld mended\n",
               static_cast<long long>(sum->jobs), static_cast<long long>(sum->objects),
               static_cast<long long>(sum->bytes), static_cast<long long>(sum->faults),
               static_cast<long long>(sum->mended));
  return sum->faults == 0 ? kExitDone : kExitData;
}

int Run(const FsckArguments& arguments) {
  const std::string& directory = arguments.data.empty() ? arguments.directory : arguments.data;
  if (directory.empty()) {
    return ReportError({ErrorCode::kInvalidArgument, "give the data directory: farhorizon fsck DIR",
                        "invalid-argument"});
  }
  return ReportSum(CheckStore({directory, arguments.repair, Say}));
}

}  // namespace

void AddFsck(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<FsckArguments>();
  Command command =
      program.AddCommand("fsck", "Look at the data directory of a stopped service, and mend it");
  command.Add({.names = "DIR", .type = "", .help = "the data directory"}, arguments->directory);
  command.Add({.names = "--data", .type = "DIR", .help = "the same, as serve has it"},
              arguments->data);
  command.AddSwitch("--repair",
                    "mend what can be mended without losing anything; what is damaged or unknown "
                    "is moved to DIR/stray and DIR/objects/stray",
                    arguments->repair);
  command.SetFooter(
      "A line for each fault on stdout. Exit status 0 without faults, 1 with faults, mended or "
      "not.");
  command.Select(selected, [arguments] { return Run(*arguments); });
}

void AddBackup(Command& program, SelectedCommand& selected) {
  struct BackupArguments {
    std::string directory;
    std::string target;
  };
  const auto arguments = std::make_shared<BackupArguments>();
  Command command = program.AddCommand(
      "backup", "Copy the data directory of a service, which may run, and check the copy");
  command.Add({.names = "DIR", .type = "", .help = "the data directory", .required = true},
              arguments->directory);
  command.Add(
      {.names = "-o,--output", .type = "DIR", .help = "the copy: a new folder", .required = true},
      arguments->target);
  command.SetFooter(
      "To restore: stop the service, move its data directory away and the copy into its place.");
  command.Select(selected, [arguments] {
    return ReportSum(BackUpStore({arguments->directory, false, Say}, arguments->target));
  });
}

}  // namespace farhorizon
