// SPDX-License-Identifier: Apache-2.0
// The command line of the program: version, help, hints at misspelt words, usage errors.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <filesystem>
#include <utility>
#include "folders.hpp"
#include "program.hpp"
#include "refused.hpp"
#include "wavetracer/version.hpp"

TEST_CASE("--version and --help") {
  const Outcome version = run_program({"--version"});
  CHECK(version.code == 0);
  CHECK(version.out.starts_with("wavetracer " WAVETRACER_VERSION "\n"));
}

TEST_CASE("help has ranges of numbers in words, and refusals name them") {
  using Words = std::vector<std::string>;
  for (const Words& words : {Words{"help", "run"},
                             {"help", "scene", "materials"},
                             {"help", "thesis"},
                             {"help", "accuracy"},
                             {"help", "calibrate"},
                             {"help", "view"}}) {
    CAPTURE(words.back());
    const Outcome help = run_program(words);
    CHECK(help.code == 0);
    CHECK_FALSE(contains(help.out, " in ["));
  }
  CHECK(contains(run_program({"help", "calibrate"}).out, "--folds UINT:0 to 100=4"));
  CHECK(contains(run_program({"help", "run"}).out, "1 to 1,000,000"));
  const Outcome refused = run_program({"calibrate", "-c", "a.toml", "--measured", "b.csv", "--folds", "101"});
  CHECK(refused.code == 2);
  CHECK(contains(refused.err, "--folds: 101 is not a whole number from 0 to 100"));
}

TEST_CASE("help is about what was asked: a command on a page, the keys of configurations by themselves") {
  using Words = std::vector<std::string>;
  for (const Words& words : {Words{"--help"},
                             {"help"},
                             {"run", "-h"},
                             {"help", "run"},
                             {"scene", "city", "--help"},
                             {"help", "scene", "city"},
                             {"thesis", "--help"},
                             {"help", "help"}}) {
    CAPTURE(words.back());
    const Outcome help = run_program(words);
    CHECK(help.code == 0);
    CHECK(help.err.empty());
    CHECK(contains(help.out, "Usage: wavetracer"));
    CHECK(contains(help.out, "`wavetracer help config`") !=
          (words.front() == "thesis"));  // lists its experiments there
    CHECK_FALSE(contains(help.out, "trace.max_depth"));
    CHECK(std::ranges::count(help.out, '\n') < 50);
  }
  CHECK(run_program({"help", "run"}).out == run_program({"run", "--help"}).out);
  CHECK(run_program({"help", "scene", "city"}).out == run_program({"scene", "city", "--help"}).out);
  const Outcome experiments = run_program({"thesis"});
  CHECK(experiments.code == 0);
  CHECK(experiments.err.empty());
  CHECK(contains(experiments.out, "  figure-6.18 "));
  CHECK(contains(experiments.out, "  all "));
  const Outcome keys = run_program({"help", "config"});
  CHECK(keys.code == 0);
  CHECK(contains(keys.out, "trace.max_depth"));
  CHECK(contains(keys.out, "cache.residual_value"));
  const Outcome rays = run_program({"help", "trace.rays"});
  CHECK(rays.code == 0);
  CHECK(contains(rays.out, "  trace.rays\n"));
  CHECK_FALSE(contains(rays.out, "trace.max_depth"));
  CHECK(run_program({"help", "rays"}).out == rays.out);
  CHECK(contains(run_program({"help", "receiver_grid"}).out, "receiver_grid.step_m"));
  const Outcome scene = run_program({"help", "scene"});  // a command and a table
  CHECK(contains(scene.out, "Usage: wavetracer scene"));
  CHECK(contains(scene.out, "\n  scene.file\n"));
  check(run_program({"help", "trace.ray"}), 2, "help: there is no key \"trace.ray\"; did you mean \"trace.rays\"?");
  check(
      run_program({"help", "trace.diffr"}), 2,
      "\"trace.diffr\"; these keys begin so: trace.diffraction, trace.diffraction_floor_db, trace.diffraction_range_db, trace.diffraction_rays");
  check(run_program({"help", "confg"}), 2, "help: there is nothing about \"confg\"; did you mean \"config\"?");
}

TEST_CASE("a configuration that is not there, and an empty one") {
  const Folder folder;
  const std::string here = std::filesystem::current_path().string();
  check(run_program({"run", "-c", "nowhere.toml"}), 2, "no such file; it was looked for in " + here + ";");
  check(run_program({"run", "-c", folder.path("nowhere.toml")}), 2, "no such file; `wavetracer init`");
  check(run_program({"run", "here.toml"}), 2,
        "\"here.toml\" is not expected here, a configuration comes after -c; see");
  check(run_program({"run"}), 2, "--config is required: -c FILE (`wavetracer init --minimal` prints a first one)");
  check(run_program({"run", "-c", folder.file("binary.toml", "\x89HDF\r\n\xff\xfe")}), 2,
        "binary.toml: this is no text");
  const std::string text = folder.file("text.toml", "a = 1\n");
  check(run_program({"view", text}), 3,
        "this is no paths.h5 of a run, which would be a file of HDF5; a configuration is");
  check(run_program({"view", folder.file("text.h5", "a = 1\n")}), 3, "; name the folder that `wavetracer run -o` has");
  check(run_program({"run", "-c", folder.file("empty.toml", "")}), 2, "cannot be read as a config file: it is empty;");
}

TEST_CASE("misspelt commands, options and choices are answered with what was meant") {
  check(run_program({"rum"}), 2,
        "wavetracer: there is no command \"rum\"; did you mean \"run\"? See `wavetracer help`\n");
  check(run_program({"run", "--devise", "x"}), 2,
        "wavetracer: run: there is no option --devise; did you mean \"--device\"? See `wavetracer help run`\n");
  check(run_program({"run", "--devise=x"}), 2, "did you mean \"--device\"?");
  check(run_program({"scene", "inf"}), 2, "scene: there is no command \"inf\"; did you mean \"info\"?");
  check(run_program({"scene"}), 2,
        "scene: name one of them: info or materials or city or radar; see `wavetracer help scene`");
  check(run_program({"run", "-c"}), 2, "run: --config needs a value");
  check(run_program({"init", "x"}), 2, "init: \"x\" is not expected here");
  check(run_program({"plot", "x", "--format", "svh"}), 2, "svh not in {svg,png,pdf}; did you mean \"svg\"?");
  check(run_program({"convert", "x", "-o", "y", "--to", "vkt"}), 2, "did you mean \"vtk\"?");
  check(run_program({"convert", "nope.osm", "-o", "y"}), 3, "nope.osm: there is no such file or folder");
  check(run_program({"thesis", "figur-6.2"}), 2, "did you mean \"figure-6.2\"?");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"bench"}, {"bench", "figure-6.2", "-o", "x", "--quick"}, {"help", "bench"}}) {
    CAPTURE(words.size());
    check(run_program(words), 2, "\"bench\"; the experiments of the thesis are run by `wavetracer thesis`; ");
  }
  check(run_program({"plot"}), 2, "plot: RUN is required; see `wavetracer help plot`");
}

TEST_CASE("values that an option cannot take are answered with what it takes") {
  const Folder folder;
  const std::string file = folder.file("a.toml", city + ends);
  check(run_program({"run", "-c", file, "--repeat", "x"}), 2,
        "run: --repeat: x is not a whole number from 1 to 1,000,000; see");
  check(run_program({"run", "-c", file, "--repeat", "-1"}), 2, "--repeat: -1 is not a whole number from 1 to");
  check(run_program({"scene", "info", file, "--scale", "-1"}), 2, "--scale: -1 is not a number above 0; see");
  check(run_program({"scene", "materials", "--frequency", "1"}), 2,
        "--frequency: 1 is not a number from 1,000,000 to 1,000,000,000,000; see");
  check(run_program({"view", file, "--max-paths", "0"}), 2, "--max-paths: 0 is not a number above 0; see");
  check(run_program({"plot", file, "--frame", "x"}), 2, "plot: --frame: x is not a whole number of 0 or more; see");
  check(run_program({"merge", folder.path("nowhere")}), 3, "nowhere: there is no such folder; name one that");
  using Words = std::vector<std::string>;
  for (const Words& words : {Words{"run", "-c", ""},
                             {"run", "-c", file, "--devices", ""},
                             {"run", "-c", file, "-o", ""},
                             {"view", ""},
                             {"merge", ""},
                             {"convert", "", "-o", "y"},
                             {"scene", "info", ""},
                             {"scene", "city", "--blocks", ""},
                             {"serve", "-c", file, "--listen", ""}}) {
    CAPTURE(words.size());
    check(run_program(words), 2, ": the value is empty; see `wavetracer help " + words.front());
  }
  for (const auto& [option, value] : {std::pair{"--blocks", "x"}, {"--blocks", "6xx"}, {"--floors", "3:"}})
    check(run_program({"scene", "city", "-o", folder.path("city"), option, value}), 2,
          fmt::format("city: {} '{}' must be one or two integers from 1 to 100, such as 3 or ", option, value));
  check(run_program({"scene", "city", "-o", folder.path("city"), "--blocks", "6 x 6"}), 2,
        "'6 x 6' must have no blanks");
  CHECK(folder.entries() == 1);
}

TEST_CASE("usage errors exit 2") {
  const Folder folder;
  const std::string file = folder.file("a.toml", city + ends);
  check(run_program({}), 2, "Subcommands:");
  check(run_program({"runn"}), 2, "runn");
  check(run_program({"run"}), 2, "--config is required");
  check(run_program({"run", "-c", file, "--repeat", "0"}), 2, "--repeat");
  check(run_program({"run", "-c", file, "--nonsense"}), 2, "--nonsense");
  check(run_program({"accuracy", "-c", file, "--inputs", "--position", "nan"}), 2, "nan is not a finite number");
  check(run_program({"accuracy", "-c", file, "--inputs", "--permittivity", "-nan"}), 2, "--permittivity");
  check(run_program({"thesis", "rays", "--minutes", "nan"}), 2, "nan is not a finite number");
  check(run_program({"scene", "materials", "--frequency", "nan"}), 2, "nan is not a finite number");
  check(run_program({"scene", "info", file, "--scale", "inf"}), 2, "--scale: inf is not a finite number");
  check(run_program({"convert", file, "-o", folder.path("map"), "--level-height", "nan"}), 2, "nan is not a finite");
  check(run_program({"run", "-c", file, "--set", "trace.tile_m=nan"}), 2, "trace.tile_m = nan is out of range");
  check(run_program({"run", "-c", file, "--frames", "0:5"}), 2, "--frames 0:5: this run has frame 0 only");
  check(run_program({"run", "-c", file, "--resume"}), 2, "--resume: a run without trajectories has only one frame");
  check(run_program({"thesis", "rays"}), 2, "no experiment \"rays\"");
  check(run_program({"scene", "city", "-o", folder.path("city"), "--blocks", "0"}), 2, "--blocks");
  CHECK(folder.entries() == 1);
}

TEST_CASE("tables of wall classes that convert writes are tables of a configuration") {
  const Folder folder;
  std::string map = "<osm version=\"0.6\">\n";
  int node = 0;
  const auto add_house = [&](const char* material) {
    const double south = 48.137 + 0.001 * node, north = south + 0.0002;
    std::string corners;
    for (const auto& [lat, lon] : {std::pair{south, 11.575}, {south, 11.5753}, {north, 11.5753}, {north, 11.575}}) {
      map += fmt::format("<node id=\"{}\" lat=\"{:.7f}\" lon=\"{:.7f}\"/>\n", ++node, lat, lon);
      corners += fmt::format("<nd ref=\"{}\"/>", node);
    }
    map += fmt::format(
        "<way id=\"{0}\">{1}<nd ref=\"{2}\"/><tag k=\"building\" v=\"yes\"/>"
        "<tag k=\"building:material\" v=\"{3}\"/></way>\n",
        node, corners, node - 3, material);
  };
  for (const char* material : {"brick", "concrete", "stone", "glass", "metal", "wood"}) add_house(material);
  const std::string file = folder.file("town.osm", map + "</osm>\n"), out = folder.path("town");
  const Outcome converted = run_program({"convert", file, "-o", out, "--wall-classes"});
  CAPTURE(converted.err);
  REQUIRE(converted.code == 0);
  const std::string tables = contents(out + "/materials.toml");
  CHECK(std::ranges::count(tables, '\n') > 20);
  const std::string config =
      folder.file("c.toml", "scene.file = \"town/city.xml\"\ntrace.scattering = true\n" + ends + tables);
  const Outcome valid = run_program({"validate", "-c", config});
  CAPTURE(valid.err);
  CHECK(valid.code == 0);
  const Outcome info = run_program({"scene", "info", out + "/city.xml"});
  for (const char* name : {"brick_wall", "concrete_wall", "stone_wall", "glass_wall", "metal_wall", "wood_wall"}) {
    CHECK(contains(tables, fmt::format("name = \"{}\"", name)));
    CHECK(contains(info.out, name));
  }
}
