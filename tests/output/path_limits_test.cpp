// SPDX-License-Identifier: Apache-2.0
// Limits of output leave paths out, and these are counted wherever they may be missed.
// The sample's paths are so few that the remaining ones are known by hand.
#include "output/path_limits.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include "output/path_kinds.hpp"
#include "radio/links.hpp"
#include "radio/path_power.hpp"
#include "reader.hpp"
#include "sample_run.hpp"
#include "temporary_folder.hpp"

using namespace wavetracer;
using test::Reader;
using test::slurp;
using test::TemporaryFolder;

namespace {

// Two links with gains -60, -90, -70, -70 dB and -80, -100 dB; row i has i % 3 vertices.
Paths made_paths() {
  Paths paths;
  const double gains_db[] = {-60, -90, -70, -70, -80, -100};
  for (uint32_t i = 0; i < 6; ++i) {
    paths.frame.push_back(0);
    paths.tx.push_back(0);
    paths.rx.push_back(i < 4 ? 0 : 1);
    paths.depth.push_back(i % 3);
    for (const auto column : {&Paths::delay_s, &Paths::aod_theta_rad, &Paths::aod_phi_rad, &Paths::aoa_theta_rad,
                              &Paths::aoa_phi_rad, &Paths::doppler_hz})
      (paths.*column).push_back(i);
    paths.gain_db.push_back(gains_db[i]);
    paths.a.push_back({std::pow(10, gains_db[i] / 20), 0.0, 0.0, 0.0});
    for (uint32_t k = 0; k < i % 3; ++k) {
      paths.vertex_position_m.emplace_back(i, k, 0);
      paths.vertex_interaction.push_back(reflection);
      paths.vertex_surface.push_back(10 * i + k);
      paths.vertex_instance.push_back(no_instance);
    }
    paths.vertex_offset.push_back(paths.vertex_position_m.size());
  }
  return paths;
}

constexpr std::optional<double> none;

OutputConfig limits(std::optional<double> min_gain_db, std::optional<double> dynamic_range_db,
                    std::optional<uint32_t> most_paths) {
  OutputConfig out;
  out.min_gain_db = min_gain_db;
  out.dynamic_range_db = dynamic_range_db;
  out.max_paths_per_link = most_paths;
  return out;
}

std::vector<uint32_t> kept(const OutputConfig& output) {
  const std::vector<uint8_t> written = written_rows(made_paths(), output);
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < written.size(); ++i)
    if (written[i]) out.push_back(i);
  return out;
}

// The comma before paths_left_out, the sixth column from the end.
size_t at_left_out(const std::string& line) {
  size_t comma = line.size();
  for (int i = 0; i < 6; ++i) comma = line.rfind(',', comma - 1);
  return comma;
}

}  // namespace

TEST_CASE("each limit leaves out what its key says, link by link") {
  using Rows = std::vector<uint32_t>;
  CHECK(kept({}) == Rows{0, 1, 2, 3, 4, 5});
  CHECK(kept(limits(-80, none, {})) == Rows{0, 2, 3, 4});  // as strong as the limit is in
  CHECK(kept(limits(none, 10, {})) == Rows{0, 2, 3, 4});
  CHECK(kept(limits(none, 0, {})) == Rows{0, 4});
  CHECK(kept(limits(none, none, 1)) == Rows{0, 4});
  CHECK(kept(limits(none, none, 2)) == Rows{0, 2, 4, 5});  // the first of two equally strong paths is kept
  CHECK(kept(limits(-75, none, 2)) == Rows{0, 2});
  CHECK(kept(limits(0, none, {})).empty());
}

TEST_CASE("selected rows keep their vertices, and what is left out is counted with its power") {
  const Paths all = made_paths();
  const std::vector<uint8_t> written = written_rows(all, limits(none, none, 2));
  const Paths some = select_rows(all, written);
  CHECK(some.delay_s == std::vector<double>{0, 2, 4, 5});
  CHECK(some.vertex_offset == std::vector<uint64_t>{0, 0, 2, 3, 5});
  CHECK(some.vertex_surface == std::vector<uint32_t>{20, 21, 40, 50, 51});
  const LeftOutPaths gone = left_out(all, written, 0, 4);
  CHECK(gone.paths == 2);
  CHECK(gone.power == doctest::Approx(1e-9 + 1e-7).epsilon(1e-12));
  CHECK(gone.all == doctest::Approx(1e-6 + 1e-9 + 2e-7).epsilon(1e-12));
}

TEST_CASE("groups of selected rows are numbered by these rows, link by link") {
  Paths all = made_paths();
  all.group = {only_group(0), only_group(1), {2, 0, no_group, no_group}, only_group(3), only_group(0), only_group(1)};
  all.group_weight.assign(6, whole_weight);
  all.group_weight[2] = {0.8, 0.6, 0, 0};
  all.lifetime_m = {0, 1, 2, 3, 4, 5};
  const std::vector<uint8_t> written{0, 1, 1, 1, 0, 1};
  const Paths some = select_rows(all, written);
  CHECK(some.group ==
        std::vector<GroupNumbers>{only_group(0), {1, 2, no_group, no_group}, only_group(3), only_group(0)});
  CHECK(some.group_weight[1] == GroupWeights{0.8, 0.6, 0, 0});
  CHECK(some.lifetime_m[1] == 2);
}

TEST_CASE("a run with limits: fewer rows in paths.h5, the same figures in links.csv, and counts of what is missing") {
  const TemporaryFolder all, some;
  SampleRun sample;
  sample.drive(0, 12);
  write_outputs(all.path(), sample.run(), sample.drive(0, 12));
  sample.config.output.max_paths_per_link = 1;
  write_outputs(some.path(), sample.run(), sample.drive(0, 12));
  const auto rows = [](const TemporaryFolder& folder) {
    return Reader(folder.path() / "paths.h5").shape("/paths/delay_s")[0];
  };
  const auto summary = nlohmann::json::parse(slurp(some.path() / "summary.json"));
  const uint64_t gone = summary["left_out"]["paths"];
  CHECK(gone > 0);
  CHECK(rows(all) == rows(some) + gone);
  CHECK(summary["counts"]["paths"] == rows(all));
  CHECK(summary["left_out"]["power_share"] > 0);
  CHECK_FALSE(nlohmann::json::parse(slurp(all.path() / "summary.json")).contains("left_out"));
  std::istringstream a(slurp(all.path() / "links.csv")), b(slurp(some.path() / "links.csv"));
  std::string line_a, line_b;
  std::getline(a, line_a);
  std::getline(b, line_b);
  uint64_t counted = 0;
  while (std::getline(a, line_a) && std::getline(b, line_b)) {
    CHECK(line_a.substr(0, at_left_out(line_a)) == line_b.substr(0, at_left_out(line_b)));
    counted += std::stoull(line_b.substr(at_left_out(line_b) + 1));
  }
  CHECK(counted == gone);
}

TEST_CASE("where the device has summed paths, links.csv is the same, and paths.h5 has none") {
  const TemporaryFolder all, sums;
  SampleRun sample;
  write_outputs(all.path(), sample.run(), sample.drive(0, 12));
  std::vector<FrameResult> frames = sample.drive(0, 12);
  uint64_t paths = 0;
  for (FrameResult& frame : frames) {
    SummedPaths& sum = frame.summed.emplace();
    sum.links = link_figures(frame.paths, frame.frame, frame.world.links, sample.config.radio.frequency_hz);
    sum.kinds = count_path_kinds(frame.paths);
    for (size_t row = 0; row < frame.paths.size(); ++row) sum.power += power_of(frame.paths, row);
    paths += frame.paths.size();
    frame.counts.paths = frame.paths.size();
    Paths none;
    none.rx_ports = frame.paths.rx_ports;
    none.tx_ports = frame.paths.tx_ports;
    frame.paths = std::move(none);
  }
  sample.config.output.paths = false;
  write_outputs(sums.path(), sample.run(), frames);
  CHECK(Reader(sums.path() / "paths.h5").shape("/paths/delay_s")[0] == 0);
  const auto summary = nlohmann::json::parse(slurp(sums.path() / "summary.json"));
  CHECK(summary["counts"]["paths"] == paths);
  CHECK(summary["left_out"]["paths"] == paths);
  CHECK(summary["left_out"]["power_share"] == 1);
  CHECK(summary["paths_by_kind"] == nlohmann::json::parse(slurp(all.path() / "summary.json"))["paths_by_kind"]);
  std::istringstream a(slurp(all.path() / "links.csv")), b(slurp(sums.path() / "links.csv"));
  size_t lines = 0;
  for (std::string line_a, line_b; std::getline(a, line_a); ++lines) {
    REQUIRE(std::getline(b, line_b));
    CHECK(line_a.substr(0, at_left_out(line_a)) == line_b.substr(0, at_left_out(line_b)));
    CHECK(line_a.substr(line_a.rfind(',')) == line_b.substr(line_b.rfind(',')));  // k_factor_db
  }
  CHECK(lines > 10);
}

TEST_CASE("shards count what they leave out, and merge to the file of one run") {
  const TemporaryFolder one, drive;
  SampleRun sample;
  sample.config.output.dynamic_range_db = 0;
  const auto expected = write_outputs(one.path(), sample.run(), sample.drive(3, 22));
  const RunIdentity identity = sample_identity(24);
  {
    Shards shards(drive.path(), identity);
    shards.write(sample.run(), sample.drive(3, 10));
    shards.write(sample.run(), sample.drive(13, 12));
  }
  Shards again(drive.path(), identity);  // by the lines of its manifest
  CHECK(again.resume() == 2);
  const auto merged = again.merge(sample.run(), {});
  CHECK(slurp(merged[0]) == slurp(expected[0]));
  const auto left = [](const std::filesystem::path& folder) {
    return nlohmann::json::parse(slurp(folder / "summary.json"))["left_out"];
  };
  CHECK(left(drive.path())["paths"] == left(one.path())["paths"]);
  CHECK(left(one.path())["paths"] > 0);
}
