// SPDX-License-Identifier: Apache-2.0
// The program without a device: config and input errors, init, validate.
// Each error must have its exit code, name the place and the fault, and leave no file behind.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include "folders.hpp"
#include "program.hpp"
#include "refused.hpp"

namespace {

const std::string ends =
    "[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 6]\n[[receiver]]\nname = \"r\"\nposition_m = [50, 0, 2]\n";
const std::string city = "scene.generate = \"--blocks 2\"\n";

}  // namespace

TEST_CASE("config errors exit 2 with file, line and column, and write nothing") {
  const Folder folder;
  const std::string file = folder.file("a.toml", city + "[trace]\nray = 5\n" + ends);
  check(run_program({"run", "-c", file, "-o", folder.path("out")}), 2,
        file + ":3:1: unknown key \"trace.ray\"; did you mean \"trace.rays\"?\n");
  check(run_program({"validate", "-c", file}), 2, file + ":3:1: unknown key");
  const std::string good = folder.file("b.toml", city + ends);
  check(run_program({"validate", "-c", good, "--set", "trace.rays=0"}), 2, "--set trace.rays=0: trace.rays = 0");
  check(run_program({"run", "-c", good, "-o", folder.path("out"), "--set", "trace.max_diffractions=9"}), 2,
        "trace.max_diffractions = 9 is out of range");
  check(run_program({"validate", "-c", good, "--set", "scene.generate=--stories 3"}), 2, "--stories");
  check(run_program({"validate", "-c", folder.path("absent.toml")}), 2, "absent.toml: cannot be read");
  CHECK(folder.entries() == 2);
}

TEST_CASE("validate refuses what only the radio part of a run reads: materials and antenna patterns") {
  const Folder folder;
  const std::string file = folder.file("a.toml", city + ends);
  check(run_program({"validate", "-c", file, "--set", "radio.frequency_hz=2e8"}), 2,
        "the material \"concrete\" is only known from 1 to 100 GHz");
  const std::string pattern = folder.file("broken.csv", "theta_deg,phi_deg\n0,0\n");
  check(run_program({"validate", "-c", file, "--set", "transmitter.0.antenna=" + pattern}), 3,
        pattern + ":1: an antenna pattern begins with the header");
  CHECK(run_program({"validate", "-c", file}).code == 0);
}

TEST_CASE("validate refuses a cache that is too small for those who launch rays, in the words of a run") {
  const Folder folder;
  const std::string file =
      folder.file("a.toml", city + ends + "[[transmitter]]\nname = \"t2\"\nposition_m = [0, 5, 6]\n");
  const auto validate = [&](const std::string& size) {
    return run_program({"validate", "-c", file, "--set", "cache.kind=open", "--set", "cache.buffer_size=" + size});
  };
  check(validate("31"), 2,
        "cache.buffer_size = 31 is too small: 2 transmitters share it evenly, and each needs 16 entries; give 32");
  CHECK(validate("32").code == 0);
}

TEST_CASE("a vehicle type without a body needs no sizes, whatever its name is") {
  const Folder folder;
  folder.file(
      "a.fcd.xml",
      "<fcd-export><timestep time=\"0\"><vehicle id=\"a\" x=\"0\" y=\"0\" angle=\"0\" type=\"ped\" speed=\"1\"/>"
      "</timestep></fcd-export>");
  const std::string file = folder.file("a.toml", city + ends +
                                                     "[trajectories]\nfile = \"a.fcd.xml\"\n[[vehicle_type]]\n"
                                                     "name = \"ped\"\nmodel = \"none\"\n");
  CHECK(run_program({"validate", "-c", file}).code == 0);
  check(run_program({"validate", "-c", file, "--set", "vehicle_type.0.model=car"}), 2, "give length_m, width_m");
}

TEST_CASE("pipes and devices are no input files, and are not waited for") {
  const Folder folder;
  const std::string pipe = folder.path("pipe"), file = folder.file("a.toml", city + ends), out = folder.path("out");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  for (const auto& [path, said] : {std::pair{pipe, "is a pipe;"}, {std::string("/dev/zero"), "is a device;"}}) {
    CAPTURE(path);
    check(run_program({"validate", "-c", path}), 2, path + ": cannot be read as a config file: " + said);
    check(run_program({"scene", "info", path}), 3, path + ": " + said);
    check(run_program({"view", path}), 3, path + ": " + said);
    check(run_program({"convert", path, "--to", "vtk", "-o", out}), 3, path + ": " + said);
    check(run_program({"validate", "-c", file, "--set", "scene.generate=", "--set", "scene.file=" + path}), 3,
          path + ": " + said);
    for (const char* key : {"trajectories.file", "transmitter.0.antenna"})
      check(run_program({"validate", "-c", file, "--set", std::string(key) + "=" + path}), 3, path + ": " + said);
  }
  const std::string materials = folder.file("a.obj", "mtllib pipe\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  // Files named by an OBJ file do not block it either.
  check(run_program({"scene", "info", materials}), 3, "has no material");
  CHECK(folder.entries() == 3);
}

TEST_CASE("missing input files exit 3 and name the key") {
  const Folder folder;
  const std::string file = folder.file("a.toml", "scene.file = \"absent.xml\"\n" + ends);
  check(run_program({"run", "-c", file, "-o", folder.path("out")}), 3,
        "scene.file is \"" + folder.path("absent.xml") + "\", which cannot be read: No such file");
  check(run_program({"validate", "-c", file}), 3, "scene.file");
  const std::string antenna = folder.file("b.toml", city + ends + "antenna = \"absent.csv\"\n");
  check(run_program({"validate", "-c", antenna}), 3, "receiver.antenna is \"" + folder.path("absent.csv"));
  check(run_program({"scene", "info", folder.path("absent.xml")}), 3, "absent.xml");
  const std::string drive = folder.file("c.toml", city + ends + "[trajectories]\nfile = \"absent.fcd.xml\"\n");
  for (const char* command : {"validate", "run"})
    check(
        run_program({command, "-c", drive}), 3,
        drive + ": trajectories.file is \"" + folder.path("absent.fcd.xml") + "\", which cannot be read: No such file");
  CHECK(folder.entries() == 3);
}

TEST_CASE("traffic in the streets of another city exits 2 and says what differs") {
  const Folder folder;
  const auto validate = [&](const std::string& houses, const std::string& traffic) {
    const std::string file = folder.file(
        "a.toml", "scene.generate = \"" + houses + "\"\ntrajectories.generate = \"" + traffic + "\"\n" + ends);
    return run_program({"validate", "-c", file});
  };
  const std::string differs = "trajectories.generate has the streets of --blocks 6x6 --block-m 80 --street-m ";
  check(validate("--blocks 4", "--vehicles 3"), 2,
        folder.path("a.toml") + ": " + differs + "20, scene.generate those of --blocks 4x4 --block-m 80 --street-m 20");
  check(validate("--seed 1", "--vehicles 3 --street-m 16"), 2, differs + "16, scene.generate those of --blocks 6x6");
  check(validate("--block-m 100", "--block-m 90"), 2, "vehicles would drive through houses; give both the same");
  // Defaults count as if they were given, and houses do not matter.
  CHECK(validate("--blocks 6 --floors 2:3", "--seed 5 --blocks=6x6 --street-m 20").code == 0);
}

TEST_CASE("validate warns of antennas and vehicles in places that cannot be meant, and refuses those out of reach") {
  const Folder folder;
  const auto validate = [&](const std::string& text) {
    return run_program({"validate", "-c", folder.file("a.toml", "scene.generate = \"--blocks 2\"\n" + text)});
  };
  const std::string mast = "[[transmitter]]\nname = \"mast\"\nposition_m = ",
                    car = "[[receiver]]\nname = \"car\"\nposition_m = [0, 3, 2]\n";
  const Outcome deep = validate(mast + "[0, 0, -1.5]\n" + car);
  CHECK(deep.code == 0);
  CHECK(deep.err ==
        "warning: transmitter \"mast\" is 1.5 m below the ground there, \"ground\"; above = \"ground\" lets its height "
        "count from the ground\n");
  CHECK(contains(deep.out, ": ok\n"));
  check(validate(mast + "[1e8, 0, 6]\n" + car), 2, "transmitter \"mast\" is at [1e+08, 0, 6] m");
  const std::string drive =
      mast + "[0, 0, 6]\n[[mount]]\nname = \"roof\"\noffset_m = [0, 0, 1.6]\n[[track]]\nid = \"ego\"\n";
  const Outcome floats = validate(drive + "waypoints = [[0, -20, -3, 9], [2, 20, -3, 9]]\n");
  CHECK(floats.code == 0);
  CHECK(
      contains(floats.err, "warning: 1 of 1 vehicles are above the ground, the first one \"ego\" by 9 m from 0 s on"));
  check(validate(drive + "waypoints = [[0, -20, -3, 0], [2, 20, -3, 0]]\n[time]\nstart_s = 10\n"), 2,
        "[time] begins at 10 s, and the trajectories go from 0 to 2 s");
}

TEST_CASE("an output folder that cannot be written to exits 1 before anything is traced") {
  const Folder folder;
  const std::string file = folder.file("a.toml", city + ends);
  check(run_program({"run", "-c", file, "-o", file + "/out"}), 1, file + "/out: cannot write there");
  check(run_program({"run", "-c", file, "-o", std::string(300, 'x')}), 1, "name too long");
  check(run_program({"run", "-c", std::string(300, 'x')}), 2, "cannot be read as a config file");
  if (geteuid() == 0) return;  // permissions do not apply to root
  chmod(folder.path().c_str(), 0500);
  check(run_program({"run", "-c", file, "-o", folder.path("out")}), 1, "Permission denied");
  chmod(folder.path().c_str(), 0700);
  CHECK(folder.entries() == 1);
}

TEST_CASE("without any OpenCL platform the exit code is 4 and the message says what to install") {
  const Folder folder, no_vendors;
  const std::string file = folder.file("a.toml", city + ends);
  const std::vector<std::string> environment = {"OCL_ICD_VENDORS=" + no_vendors.path()};
  const Outcome devices = run_program({"devices"}, environment);
  if (devices.code == 0) {
    MESSAGE("skipped: this OpenCL loader finds devices whatever OCL_ICD_VENDORS says");
    return;
  }
  check(devices, 4, "pocl-opencl-icd");
  const Outcome run = run_program({"run", "-c", file, "-o", folder.path("out")}, environment);
  check(run, 4, "pocl-opencl-icd");
  CHECK(folder.entries() == 1);
}

TEST_CASE("init, then validate") {
  const Folder folder;
  const Outcome init = run_program({"init"});
  CHECK(init.code == 0);
  const std::string file = folder.file("a.toml", init.out);
  const Outcome validate = run_program({"validate", "-c", file});
  CHECK(validate.code == 0);
  CHECK(validate.err.empty());
  CHECK(contains(validate.out, file + ": ok\n"));
  CHECK(contains(validate.out, "; 200,000 rays per transmitter, depth 5"));
  const Outcome beams = run_program({"validate", "-c", file, "--set", "trace.discovery=beams"});
  CHECK(contains(beams.out, "; beams per transmitter, depth 5"));
  const Outcome either = run_program({"validate", "-c", file, "--set", "trace.discovery=auto"});
  CHECK(contains(either.out, "; beams or 200,000 rays per transmitter, depth 5"));
  for (const char* line : {"\nkind = \"none\"\n", "\nhit_point = \"own\"\n", "\nwaypoints = 0\n"})
    CHECK(contains(init.out, line));
}

TEST_CASE("first configurations run as they are, that of SUMO with the reader's files") {
  const Folder folder;
  for (const std::string kind : {"--minimal", "--coverage"}) {
    const Outcome init = run_program({"init", kind});
    CHECK(std::ranges::count(init.out, '\n') < 30);
    CHECK(run_program({"validate", "-c", folder.file("a.toml", init.out)}).code == 0);
  }
  CHECK(
      run_program({"scene", "city", "-o", folder.path("town"), "--blocks", "2x2", "--vehicles", "3", "--seconds", "1"})
          .code == 0);
  const std::string sumo = folder.file("sumo.toml", run_program({"init", "--sumo"}).out);
  check(run_program({"validate", "-c", sumo}), 3, "scene.streets is ");
  const std::string net = folder.file("town.net.xml", "<net/>");
  check(run_program({"validate", "-c", sumo}), 3, "trajectories.file is ");
  const std::vector<std::string> with_drive{"validate", "-c", sumo, "--set",
                                            "trajectories.file=" + folder.path("town/drive.fcd.xml")};
  check(run_program(with_drive), 3, net + ": the network has no lane");
  folder.file("town.net.xml", "<net><edge><lane shape=\"0,0 1,1\"/></edge></net>");
  CHECK(run_program(with_drive).code == 0);
  check(run_program({"init", "--minimal", "--sumo"}), 2, "give only one of them");
}

TEST_CASE("hints at misspelt keys are those of their table, a map as a scene names convert, no body needs no size") {
  const Folder folder;
  const Outcome keys = run_program(
      {"validate", "-c",
       folder.file("a.toml", "[[mount]]\nnaem = \"a\"\n[[vehicle_type]]\nlenght_m = 3\n[[track]]\nidd = \"a\"\n")});
  for (const char* meant : {"mount.name", "vehicle_type.length_m", "track.id"})
    CHECK(contains(keys.err, std::string("did you mean \"") + meant + "\"?"));
  folder.file("town.osm", "<osm version=\"0.6\"/>");
  check(run_program({"validate", "-c", folder.file("b.toml", "[scene]\nfile = \"town.osm\"\n" + ends)}), 3,
        "`wavetracer convert ");
  CHECK(run_program({"validate", "-c",
                     folder.file("c.toml", city + ends + "[[vehicle_type]]\nname = \"ghost\"\nmodel = \"none\"\n")})
            .code == 0);
}

TEST_CASE("the configs that come with the program are valid") {
  for (const std::string name : {"cache", "city", "demo", "drive", "edges", "radar"}) {
    const Outcome validate =
        run_program({"validate", "-c", wavetracer::test::source_folder() + "/configs/" + name + ".toml"});
    CAPTURE(validate.err);
    CHECK(validate.code == 0);
  }
}

TEST_CASE("what diffraction excludes, and a key that was taken away, is said before anything is traced") {
  const Folder folder;
  const std::string file = folder.file("a.toml", city + "trace.diffraction = true\ntrace.join = true\n" + ends);
  check(run_program({"run", "-c", file, "-o", folder.path("out")}), 2,
        file + ":3:7: trace.join no longer exists, because rays towards the horizon find more paths in the same time");
  check(run_program({"run", "-c", file, "-o", folder.path("out"), "--set", "trace.join=false", "--set",
                     "trace.reception=sphere"}),
        2, "--set trace.reception=sphere: trace.reception = \"sphere\" receives reflected rays only");
  CHECK(folder.entries() == 1);
}
