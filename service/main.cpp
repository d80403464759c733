#include "service/cli/run.h"

int main(int argc, char** argv) { return farhorizon::RunProgram(argc, argv); }
