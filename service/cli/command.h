#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "core/base/result.h"

namespace farhorizon {

constexpr int kExitDone = 0;
constexpr int kExitData = 1;
constexpr int kExitCall = 2;
constexpr int kExitBug = 70;
constexpr int kExitInterrupted = 130;

/// What the command line asks for; set by the sub-command that was named.
using Chosen = std::function<int()>;

void AddBuild(CLI::App& app, Chosen& chosen);
void AddHorizon(CLI::App& app, Chosen& chosen);
void AddSkyline(CLI::App& app, Chosen& chosen);
void AddVerify(CLI::App& app, Chosen& chosen);
void AddServe(CLI::App& app, Chosen& chosen);
void AddSubmit(CLI::App& app, Chosen& chosen);
void AddHealthcheck(CLI::App& app, Chosen& chosen);
void AddWorker(CLI::App& app, Chosen& chosen);

/// Says `error` on stderr; the exit status that it means.
int Complain(const Error& error);

}  // namespace farhorizon
