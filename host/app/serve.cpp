// SPDX-License-Identifier: Apache-2.0
// `wavetracer serve`: poses come in over a socket, channels go out, until a signal ends it.
// Standard output gets the address once it listens; everything else goes to standard error.
#include "live/serve.hpp"
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include <optional>
#include "app/commands.hpp"
#include "app/idle_options.hpp"
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
  std::string page, protocol = "live", position = "front", gain = "narrowband";
  std::vector<double> offset_m;
  live::ServeOptions serve;
};

void serve(const ServeOptions& options) {
  const Config config = load_config(options.file, options.sets);
  check_inputs(config);
  catch_interrupts();
  Progress progress;
  live::ServeOptions serving = options.serve;
  serving.protocol = options.protocol == "van3twin" ? live::Protocol::van3twin : live::Protocol::live;
  live::van3twin::Options& van3twin = serving.van3twin;
  if (options.offset_m.size() == 3)
    van3twin.coordinates.offset_m = {options.offset_m[0], options.offset_m[1], options.offset_m[2]};
  van3twin.coordinates.front = options.position == "front";
  van3twin.narrowband = options.gain == "narrowband";
  std::optional<LivePage> page;
  if (!options.page.empty()) {
    page.emplace(options.page, [&](const std::string& text) { progress.line("warning: " + text); });
    serving.solved = [&page](const Simulation& simulation, const LiveFrame& frame) { page->show(simulation, frame); };
  }
  std::optional<EndOnInterrupt> loading;
  loading.emplace([] {}, "interrupted before the server was ready");
  const auto say = [&progress](const std::string& text) { progress.line(text); };
  const auto ready = [&loading](const std::string& name) {
    loading.reset();
    std::cout << "listening on " << name << std::endl;
    if (const std::string problem = output_problem(); !problem.empty()) throw RuntimeError(problem);
  };
  live::serve(config, serving, interrupted, say, ready);
  progress.line("ended");
}

void add_van3twin(CLI::App& command, const std::shared_ptr<ServeOptions>& options) {
  command
      .add_option("--protocol", options->protocol,
                  "live: the protocol of docs/live.md; van3twin: datagrams of VaN3Twin's ns-3 modules")
      ->check(CLI::IsMember({"live", "van3twin"}))
      ->capture_default_str();
  command.add_option("--offset", options->offset_m, "VaN3Twin: metres X Y Z that are added to positions of vehicles")
      ->expected(3);
  command
      .add_option(
          "--position", options->position,
          "VaN3Twin: positions are those of the middle of the front bumper (front), as SUMO's, or of the vehicle "
          "(middle)")
      ->check(CLI::IsMember({"front", "middle"}))
      ->capture_default_str();
  command
      .add_option(
          "--gain", options->gain,
          "VaN3Twin: gains are those of the sum of fields at the carrier (narrowband), or waves are added by their "
          "powers (path)")
      ->check(CLI::IsMember({"narrowband", "path"}))
      ->capture_default_str();
  command.add_option("--peer", options->serve.van3twin.peer,
                     "VaN3Twin: the only address whose datagrams are answered; required unless the server listens on a "
                     "loopback address");
}

// The other protocol has options of its own.
void check_protocol(const CLI::App& command, const ServeOptions& options) {
  if (options.protocol == "live")
    refuse_options(command, {"--offset", "--position", "--gain", "--peer"},
                   "this option is for --protocol van3twin, and --protocol is live");
}

}  // namespace

void add_serve(CLI::App& program, Invocation&) {
  CLI::App* command =
      program.add_subcommand("serve", "Receive vehicle poses from a running simulator and answer with radio channels");
  const auto options = std::make_shared<ServeOptions>();
  command->add_option("-c,--config", options->file, "Config file (TOML) with [[live_vehicle]]")->required();
  command->add_option("--listen", options->serve.listen,
                      "Address to listen on: unix:PATH or tcp:ADDRESS:PORT (default tcp:127.0.0.1:7710); "
                      "udp:ADDRESS:PORT for VaN3Twin (default udp:127.0.0.1:8103)");
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
  add_van3twin(*command, options);
  command->callback([options, command] {
    check_protocol(*command, *options);
    serve(*options);
  });
}

}  // namespace wavetracer::app
