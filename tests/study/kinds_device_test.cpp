// SPDX-License-Identifier: Apache-2.0
// Tests every experiment with every kind of configuration: each gives a figure without gaps, or a message that names
// the experiment or the key. Few rays and one bounce; cache-division, whose rays cannot be fewer, is only tested for
// what it refuses.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sstream>
#include "app/program.hpp"
#include "study/experiment.hpp"
#include "study/occurrences.hpp"
#include "study/squeezed.hpp"
#include "study/thesis.hpp"

using namespace wavetracer::study;

namespace {

const std::string scene = "scene.generate = \"--blocks 1\"\ntrace.max_depth = 1\n";
const std::string mast = "[[transmitter]]\nname = \"mast\"\nposition_m = [0, -50, 6]\n";
const std::string receiver = "[[receiver]]\nname = \"car\"\nposition_m = [30, -50, 2]\n";
const std::string traffic =
    "[[track]]\nid = \"a\"\nwaypoints = [[0, 10, -53, 0], [1, 20, -53, 0]]\n"
    "[[track]]\nid = \"b\"\nwaypoints = [[0, 30, -53, 0], [1, 40, -53, 0]]\n[time]\nstep_s = 0.5\n";
const std::string parked =
    "[[track]]\nid = \"a\"\nwaypoints = [[0, 10, -53, 0]]\n[[track]]\nid = \"b\"\nwaypoints = [[0, 30, -53, 0]]\n";
const std::string later =
    "[[track]]\nid = \"a\"\nwaypoints = [[0, 10, -53, 0], [1, 20, -53, 0]]\n"
    "[[track]]\nid = \"b\"\nwaypoints = [[0.5, 30, -53, 0], [1, 40, -53, 0]]\n[time]\nstep_s = 0.5\n";
const std::string grid = "[[receiver_grid]]\nname = \"g\"\nstep_m = 40\n";
const std::string second_mast = "[[transmitter]]\nname = \"mast 2\"\nposition_m = [20, -50, 8]\n";
const std::string live = "[[live_vehicle]]\ntype = \"passenger\"\n";
const std::string mount = "[[mount]]\nname = \"roof\"\noffset_m = [0, 0, 1.6]\n";

struct Kind {
  std::string name, text;
  // The error that is expected instead of a figure; empty: a figure.
  std::string of_experiments, of_series, of_drives, of_caches;
};

const std::string no_link = "no transmitter launches rays in the frames that are measured, because no link is wanted";
const std::string one_frame = "there is one frame alone";
const std::string needs_poses = "needs to know where vehicles are";
const std::string late_cache = "cache.first_depth = 2 is larger than trace.max_depth = 1";

const std::vector<Kind> kinds = {
    {"a mast and a receiver", mast + receiver, "", "", "", ""},
    {"vehicles alone", traffic + mount, "", "", "", ""},
    {"vehicles alone, in one frame", parked + mount, "", "", one_frame, ""},
    {"vehicles alone, in later frames", later + mount, "", "", "", ""},
    {"a mast and a grid", mast + grid, "", "", "", ""},
    {"two masts", mast + second_mast + receiver, "", "", "", ""},
    {"waves through walls", "trace.transmission = true\n" + mast + receiver, "", "", "", ""},
    {"rough walls", "[[material]]\nname = \"concrete\"\nscattering = 0.4\n" + mast + receiver, "", "", "", ""},
    {"no receiver", mast, "no [[receiver]]", "no [[receiver]]", "no [[receiver]]", "no [[receiver]]"},
    {"vehicles of a client", mount + live, needs_poses, needs_poses, needs_poses, needs_poses},
    {"a mast and vehicles with antennas", mast + receiver + traffic + mount, "", "", "", ""},
    {"links one way, by name", "links.transmitters = [\"mast\"]\nlinks.i2i = false\n" + mast + traffic + mount, "", "",
     "", ""},
    {"diffraction", "trace.diffraction = true\n" + mast + receiver, "", "", "", ""},
    {"spheres", "trace.reception = \"sphere\"\n" + mast + receiver, "", "", "", ""},
    {"no link", "links.i2i = false\n" + mast + receiver, "", no_link, no_link, no_link},
    {"a cache from later on", "cache.first_depth = 2\n" + mast + receiver, "", "", "", late_cache},
    {"no bounce", "trace.max_depth = 0\n" + mast + receiver, "trace.max_depth = 0", "trace.max_depth = 0",
     "trace.max_depth = 0", "trace.max_depth = 0"},
};

const std::string& answer(const Kind& kind, const Experiment& experiment) {
  if (experiment.study()) return kind.of_caches;
  if (experiment.as<OrderFigure>()) return experiment.moves() ? kind.of_drives : kind.of_series;
  return experiment.moves() && kind.of_drives == one_frame ? kind.of_drives : kind.of_experiments;
}

Outcome bench(const Experiment& experiment, const Folder& folder, const std::string& config) {
  std::vector<std::string> words = {"thesis", experiment.name, "-c", config, "-o", folder.path("out")};
  const bool of_orders = experiment.as<OrderFigure>() != nullptr, of_caches = experiment.study() != nullptr;
  // The fewest rays of the study, or of all figures of orders.
  if (of_caches && !experiment.one_ray_count())
    words.insert(words.end(), {"--rays", fmt::format("{0}:{0}", experiment.study()->rays.front())});
  else if (of_orders)
    words.insert(words.end(), {"--rays", "1000:1000"});
  if (of_caches || (of_orders && !experiment.moves())) words.insert(words.end(), {"--repeat", "1"});
  if (of_caches || experiment.moves()) words.insert(words.end(), {"--frames", "1"});
  return run_program(words);
}

// The first of the experiments that share its study; the test of `thesis all` below draws them all.
bool stands_for_its_study(const Experiment& experiment) {
  for (const Experiment& other : wavetracer::study::experiments())
    if (other.study() == experiment.study()) return other.name == experiment.name;
  return false;
}

// Tells in which kinds an experiment draws its figure here: caches and experiments launch many rays, so in one each,
// and figure-6.1 has a dozen series. The other figures of orders are drawn in every third kind each, so that every kind
// has a third of them: they share what is done with a kind.
bool drawn(const Kind& kind, const Experiment& experiment) {
  if (experiment.name == "figure-6.1") return kind.name == "vehicles alone, in later frames";
  if (experiment.as<OrderFigure>() || experiment.name == "figure-6.13")
    return (&kind - kinds.data() + (&experiment - wavetracer::study::experiments().data())) % 3 == 0;
  if (experiment.name == "coherence-rays") return kind.name == "vehicles alone, in one frame";
  if (experiment.study() && !stands_for_its_study(experiment)) return false;
  return experiment.name != "cache-division" && experiment.name != "coherence-frames" &&
         kind.name == "a mast and vehicles with antennas";
}

std::string config_of(const Kind& kind) {
  const bool own_depth = kind.text.starts_with("trace.max_depth");
  return (own_depth ? "scene.generate = \"--blocks 1\"\n" : scene) + kind.text;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

// Returns the columns of a table in which a number is undefined. Two kinds may have such numbers: the error of a mean
// needs several frames, and hits of one depth are not paired in no order, as whole outputs are.
std::string columns_with_gaps(const std::string& table) {
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line);
  std::string out;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    for (size_t i = 0; i < cells.size(); ++i)
      if (cells[i] == "nan" && !names.at(i).ends_with("_error_s") && names[i] != "by_place_unordered")
        out += names[i] + " ";
  }
  return out;
}

}  // namespace

TEST_CASE("every experiment, and every kind of configuration: a figure, or a message and exit code 2") {
  if (!device_present()) return;
  for (const Kind& kind : kinds) {
    CAPTURE(kind.name);
    const Folder folder;
    const std::string config = folder.file("a.toml", config_of(kind));
    for (const Experiment& experiment : wavetracer::study::experiments()) {
      CAPTURE(experiment.name);
      const std::string& refused = answer(kind, experiment);
      // Refusals follow one rule for all experiments with a study: one of them stands for the others.
      if (experiment.study() && !refused.empty() && experiment.name != "figure-6.5") continue;
      if (refused.empty() && !drawn(kind, experiment)) continue;
      const Outcome run = bench(experiment, folder, config);
      CAPTURE(run.err);
      const std::string table = contents(folder.path("out/" + experiment.name + ".csv"));
      if (!refused.empty()) {
        CHECK(run.code == 2);
        CHECK(contains(run.err, "a.toml:"));
        CHECK(contains(run.err, refused));
        CHECK(table.empty());
        continue;
      }
      CHECK(run.code == 0);
      CHECK(table.size() > 100);
      // Caches that nobody asked have no time a look-up: tables say nan there.
      if (!experiment.study()) CHECK(columns_with_gaps(table) == "");
    }
  }
}

TEST_CASE("figures of orders count each ray once: of masts, of vehicles, of a mast that is driven") {
  if (!device_present()) return;
  const Folder folder;
  // Rays of a frame, in the table.
  const auto launched = [&](const std::string& figure, const std::string& text) {
    const std::string config = folder.file("a.toml", scene + text);
    const Outcome run = bench(find_experiment(figure), folder, config);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    std::istringstream lines(contents(folder.path("out/" + figure + ".csv")));
    std::string heads, first, head, cell;
    std::getline(lines, heads);
    std::getline(lines, first);
    std::istringstream names(heads), cells(first);
    while (std::getline(names, head, ',') && std::getline(cells, cell, ','))
      if (head == "launched") return cell;
    return std::string("no such column");
  };
  CHECK(launched("figure-6.1", mast + receiver) == "1000");
  CHECK(launched("figure-6.1", mast + second_mast + receiver) == "2000");
  CHECK(launched("figure-6.1", mast + receiver + traffic + mount) == "3000");
  CHECK(launched("figure-6.18", mast + receiver + traffic + mount) == "3000");
  CHECK(launched("figure-6.18", traffic + mount) == "2000");
  CHECK(launched("figure-6.18", mast + second_mast + receiver) == "1000");
}

TEST_CASE("figure-6.6 has a region for each transmitter that [links] wants, and none for others") {
  if (!device_present()) return;
  const Folder folder;
  const auto regions = [&](const std::string& text) {
    const std::string config = folder.file("a.toml", scene + text);
    const Outcome run = bench(find_experiment("figure-6.6"), folder, config);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    // The rows of the table of numbers.
    const std::string page = squeezed(contents(folder.path("out/figure-6.6.md"))), row = "| mutex uniform | ";
    size_t count = 0;
    for (size_t at = page.find(row); at != std::string::npos; at = page.find(row, at + 1)) ++count;
    return count - 1;  // without that of all transmitters
  };
  CHECK(regions(mast + second_mast + receiver) == 2);
  CHECK(regions("links.transmitters = [\"mast\"]\n" + mast + receiver + traffic + mount) == 1);
}

TEST_CASE("a figure of orders ends when its minutes are up, and says which numbers of rays it left out") {
  if (!device_present()) return;
  const Folder folder;
  const std::string config = folder.file("a.toml", scene + mast + receiver);
  const Outcome run = run_program(
      {"thesis", "figure-6.18", "-c", config, "-o", folder.path("out"), "--minutes", "0.001", "--frames", "2"});
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  // The first number of rays is measured in any case; the largest of the thesis never is in 60 ms.
  const std::string table = contents(folder.path("out/figure-6.18.csv"));
  CHECK(contains(table, "\n1000,"));
  CHECK_FALSE(contains(table, "\n90000000,"));
  const std::string page = squeezed(contents(folder.path("out/figure-6.18.md")));
  CHECK(contains(page, "to 90,000,000 rays, as the next number of rays would end later than 0.001 minutes after"));
  CHECK_FALSE(contains(page, "interrupted"));
  const Outcome all = run_program(
      {"thesis", "figure-6.18", "-c", config, "-o", folder.path("out"), "--rays", "1000:5000", "--frames", "2"});
  CHECK(all.code == 0);
  CHECK_FALSE(contains(contents(folder.path("out/figure-6.18.md")), "left out"));
}

TEST_CASE("thesis: every figure of vehicles alone on one page without links to elsewhere, also what failed") {
  if (!device_present()) return;
  const Folder folder;
  const std::string config = folder.file("b.toml", scene + traffic + mount);
  const Outcome wrong =
      run_program({"thesis", "all", "-c", config, "-o", folder.path("out"), "--set", "cache.division=7"});
  CHECK(wrong.code == 2);  // before the first figure, which would accept it, is measured
  CHECK(contains(wrong.err, "figure-6.2 gives cache.division its values itself"));
  const Outcome run = run_program({"thesis", "all", "-c", config, "-o", folder.path("out"), "--rays", "1000:1000",
                                   "--repeat", "1", "--frames", "2"});
  CAPTURE(run.err);
  REQUIRE(run.code == 5);  // some figures failed
  const std::string page = contents(folder.path("out/thesis.html"));
  for (const Experiment* experiment : thesis_experiments())
    CHECK(contains(page, "<section id=\"" + experiment->name + "\">"));
  CHECK_FALSE(contains(page, "http:"));
  const std::string markdown = contents(folder.path("out/thesis.md"));
  for (int figure = 1; figure <= 18; ++figure) CHECK(contains(markdown, fmt::format("\n## figure-6.{}: ", figure)));
  CHECK(contains(markdown, "\n- device: "));
  CHECK(contains(markdown, "| figure-6.1 "));
  // Experiments beyond the figures have no point at so few rays: a page says what failed, and holds the rest.
  // Each is said in the table of verdicts and in its section.
  CHECK(occurrences(page, "failed: --rays 1000:1000: ") == 2 * 4);
  CHECK(occurrences(page, "failed: ") == 2 * 4);
  CHECK_FALSE(contains(page, "failed: " + config));
  CHECK(contains(run.out, "18 of 22 figures are whole"));
  if (contains(run.err, "gnuplot is not installed")) return;
  CHECK(occurrences(page, "<svg") == 19);  // one of speed against error
  CHECK_FALSE(contains(run.err, "Warning"));
}

TEST_CASE("innerframe: frames that are each alone, and a page that says how many groups were traced") {
  const Folder folder;
  const Outcome outcome =
      run_program({"thesis", "innerframe", "-o", folder.path("out"), "--rays", "10000:10000", "--frames", "2"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK_FALSE(contains(outcome.err, "arning"));  // of gnuplot
  const std::string page = squeezed(contents(folder.path("out/innerframe.md")));
  CHECK(contains(page, "| of a group of coherent rays only one is traced | reproduced | yes at "));
  CHECK(contains(page, "| 10,000 | 1.0 | 46 | groups with one hit point | "));
  CHECK(contains(page, "every frame finds its table empty"));
}
