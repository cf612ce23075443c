// SPDX-License-Identifier: Apache-2.0
// SavedRun reads what write_outputs() writes; damaged files are refused with a message, never trusted.
// Files are damaged through the HDF5 library, so that they are well formed except for one thing.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>
#include <cmath>
#include <csignal>
#include <fstream>
#include <memory>
#include "output/hdf5.hpp"
#include "output/sample_run.hpp"
#include "radio/links.hpp"
#include "results/csv_columns.hpp"
#include "results/damage.hpp"
#include "results/link_table.hpp"
#include "results/saved_run.hpp"
#include "results/saved_world.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::overwrite;
using test::remove_member;

namespace {

struct Written {
  test::TemporaryFolder folder;
  SampleRun sample;
  fs::path file;
  Written() { file = write_outputs(folder.path() / "run", sample.run(), sample.frames())[0]; }
};

// Returns the refusal of the file, or an empty text if it is read completely.
std::string refusal(const fs::path& file) {
  try {
    const SavedRun run(file);
    for (size_t row = 0; row < run.frame_count(); ++row) run.frame(row);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

// The processes that this one has started and that have not ended.
std::vector<pid_t> children() {
  std::vector<pid_t> out;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    pid_t process = 0, parent = 0;
    std::string name, state;
    if (stat >> process >> name >> state >> parent && parent == getpid()) out.push_back(process);
  }
  return out;
}

}  // namespace

TEST_CASE("every frame is read back as it was written") {
  const Written written;
  const SavedRun run(written.folder.path() / "run");
  const std::vector<FrameResult> frames = written.sample.frames();
  REQUIRE(run.frame_count() == frames.size());
  CHECK(run.path_count() == 5);
  CHECK(run.rx_ports() == 2);
  CHECK(run.tx_ports() == 1);
  CHECK(run.frequency_hz() == written.sample.config.radio.frequency_hz);
  CHECK(run.transmitters().size() == written.sample.config.transmitters.size());
  CHECK(run.transmitters()[0].name == written.sample.config.transmitters[0].name);
  CHECK(run.receivers()[1].position_m == written.sample.config.receivers[1].position_m);
  CHECK(run.instances()[1].id == "v1");
  for (size_t row = 0; row < frames.size(); ++row) {
    const Paths& was = frames[row].paths;
    const SavedFrame frame = run.frame(row);
    CHECK(run.path_count(row) == was.size());
    CHECK(frame.number == frames[row].frame);
    CHECK(frame.time_s == frames[row].world.time_s);
    CHECK(frame.paths.tx == was.tx);
    CHECK(frame.paths.rx == was.rx);
    CHECK(frame.paths.delay_s == was.delay_s);
    CHECK(frame.paths.gain_db == was.gain_db);
    CHECK(frame.paths.aoa_phi_rad == was.aoa_phi_rad);
    CHECK(frame.paths.doppler_hz == was.doppler_hz);
    CHECK(frame.paths.vertex_offset == was.vertex_offset);
    CHECK(frame.paths.vertex_position_m == was.vertex_position_m);
    CHECK(frame.paths.vertex_interaction == was.vertex_interaction);
    CHECK(frame.paths.vertex_surface == was.vertex_surface);
    CHECK(frame.paths.vertex_instance == was.vertex_instance);
    for (size_t i = 0; i < was.size(); ++i)
      for (size_t port = 0; port < 2; ++port) CHECK(frame.paths.a[i][port] == was.a[i][port]);
    CHECK(frame.links == frames[row].world.links);
    size_t present = 0;
    for (const Placement& placed : frames[row].world.instances) present += placed.present;
    CHECK(frame.poses.size() == present);
    const glm::dvec3 position_m = written.sample.scene.origin_m + frames[row].world.transmitters[0].position_m;
    CHECK(frame.transmitter_position_m[0] == position_m);
  }
}

TEST_CASE("groups of paths are read back; in a file of before there were any every path is its own") {
  const test::TemporaryFolder folder;
  const SampleRun sample;
  std::vector<FrameResult> frames = sample.frames();
  Paths& paths = frames[0].paths;
  REQUIRE(paths.size() > 1);
  for (uint32_t i = 0; i < paths.size(); ++i) {
    paths.group.push_back({i, 0, no_group, no_group});
    paths.group_weight.push_back({0.8, 0.6, 0, 0});
  }
  const fs::path file = write_outputs(folder.path() / "run", sample.run(), frames)[0];
  CHECK(SavedRun(file).frame(0).paths.group == paths.group);
  CHECK(SavedRun(file).frame(0).paths.group_weight == paths.group_weight);
  CHECK(SavedRun(file).frame(1).paths.group[0] == only_group(0));
  CHECK(SavedRun(file).frame(1).paths.group_weight[0] == whole_weight);
  overwrite(file, "/paths/group", 0, uint32_t{1000});
  CHECK(refusal(file).find("/paths/group") != std::string::npos);
  remove_member(file, "/paths/group_weight");
  CHECK(refusal(file).find("group_weight") != std::string::npos);
  remove_member(file, "/paths/group");
  CHECK(SavedRun(file).frame(0).paths.group.empty());
}

TEST_CASE("a pose's rotation keeps its rows and columns") {
  const Written written;
  const std::vector<FrameResult> frames = written.sample.frames();
  const SavedFrame frame = SavedRun(written.file).frame(1);
  REQUIRE(frame.poses.size() == 2);
  for (const SavedPose& pose : frame.poses) CHECK(pose.rotation == frames[1].world.instances[pose.instance].rotation);
}

TEST_CASE("a run without paths is a run") {
  test::TemporaryFolder folder;
  const SampleRun sample;
  write_outputs(folder.path() / "run", sample.run(), sample.empty());
  const SavedRun run(folder.path() / "run");
  CHECK(run.path_count() == 0);
  CHECK(run.frame(0).paths.size() == 0);
}

TEST_CASE("what is no run is refused with the file and what to do") {
  test::TemporaryFolder folder;
  CHECK(refusal(folder.path() / "none").find("wavetracer run -o") != std::string::npos);
  CHECK(refusal(folder.path()).find("holds no paths.h5") != std::string::npos);
  CHECK(refusal(folder.write("text.h5", "not HDF5 at all")).find("text.h5") != std::string::npos);
  const Written written;
  std::ifstream in(written.file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  CHECK(refusal(folder.write("cut.h5", bytes.substr(0, bytes.size() / 2))) != "");
}

TEST_CASE("every contradiction within the file is found") {
  const auto damaged = [](const auto& damage) {
    const Written written;
    damage(written.file);
    return refusal(written.file);
  };
  const auto with = [&](const std::string& dataset, hsize_t index, auto value) {
    return damaged([&](const fs::path& file) { overwrite(file, dataset, index, value); });
  };
  const auto without = [&](const std::string& member) {
    return damaged([&](const fs::path& file) { remove_member(file, member); });
  };
  CHECK(damaged([](const fs::path&) {}) == "");
  CHECK(with("/paths/tx", 0, uint32_t{2}).find("/paths/tx") != std::string::npos);
  CHECK(with("/paths/rx", 4, ~uint32_t{0}).find("/paths/rx") != std::string::npos);
  CHECK(with("/paths/depth", 1, uint32_t{9}).find("/paths/depth") != std::string::npos);
  CHECK(with("/paths/vertex_offset", 1, uint64_t{1} << 60).find("vertex_offset") != std::string::npos);
  CHECK(with("/frames/path_offset", 1, uint64_t{6}).find("path_offset") != std::string::npos);
  CHECK(with("/frames/path_offset", 2, uint64_t{4}).find("path_offset") != std::string::npos);
  CHECK(with("/frames/frame", 1, uint32_t{7}).find("/frames/frame") != std::string::npos);
  CHECK(with("/poses/instance", 0, uint32_t{2}).find("/poses/instance") != std::string::npos);
  CHECK(with("/poses/frame", 0, uint32_t{99}).find("/poses/frame") != std::string::npos);
  CHECK(with("/links/tx", 0, uint32_t{2}).find("/links/tx") != std::string::npos);
  CHECK(with("/vertices/instance", 1, uint32_t{2}).find("/vertices/instance") != std::string::npos);
  for (const char* member :
       {"/paths/delay_s", "/paths/a_im", "/vertices/position_m", "/frames/time_s", "/frames/receiver_position_m",
        "/transmitters/name", "/instances/type", "/links", "/poses"})
    CHECK_MESSAGE(without(member) != "", member);
}

TEST_CASE("a file that faults the library in a later frame is an input error that names it") {
  const Written written;
  const SavedRun run(written.file);
  CHECK(run.frame(0).number == 7);
  REQUIRE(children().size() == 1);
  kill(children()[0], SIGSEGV);
  CHECK_THROWS_WITH_AS(run.frame(1), doctest::Contains((written.file.string() + ": the file is damaged").c_str()),
                       InputError);
  CHECK_THROWS_AS(run.frame(0), InputError);
}

TEST_CASE("several runs are read side by side, each to its end") {
  const Written a, b;
  auto first = std::make_unique<SavedRun>(a.file);
  const SavedRun second(b.file);
  CHECK(first->frame(1).number == second.frame(1).number);
  first.reset();
  CHECK(second.frame(0).number == 7);
  CHECK(children().size() == 1);
}

TEST_CASE("a world that cannot be loaded again leaves a warning and room for every vehicle") {
  const Written written;
  const SavedRun run(written.file);
  const SavedWorld world = load_saved_world(run);
  CHECK(world.scene.triangles.empty());
  CHECK(world.warnings.size() == 1);
  CHECK(world.instance_model == std::vector<uint32_t>(2, no_instance));
}

TEST_CASE("a byte order mark is not part of the first column's name") {
  CsvColumns out({"time_s"});
  out.read("\xEF\xBB\xBFtime_s,tx\n0.5,0\n");
  out.finish();
  REQUIRE(out.has(0));
  CHECK(out.values(0) == std::vector<double>{0.5});
}

TEST_CASE("a column of a CSV file by RFC 4180, in pieces of any size") {
  const std::string text =
      "name,\"a, \"\"b\"\"\",value\r\n\"x,\ny\",1,2.5\r\nz,,\nshort\n\"q\"\"q\",1,-inf\nlast,7,nan";
  const auto column = [&](const std::string& name, size_t piece) -> std::optional<std::vector<double>> {
    CsvColumns out({"of no column", name});
    for (size_t at = 0; at < text.size(); at += piece) out.read(std::string_view(text).substr(at, piece));
    out.finish();
    CHECK_FALSE(out.has(0));
    if (!out.has(1)) return {};
    return out.values(1);
  };
  for (const size_t piece : {1, 2, 7, 1000}) {
    const auto values = column("value", piece);
    REQUIRE(values);
    REQUIRE(values->size() == 5);
    CHECK((*values)[0] == 2.5);
    CHECK(std::isnan((*values)[1]));
    CHECK(std::isnan((*values)[2]));
    CHECK((*values)[3] == -INFINITY);
    CHECK(std::isnan((*values)[4]));
    CHECK_FALSE(column("values", piece));
    CHECK(column("name", piece)->size() == 5);
  }
  CsvColumns empty({"value"});
  empty.finish();
  CHECK_FALSE(empty.has(0));
}

TEST_CASE("what was missed is read from summary.json and links.csv, where they are of the run") {
  const test::TemporaryFolder folder;
  const SampleRun sample;
  std::vector<FrameResult> frames = sample.drive(0, 6);
  for (FrameResult& frame : frames) {
    for (size_t i = 0; i < frame.paths.size(); ++i) frame.paths.quarters.push_back(i % 2 ? 15 : 1);
    frame.missed = missed_counts(frame.paths, 0, frame.paths.size());
  }
  write_outputs(folder.path(), sample.run(), frames);
  const SavedRun run(folder.path());
  MissedCounts sum;
  for (const FrameResult& frame : frames) add(sum, frame.missed);
  const Missed expected = estimate_missed(sum);
  REQUIRE(run.missed());
  CHECK(run.missed()->paths.estimate == doctest::Approx(expected.paths.estimate).epsilon(0.005));
  CHECK(run.missed()->power_share.high == doctest::Approx(expected.power_share.high).epsilon(0.005));

  std::vector<double> shares;
  for (const FrameResult& frame : frames)
    for (const LinkFigures& link : link_figures(frame.paths, frame.frame, frame.world.links, 5.9e9))
      shares.push_back(link.missed_power_share);
  const LinkTable read = link_table(run);
  CHECK(read.warning == "");
  REQUIRE(read.missed_power_share.size() == shares.size());
  size_t known = 0;
  for (size_t k = 0; k < shares.size(); ++k) {
    CHECK(
        (read.missed_power_share[k] == shares[k] || (std::isnan(read.missed_power_share[k]) && std::isnan(shares[k]))));
    known += read.missed_power_share[k] > 0;
  }
  CHECK(known > 3);

  std::ofstream(folder.path() / "links.csv", std::ios::app) << "0,a,b,1,-80,0,0,0,1,0.5\n";
  CHECK(link_table(run).missed_power_share.empty());
  CHECK(link_table(run).path_gain_db.empty());
  CHECK(link_table(run).warning.find(
            fmt::format("has {} links and paths.h5 has {}", shares.size() + 1, shares.size())) != std::string::npos);
  std::ofstream(folder.path() / "links.csv") << "time_s,tx,rx\n0,a,b\n";  // of an older version
  CHECK(link_table(run).missed_power_share.empty());
  CHECK(link_table(run).warning == "");
  fs::remove(folder.path() / "links.csv");
  fs::create_directory(folder.path() / "links.csv");
  CHECK(link_table(run).warning.find("what was missed on links is not shown") != std::string::npos);
  std::ofstream(folder.path() / "summary.json") << "{\"device\": 1, \"missed\": {\"paths\": {\"estimate\": \"x\"}}}";
  CHECK_FALSE(SavedRun(folder.path()).missed());
  CHECK(SavedRun(folder.path()).missed_unknown() == "");
  std::ofstream(folder.path() / "summary.json") << "{\"missed_unknown\": {\"frames\": 1, \"reason\": \"why\"}}";
  CHECK(SavedRun(folder.path()).missed_unknown() == "why");
  std::ofstream(folder.path() / "summary.json") << "{\"missed_unknown\": {\"frames\": 1, \"reason\": 7}}";
  CHECK(SavedRun(folder.path()).missed_unknown() == "");
}
