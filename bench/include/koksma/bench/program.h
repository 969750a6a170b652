#pragma once
// The koksma program, with whatever samplers it was linked with.

namespace koksma {

/// Runs the command line. @return the exit code: 0 success, 1 failure, 2 wrong usage; messages go to stderr
int run_program(int argc, char** argv);

}  // namespace koksma
