// `wavetracer convert` as it is typed: formats by name and by suffix, frames by number, and its words where they are
// not.
#include <doctest/doctest.h>
#include "app/program.hpp"
#include "output/output.hpp"
#include "output/sample_run.hpp"

using namespace wavetracer;

namespace {

// Frames 5 to 9: numbers do not begin with 0.
std::string sample_folder(const Folder& folder) {
  const SampleRun sample;
  write_outputs(folder.path("run"), sample.run(), sample.drive(5, 5));
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
  for (const char* name : {"sionna", "deepmimo", "ns3", "matlab", "vtk", "glb", "kml", ".npz", "folder"})
    CHECK(contains(list.out, name));
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
  CHECK(contains(other.err, "the suffix of sionna, but --to says ns3"));
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

  CHECK(contains(convert({run, "--to", "sionna", "-o", run}).err, "is a folder, but sionna is a file"));
  CHECK(contains(convert({run, "--to", "ns3", "-o", folder.file("a", "b")}).err, "is a file, but ns3 is a folder"));
  const Outcome full = convert({run, "--to", "ns3", "-o", run});
  CHECK(full.code == 3);
  CHECK(contains(full.err, "is there already"));
  const Outcome nothing = convert({folder.path("nowhere"), "-o", folder.path("out.npz")});
  CHECK(nothing.code == 3);
  CHECK(contains(nothing.err, "there is no such file"));
  CHECK(convert({}).code == 2);
  CHECK(convert({run}).code == 2);
}
