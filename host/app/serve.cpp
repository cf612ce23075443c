// SPDX-License-Identifier: Apache-2.0
// `wavetracer serve`: poses come in over a socket, channels go out, until a signal ends it.
// Standard output gets the address once it listens; everything else goes to standard error.
#include "live/serve.hpp"
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>
#include "app/commands.hpp"
#include "app/live_page.hpp"
#include "app/named_files.hpp"
#include "app/standard_streams.hpp"
#include "jobs/interrupt.hpp"
#include "jobs/progress.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

struct ServeOptions {
  std::string file;
  std::vector<std::string> sets;
  std::string page;
  live::ServeOptions serve;
};

void serve(const ServeOptions& options) {
  const Config config = load_config(options.file, options.sets);
  check_inputs(config);
  catch_interrupts();
  Progress progress;
  live::ServeOptions serving = options.serve;
  std::optional<LivePage> page;
  if (!options.page.empty()) {
    page.emplace(options.page, [&](const std::string& text) { progress.line("warning: " + text); });
    serving.solved = [&page](const Simulation& simulation, const LiveFrame& frame) { page->show(simulation, frame); };
  }
  std::optional<EndOnInterrupt> loading;
  loading.emplace([] {}, "interrupted before the server was ready");
  live::serve(
      config, serving, interrupted, [&](const std::string& text) { progress.line(text); },
      [&loading](const std::string& name) {
        loading.reset();
        std::cout << "listening on " << name << std::endl;
        if (const std::string problem = output_problem(); !problem.empty()) throw RuntimeError(problem);
      });
  progress.line("ended");
}

}  // namespace

void add_serve(CLI::App& program, Invocation&) {
  CLI::App* command =
      program.add_subcommand("serve", "Receive vehicle poses from a running simulator and answer with radio channels");
  const auto options = std::make_shared<ServeOptions>();
  command->add_option("-c,--config", options->file, "Config file (TOML) with [[live_vehicle]]")->required();
  command->add_option("--listen", options->serve.listen, "Address to listen on: unix:PATH or tcp:ADDRESS:PORT")
      ->capture_default_str();
  command
      ->add_option("--set", options->sets, "KEY=VALUE: set a key of the config, overriding the file; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--device", options->serve.device,
                      "OpenCL device: its index, or a part of its name or of its platform's name");
  command->add_option("--token-file", options->serve.token_file,
                      "File with the secret that clients must send; required unless the address is a loopback address");
  command->add_option("--page", options->page,
                      "Page that shows the newest frame, written at most once per second; open it in a browser, "
                      "which loads it again by itself");
  command->callback([options] { serve(*options); });
}

}  // namespace wavetracer::app
