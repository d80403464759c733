#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "core/base/result.h"

namespace farhorizon {

constexpr int kExitDone = 0;
constexpr int kExitData = 1;
constexpr int kExitCall = 2;
constexpr int kExitBug = 70;
constexpr int kExitInterrupted = 130;

/// The command that the command line names; returns the exit status. Set while CLI11 parses.
using SelectedCommand = std::function<int()>;

void AddBuild(CLI::App& app, SelectedCommand& selected);
void AddHorizon(CLI::App& app, SelectedCommand& selected);
void AddSkyline(CLI::App& app, SelectedCommand& selected);
void AddCompare(CLI::App& app, SelectedCommand& selected);
void AddVerify(CLI::App& app, SelectedCommand& selected);
void AddServe(CLI::App& app, SelectedCommand& selected);
void AddSubmit(CLI::App& app, SelectedCommand& selected);
void AddHealthcheck(CLI::App& app, SelectedCommand& selected);
void AddWorker(CLI::App& app, SelectedCommand& selected);

/// Prints `error` to standard error; the exit status for its code.
int ReportError(const Error& error);
/// kExitDone for a success; reports the error of a failure.
int ExitStatusOf(Status status);

}  // namespace farhorizon
