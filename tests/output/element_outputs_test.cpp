// SPDX-License-Identifier: Apache-2.0
// responses.h5, beams.h5 and carriers.h5 as a reader finds them, and the best beams in links.csv.
#include <doctest/doctest.h>
#include <sstream>
#include "output/path_limits.hpp"
#include "output/reader.hpp"
#include "output/sample_elements.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;
using test::Reader;
using test::slurp;

namespace {

using Values = std::vector<double>;
using Shape = std::vector<hsize_t>;

}  // namespace

TEST_CASE("responses, beams and fields of more carriers are written as they are, and read back") {
  const test::TemporaryFolder folder;
  SampleElements sample;
  const std::vector<FrameResult>& frames = sample.filled;
  const auto written = write_outputs(folder.path(), sample.run(), frames);
  REQUIRE(written.size() == 7);
  CHECK(written[1].filename() == "responses.h5");
  CHECK(written[2].filename() == "beams.h5");
  CHECK(written[3].filename() == "carriers.h5");
  CHECK(written[4].filename() == "radar.h5");

  const Reader responses(written[1]);
  CHECK(responses.attribute("/", "format") == "wavetracer responses");
  CHECK(responses.attribute("/", "convention_wavefront") == "spherical");
  const double f = sample.config.radio.frequency_hz;
  CHECK(responses.numbers("/frequencies/frequency_hz") == Values{f - 1e7, f, 2 * f - 1e7, 2 * f});
  CHECK(responses.numbers("/times/time_s") == Values{0, 1e-3});
  CHECK(responses.numbers("/links/frame") == Values{7, 7, 7, 7, 8, 8, 8, 8});
  CHECK(responses.numbers("/links/rx") == Values{0, 1, 0, 1, 0, 1, 0, 1});
  Values offset{0}, re;
  for (const FrameResult& frame : frames) {
    for (const Link& link : frame.world.links)
      offset.push_back(offset.back() + static_cast<double>(sample_rows(sample.config, link)));
    for (const auto& h : frame.responses.h) re.push_back(h.real());
  }
  CHECK(responses.numbers("/links/row_offset") == offset);
  CHECK(responses.numbers("/responses/h_re") == re);
  CHECK(responses.numbers("/responses/h_im") == Values(re.size(), -0.5));
  CHECK(responses.shape("/responses/h_re") == Shape{static_cast<hsize_t>(offset.back()), 4});
  CHECK(responses.numbers("/transmitters/first_element") == Values{0, 2, 3});
  const double half = 0.25 * 299792458.0 / f;
  const Values places = responses.numbers("/transmitters/element_position_m");
  REQUIRE(places.size() == 9);
  CHECK(places[1] == doctest::Approx(-half));
  CHECK(places[4] == doctest::Approx(half));

  const Reader beams(written[2]);
  CHECK(beams.numbers("/beams/frame") == Values{7, 7, 7, 7, 8, 8, 8, 8});
  CHECK(beams.numbers("/beams/rx") == Values{0, 0, 1, 1, 0, 0, 1, 1});
  CHECK(beams.numbers("/beams/tx_beam") == Values{0, 1, 0, 1, 0, 1, 0, 1});
  CHECK(beams.numbers("/beams/gain_db") == Values{-80, -81.5, -81, -82.5, -80, -78.5, -81, -79.5});

  const Reader carriers(written[3]);
  CHECK(carriers.numbers("/carriers/frequency_hz") == Values{f, 2 * f});
  const Shape shape = Reader(written[0]).shape("/paths/a_re");
  CHECK(carriers.shape("/paths/a_re") == Shape{5, 2, shape[1], shape[2]});
  const size_t ports = shape[1] * shape[2];
  const Values a = carriers.numbers("/paths/a_re"), shift = carriers.numbers("/paths/doppler_hz");
  for (size_t row = 0; row < 5; ++row) {
    CHECK(a.at(2 * ports * row + ports) == 0.5 * a[2 * ports * row]);
    CHECK(a.at(2 * ports * row + ports + 1) == a[2 * ports * row + 1]);
    CHECK(shift[2 * row + 1] == 2 * shift[2 * row]);
  }
}

TEST_CASE("radars are written as they are: axes, rows of links, maps, cubes where they are wanted, detections") {
  const test::TemporaryFolder folder;
  SampleElements sample;
  const std::vector<FrameResult>& frames = sample.filled;
  const auto written = write_outputs(folder.path(), sample.run(), frames);
  const Reader radars(written[4]);
  CHECK(radars.attribute("/", "format") == "wavetracer radar");
  CHECK(radars.attribute("/", "radars") == "front,rear");
  CHECK(radars.attribute("/front", "range_window") == "hann");
  CHECK(radars.numbers("/front/delay_s") == Values{0, 1e-9, 2e-9});
  REQUIRE(radars.numbers("/rear/doppler_hz").size() == 4);
  CHECK(radars.numbers("/rear/doppler_hz")[0] == doctest::Approx(-25000).epsilon(1e-12));
  CHECK(radars.numbers("/front/frames/frame") == Values{7, 7, 8, 8});
  CHECK(radars.numbers("/front/frames/time_s") == Values{0, 0, 0.1, 0.1});
  CHECK(radars.numbers("/front/frames/rx") == Values{0, 1, 0, 1});
  CHECK(radars.numbers("/front/frames/left_out") == Values{1, 1, 2, 2});
  CHECK(radars.shape("/front/frames/tx_offset_m") == Shape{4, 2, 3});
  const double quarter_m = 0.25 * 299792458.0 / sample.config.radio.frequency_hz;
  const Values offset = radars.numbers("/front/frames/tx_offset_m");
  const glm::dvec3 left = frames[0].world.transmitters[0].rotation * glm::dvec3(0, quarter_m, 0);
  for (int axis = 0; axis < 3; ++axis)
    CHECK(offset[3 + static_cast<size_t>(axis)] == doctest::Approx(left[axis]).epsilon(1e-12));
  Values powers, re, im;
  for (const FrameResult& frame : frames)
    for (const RadarRow& row : frame.radars[0]) {
      powers.insert(powers.end(), row.power_dbm.begin(), row.power_dbm.end());
      for (const auto& value : row.cube) {
        re.push_back(value.real());
        im.push_back(value.imag());
      }
    }
  CHECK(radars.shape("/rear/maps/power_dbm") == Shape{4, 4, 3});
  CHECK(radars.numbers("/front/maps/power_dbm") == powers);
  CHECK(radars.shape("/front/cube/re") == Shape{4, 1, 2, 4, 3});
  CHECK(radars.numbers("/front/cube/re") == re);
  CHECK(radars.numbers("/front/cube/im") == im);
  const std::vector<std::string> of_rear = hdf5::File::open_to_read(written[4]).members("/rear");
  CHECK(std::ranges::find(of_rear, "cube") == of_rear.end());
  CHECK(std::ranges::find(of_rear, "maps") != of_rear.end());
  CHECK(radars.shape("/front/spectrogram/power_dbm") == Shape{4, 4});
  CHECK(radars.numbers("/front/detections/frame") == Values{7, 8});
  CHECK(radars.numbers("/front/detections/doppler_hz") == Values{507, 508});
  CHECK(radars.numbers("/rear/detections/elevation_rad") == Values{-0.5, -0.5});
}

TEST_CASE("links.csv has the best pair of beams of each link") {
  const test::TemporaryFolder folder;
  SampleElements sample;
  const std::vector<FrameResult>& frames = sample.filled;
  write_outputs(folder.path(), sample.run(), frames);
  std::istringstream csv(slurp(folder.path() / "links.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  REQUIRE(lines.size() == 9);
  CHECK(lines[1].find(",0,0,-80,") != std::string::npos);
  CHECK(lines[2].find(",0,0,-81,") != std::string::npos);
  CHECK(lines[3].ends_with(",nan,nan,nan"));
  CHECK(lines[5].find(",1,0,-78.5,") != std::string::npos);
}

TEST_CASE("limits of paths leave out the rows of all carriers, and no response") {
  const test::TemporaryFolder folder;
  SampleElements sample;
  const std::vector<FrameResult>& frames = sample.filled;
  sample.config.output.max_paths_per_link = 1;
  size_t rows = 0;
  for (const FrameResult& frame : frames)
    for (const uint8_t kept : written_rows(frame.paths, sample.config.output)) rows += kept;
  const auto all = write_outputs(folder.path(), sample.run(), frames);
  CHECK(Reader(all[3]).shape("/paths/frame") == Shape{rows});
  CHECK(Reader(all[0]).shape("/paths/frame") == Shape{rows});
  CHECK(Reader(all[1]).shape("/responses/h_re")[0] ==
        frames[0].responses.row_offset.back() + frames[1].responses.row_offset.back());
}

TEST_CASE("frames without what the run has to write are faults, and written nowhere") {
  const test::TemporaryFolder folder;
  SampleRun sample;
  ask_for_elements(sample.config);
  CHECK_THROWS_AS(write_outputs(folder.path() / "out", sample.run(), sample.frames()), RuntimeError);
  CHECK_FALSE(fs::exists(folder.path() / "out"));
}
