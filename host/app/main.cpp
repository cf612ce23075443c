// SPDX-License-Identifier: Apache-2.0
// The command line: subcommands, and the one place where an error becomes a message and an exit code.
// Results go to stdout, messages and progress to stderr.
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <exception>
#include <iostream>
#include <new>
#include <system_error>
#include "app/build_info.hpp"
#include "app/commands.hpp"
#include "app/memory_limit.hpp"
#include "app/stack.hpp"
#include "app/standard_streams.hpp"
#include "app/usage.hpp"

namespace {

using wavetracer::ExitCode;

std::string command_line(int argc, char** argv) {
  std::string out;
  for (int i = 0; i < argc; ++i) {
    const std::string word = argv[i];
    const bool plain = !word.empty() && word.find_first_of(" \t\n'\"\\$`*?[]{}()<>|&;#~!") == std::string::npos;
    std::string quoted;
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    out += (i == 0 ? "" : " ") + (plain ? word : "'" + quoted + "'");
  }
  return out;
}

int fail(ExitCode code, const std::string& message) {
  std::cerr << "wavetracer: " << message << "\n";
  return static_cast<int>(code);
}

int run_program(int argc, char** argv) {
  CLI::App program{"Radio channels between moving vehicles by ray tracing on OpenCL"};
  program.name("wavetracer");
  program.set_version_flag("--version", wavetracer::app::build_info);
  program.require_subcommand(0, 1);  // a missing subcommand is reported below, after a misspelt one
  program.footer(
      "`wavetracer help COMMAND` explains a command, `wavetracer help KEY` explains a key of configuration files "
      "such as trace.rays, and `wavetracer help config` explains all keys. "
      "`wavetracer init --minimal` prints a first file.");
  wavetracer::app::Invocation invocation{command_line(argc, argv)};
  wavetracer::app::add_run(program, invocation);
  wavetracer::app::add_devices(program, invocation);
  wavetracer::app::add_validate(program);
  wavetracer::app::add_init(program);
  wavetracer::app::add_scene(program);
  wavetracer::app::add_events(program);
  wavetracer::app::add_thesis(program, invocation);
  wavetracer::app::add_accuracy(program, invocation);
  wavetracer::app::add_calibrate(program, invocation);
  wavetracer::app::add_view(program);
  wavetracer::app::add_plot(program);
  wavetracer::app::add_coverage(program);
  wavetracer::app::add_convert(program);
  wavetracer::app::add_merge(program, invocation);
  wavetracer::app::add_serve(program, invocation);
  wavetracer::app::add_help(program);
  wavetracer::app::add_documentation(program);
  wavetracer::app::refuse_bad_values(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return program.exit(e);  // it was --help or --version
    return fail(ExitCode::usage, wavetracer::app::usage_problem(program, e));
  }
  if (program.get_subcommands().empty()) {
    std::cerr << program.help();
    return static_cast<int>(ExitCode::usage);
  }
  return static_cast<int>(invocation.code);
}

int run_and_report(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const wavetracer::Error& e) {
    // A device or a library may have run out of memory and report something else.
    const bool may_lack_memory = e.code() == ExitCode::device || e.code() == ExitCode::runtime;
    return fail(e.code(), e.what() + (may_lack_memory ? wavetracer::app::limit_hint() : ""));
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::runtime, "out of memory: lower trace.batch_rays or trace.rays, or use a smaller scene" +
                                       wavetracer::app::limit_hint());
  } catch (const std::system_error& e) {
    if (e.code() != std::errc::resource_unavailable_try_again) return fail(ExitCode::runtime, e.what());
    return fail(ExitCode::runtime,
                "no thread can be started: the memory or the number of threads of this process (`ulimit -u`) "
                "is used up; raise the limit, or lower trace.batch_rays or trace.rays" +
                    wavetracer::app::limit_hint());
  } catch (const std::exception& e) {
    return fail(ExitCode::runtime, e.what() + wavetracer::app::limit_hint());
  }
}

// Makes the program fail if its output has not arrived.
int flush_and_report(int code) {
  const std::string problem = wavetracer::app::output_problem();
  if (problem.empty() || code == static_cast<int>(ExitCode::runtime)) return code;
  const int failed = fail(ExitCode::runtime, problem);
  return code == 0 ? failed : code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    wavetracer::app::keep_standard_streams();
    return wavetracer::app::explained([=] {
      return flush_and_report(wavetracer::app::with_enough_stack([=] { return run_and_report(argc, argv); }));
    });
  } catch (const wavetracer::Error& e) {
    return fail(e.code(), e.what());
  }
}
