// SPDX-License-Identifier: Apache-2.0
// The subcommands of the program: each add_ function declares one with its options and its action.
// A subcommand throws an Error to fail; Invocation holds the exit code of a success that is not 0.
#pragma once
#include <CLI/App.hpp>
#include <string>
#include "wavetracer/error.hpp"

namespace wavetracer::app {

struct Invocation {
  std::string command_line;  // as typed, quoted if a shell needs that
  ExitCode code = ExitCode::ok;
};

void add_run(CLI::App& program, Invocation& invocation);
void add_devices(CLI::App& program, Invocation& invocation);
void add_validate(CLI::App& program);
void add_init(CLI::App& program);
void add_scene(CLI::App& program);
void add_events(CLI::App& program);
void add_thesis(CLI::App& program, Invocation& invocation);
void add_accuracy(CLI::App& program, Invocation& invocation);
void add_calibrate(CLI::App& program, Invocation& invocation);
void add_view(CLI::App& program);
void add_plot(CLI::App& program);
void add_coverage(CLI::App& program);
void add_convert(CLI::App& program);
void add_merge(CLI::App& program, Invocation& invocation);
void add_serve(CLI::App& program, Invocation& invocation);
void add_help(CLI::App& program);
void add_documentation(CLI::App& program);

}  // namespace wavetracer::app
