#pragma once

#include "core/base/result.h"
#include "service/cli/command_line.h"

namespace farhorizon {

constexpr int kExitDone = 0;
constexpr int kExitData = 1;
constexpr int kExitCall = 2;
constexpr int kExitBug = 70;
constexpr int kExitInterrupted = 130;

void AddBuild(Command& program, SelectedCommand& selected);
void AddHorizon(Command& program, SelectedCommand& selected);
void AddSkyline(Command& program, SelectedCommand& selected);
void AddCompare(Command& program, SelectedCommand& selected);
void AddVerify(Command& program, SelectedCommand& selected);
void AddViewer(Command& program, SelectedCommand& selected);
void AddServe(Command& program, SelectedCommand& selected);
void AddWork(Command& program, SelectedCommand& selected);
void AddBackup(Command& program, SelectedCommand& selected);
void AddFsck(Command& program, SelectedCommand& selected);
void AddKeys(Command& program, SelectedCommand& selected);
void AddSubmit(Command& program, SelectedCommand& selected);
void AddHealthcheck(Command& program, SelectedCommand& selected);
void AddWorker(Command& program, SelectedCommand& selected);

/// Prints `error` to standard error; the exit status for its code.
int ReportError(const Error& error);
/// kExitDone for a success; reports the error of a failure.
int ExitStatusOf(Status status);

}  // namespace farhorizon
