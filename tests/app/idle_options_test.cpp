// SPDX-License-Identifier: Apache-2.0
// Options that would change nothing are refused, before anything is computed or written.
#include <doctest/doctest.h>
#include <filesystem>
#include <vector>
#include "folders.hpp"
#include "output/sample_run.hpp"
#include "refused.hpp"

namespace {

using Words = std::vector<std::string>;

struct Refused {
  Words words;
  std::string message;
};

const std::string antennas =
    "scene.generate = \"--blocks 2\"\n[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 6]\n"
    "[[receiver]]\nname = \"r\"\nposition_m = [50, 0, 2]\n";

void check_all(const std::vector<Refused>& all) {
  for (const auto& [words, message] : all) {
    CAPTURE(message);
    check(run_program(words), 2, message);
  }
}

}  // namespace

TEST_CASE("options of run that name devices or processes twice are refused") {
  const Folder folder;
  const std::string file = folder.file("a.toml", antennas);
  check_all({{{"run", "-c", file, "--devices", "0", "--device", "1"}, "--devices and --device both name devices"},
             {{"run", "-c", file, "--frames", "x"}, "--frames x: give the first and the last frame as A:B"}});
  const Outcome rank = run_program({"run", "-c", file, "--processes", "2"},
                                   {"OMPI_COMM_WORLD_RANK=0", "OMPI_COMM_WORLD_SIZE=2", "OMPI_MCA_ess_base_jobid=7"});
  check(rank, 2, "--processes: this process is rank 0 of 2 already");
  CHECK(folder.entries() == 1);
}

TEST_CASE("options of studies that their kind does not heed are refused") {
  const Folder folder;
  const std::string file = folder.file("a.toml", antennas), out = folder.path("out");
  check_all({
      {{"accuracy", "-c", file, "-o", out, "--inputs", "--rays", "1e4:1e5"}, "--rays: --inputs compares samples"},
      {{"accuracy", "-c", file, "-o", out, "--inputs", "--repeat", "2"}, "--repeat: --inputs compares samples"},
      {{"accuracy", "-c", file, "-o", out, "--inputs", "--no-certify"}, "--certify: --inputs compares samples"},
      {{"calibrate", "-c", file, "-o", out, "--measured", file, "--fit", "none", "--prior", "2"},
       "--prior: --fit none fits nothing; leave it out"},
      {{"serve", "-c", file, "--peer", "127.0.0.1"}, "--peer: this option is for --protocol van3twin"},
      {{"thesis", "--rays", "1000:2000"}, "--rays: no experiment is named"},
      {{"thesis", "figure-6.1", "-o", out, "--frames", "3"}, "--frames: it is for experiments with the frames"},
      {{"thesis", "figure-6.13", "-o", out, "--minutes", "3"}, "--minutes: it is for figures of orders"},
      {{"thesis", "coherence-frames", "-o", out, "--repeat", "3"}, "--repeat: this experiment compares hits"},
  });
  CHECK(folder.entries() == 1);
}

TEST_CASE("options of convert are those of a run or of a map, as the input is one") {
  const Folder folder;
  const std::string run = wavetracer::test::source_folder() + "/configs/sumo/town.poly.xml", out = folder.path("out");
  check_all({
      {{"convert", run, "-o", out, "--projection", "+proj=utm +zone=32"}, "--projection: SUMO's polygons have"},
      {{"convert", run, "-o", out, "--terrain-error", "1"}, "--terrain-error: there is no --terrain"},
      {{"convert", run, "-o", out, "--no-ground", "--margin", "9"}, "--margin: --no-ground leaves out the ground"},
      {{"convert", folder.path(), "-o", out + ".npz", "--net", "n"}, "--net: this option is for maps, but "},
      {{"convert", folder.path(), "-o", out + ".npz", "--no-ground"}, "--no-ground: this option is for maps, but "},
  });
  CHECK(folder.entries() == 0);
}

TEST_CASE("options of plot that no figure heeds are refused") {
  const Folder folder;
  const wavetracer::SampleRun sample;
  const std::vector<wavetracer::FrameResult> frames = sample.frames();
  const wavetracer::Run made = sample.run();
  wavetracer::write_outputs(folder.path("run"), made, frames);
  const std::string run = folder.path("run");
  check_all({
      {{"plot", run, "--layer", "sinr_db"}, "--layer: the run has no [[receiver_grid]], so no map is drawn"},
      {{"plot", run, "--grid", "g"}, "--grid: the run has no [[receiver_grid]]"},
      {{"plot", run, "--what", "gain", "--frame", "7"}, "--frame: the figures of --what show all frames"},
      {{"plot", run, "--what", "rays", "--tx", "t"}, "--tx: none of the figures of --what is about a transmitter"},
      {{"plot", run, "--what", "coverage", "--rx", "r"}, "--rx: none of the figures of --what is about a link"},
      {{"convert", run, "-o", run + ".npz", "--projection", "+proj=utm"}, "--projection: the format sionna has"},
  });
  CHECK_FALSE(std::filesystem::exists(run + "/plots"));
}
