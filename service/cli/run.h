#pragma once

namespace farhorizon {

/// The program: parses the command line, runs the command that it names, and returns the exit
/// status: 0 done, 1 the data or a claim is at fault, 2 the call is, 70 our own bug, 130
/// interrupted.
int RunProgram(int argc, char** argv);

}  // namespace farhorizon
