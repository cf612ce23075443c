// SPDX-License-Identifier: Apache-2.0
// `wavetracer convert` on the command line: formats by name and by suffix, frames by number, and its messages for
// unknown ones.
#include <doctest/doctest.h>
#include <signal.h>
#include <string>
#include <vector>
#include "app/gate.hpp"
#include "app/program.hpp"
#include "convert/convert.hpp"
#include "output/sample_run.hpp"
#include "wavetracer/output.hpp"

using namespace wavetracer;

namespace {

// Frames 5 to 9: numbers do not begin with 0.
std::string sample_folder(const Folder& folder) {
  const SampleRun sample;
  write_outputs(folder.path("run"), sample.run(), sample.drive(5, 5));
  return folder.path("run");
}

// Makes a frame with this many receivers at different places.
std::string crowded_folder(const Folder& folder, size_t receivers) {
  SampleRun sample;
  std::vector<FrameResult> frames = sample.drive(0, 1);
  EndState& last = frames.front().world.receivers.back();
  last.present = true;
  while (sample.config.receivers.size() < receivers) {
    sample.config.receivers.push_back({.name = "r" + std::to_string(sample.config.receivers.size())});
    EndState next = frames.front().world.receivers.back();
    next.position_m.x += 1;
    frames.front().world.receivers.push_back(next);
  }
  write_outputs(folder.path("run"), sample.run(), frames);
  return folder.path("run");
}

Outcome convert(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "convert");
  return run_program(arguments);
}

}  // namespace

TEST_CASE("the list names every format") {
  const Outcome list = convert({"--list"});
  CHECK(list.code == 0);
  for (const Exporter& each : exporters()) {
    CAPTURE(each.name);
    CHECK(contains("\n" + list.out, "\n" + std::string(each.name) + " "));
    CHECK(contains(list.out, *each.suffix ? std::string(" ") + each.suffix + " " : " folder "));
    CHECK(contains(list.out, each.doc));
  }
}

TEST_CASE("the suffix decides where it says enough") {
  const Folder folder;
  const std::string run = sample_folder(folder);
  const Outcome npz = convert({run, "-o", folder.path("deep/er/out.npz"), "--frames", "6:7"});
  CHECK(npz.code == 0);
  CHECK(contains(npz.out, "out.npz"));
  CHECK(convert({run + "/paths.h5", "-o", folder.path("out.mat")}).code == 0);

  const Outcome unknown = convert({run, "-o", folder.path("out")});
  CHECK(unknown.code == 2);
  CHECK(contains(unknown.err, "add --to with one of sionna, deepmimo"));
  const Outcome other = convert({run, "--to", "ns3", "-o", folder.path("out.npz")});
  CHECK(other.code == 2);
  CHECK(contains(other.err, "this suffix belongs to the format sionna, but --to says ns3"));
}

TEST_CASE("errors say what to do, and leave nothing behind") {
  const Folder folder;
  const std::string run = sample_folder(folder);
  const Outcome misspelt = convert({run, "--to", "sionan", "-o", folder.path("x/y")});
  CHECK(misspelt.code == 2);
  CHECK(contains(misspelt.err, "did you mean \"sionna\"?"));
  const Outcome frames = convert({run, "-o", folder.path("x/out.npz"), "--frames", "3:4"});
  CHECK(frames.code == 2);
  CHECK(contains(frames.err, "has frames 5 to 9"));
  CHECK(convert({run, "-o", folder.path("x/out.npz"), "--frames", "12"}).code == 2);
  CHECK(folder.entries() == 1);  // the run

  CHECK(
      contains(convert({run, "--to", "sionna", "-o", run}).err, "this is a folder, but the format sionna is one file"));
  CHECK(contains(convert({run, "--to", "ns3", "-o", folder.file("a", "b")}).err,
                 "this is a file, but the format ns3 is a folder"));
  const Outcome full = convert({run, "--to", "ns3", "-o", run});
  CHECK(full.code == 3);
  CHECK(contains(full.err, "exists already"));
  const Outcome nothing = convert({folder.path("nowhere"), "-o", folder.path("out.npz")});
  CHECK(nothing.code == 3);
  CHECK(contains(nothing.err, "there is no such file"));
  CHECK(convert({}).code == 2);
  CHECK(convert({run}).code == 2);
}

TEST_CASE("ns3: more files than a file system bears are refused, with their number") {
  const Folder folder;
  const std::string run = crowded_folder(folder, 1000);
  const Outcome outcome = convert({run, "--to", "ns3", "-o", folder.path("out")});
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "ns3: 1002 nodes would be 1003002 files"));
  CHECK(contains(outcome.err, "at most 1000000 are written"));
  CHECK(folder.entries() == 1);
}

TEST_CASE("an export that is interrupted leaves nothing behind") {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Folder folder;
    const std::string run = crowded_folder(folder, 50);
    const Gate gate;  // all files are there, under the temporary name of their folder
    Program program({"convert", run, "--to", "ns3", "-o", folder.path("out/")}, gate.at_sync());
    gate.wait_for(1);
    REQUIRE(folder.entries() > 1);
    program.signal(signal);
    const Outcome outcome = program.wait();
    CHECK(outcome.code == 130);
    CHECK(contains(outcome.err, "interrupted; nothing was written"));
    CHECK(folder.entries() == 1);
  }
}
