// SPDX-License-Identifier: Apache-2.0
// Layers of maps: sums over the rows of the paths that were written, and Friis' formula for antennas in free space.
#include "coverage/coverage_map.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <fstream>
#include <glm/geometric.hpp>
#include <random>

#include "coverage/made_grid.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::coverage;
using test::MadeGrid;

namespace {

constexpr double light_m_s = 299792458, carrier_hz = 2.4e9, power_dbm = 30, bandwidth_hz = 20e6, noise_figure_db = 7;

ReceiverGridConfig made_grid() {
  ReceiverGridConfig grid;
  grid.name = "g";
  grid.step_m = test::made_step_m;
  return grid;
}

double power(double db) { return std::pow(10, db / 10); }
double db(double value) { return 10 * std::log10(value); }
doctest::Approx near(double value) { return doctest::Approx(value).epsilon(1e-9); }

Map map_of(const SavedRun& run, const RadioConfig& radio, const MapChoice& choice = {}) {
  return coverage_map(run, radio, run.frame(0), test::links_of(run), made_grid(), choice);
}

RadioConfig whole_radio() {
  RadioConfig radio;
  radio.frequency_hz = carrier_hz;
  radio.transmit_power_dbm = power_dbm;
  radio.bandwidth_hz = bandwidth_hz;
  radio.noise_figure_db = noise_figure_db;
  return radio;
}

// Sums over all rows of the paths of a cell, for each transmitter.
struct Sums {
  std::vector<double> power, direct, delay;
  std::vector<std::complex<double>> field;  // at the carrier
  std::vector<uint32_t> paths;
  Sums(const Paths& p, uint32_t rx, size_t transmitters)
      : power(transmitters), direct(transmitters), delay(transmitters), field(transmitters), paths(transmitters) {
    for (size_t i = 0; i < p.size(); ++i) {
      if (p.rx[i] != rx) continue;
      const double own = std::norm(p.a[i][0]);
      power[p.tx[i]] += own;
      direct[p.tx[i]] += p.depth[i] == 0 ? own : 0;
      delay[p.tx[i]] += own * p.delay_s[i];
      field[p.tx[i]] += p.a[i][0] * std::polar(1.0, -2 * M_PI * std::fmod(test::made_carrier_hz * p.delay_s[i], 1));
      ++paths[p.tx[i]];
    }
  }
};

double spread_ns(const Paths& p, uint32_t tx, uint32_t rx, const Sums& sums) {
  double square = 0;
  for (size_t i = 0; i < p.size(); ++i)
    if (p.rx[i] == rx && p.tx[i] == tx)
      square += std::norm(p.a[i][0]) * std::pow(p.delay_s[i] - sums.delay[tx] / sums.power[tx], 2);
  return std::sqrt(square / sums.power[tx]) * 1e9;
}

void check_cell(const Cell& cell, const Paths& p, uint32_t rx, std::optional<uint32_t> tx) {
  CAPTURE(rx);
  const Sums sums(p, rx, 3);
  const auto best = static_cast<uint32_t>(std::ranges::max_element(sums.power) - sums.power.begin());
  const uint32_t server = tx.value_or(best);
  double others = 0, strongest = 0;
  for (uint32_t t = 0; t < 3; ++t) {
    if (t == server) continue;
    others += sums.power[t];
    strongest = std::max(strongest, sums.power[t]);
  }
  const double noise_mw = 1.380649e-23 * 290 * bandwidth_hz * 1e3 * power(noise_figure_db), sent_mw = power(power_dbm);
  const double own = sums.power[server];
  if (sums.power[best] > 0)
    CHECK(cell.best_server == best);
  else
    CHECK(std::isnan(cell.best_server));
  if (others > 0)
    CHECK(cell.interference_dbm == near(power_dbm + db(others)));
  else
    CHECK(std::isnan(cell.interference_dbm));
  if (own == 0) {
    for (const double value : {cell.path_gain_db, cell.narrowband_gain_db, cell.received_dbm, cell.snr_db, cell.sinr_db,
                               cell.margin_db, cell.delay_spread_ns, cell.k_factor_db, cell.line_of_sight, cell.paths})
      CHECK(std::isnan(value));
    return;
  }
  CHECK(cell.path_gain_db == near(db(own)));
  CHECK(cell.narrowband_gain_db == near(db(std::norm(sums.field[server]))));
  CHECK(cell.received_dbm == near(power_dbm + db(own)));
  CHECK(cell.snr_db == near(db(own * sent_mw / noise_mw)));
  CHECK(cell.sinr_db == near(db(own * sent_mw / (noise_mw + others * sent_mw))));
  if (strongest > 0)
    CHECK(cell.margin_db == near(db(own / strongest)));
  else
    CHECK(std::isnan(cell.margin_db));
  CHECK(cell.delay_spread_ns == near(spread_ns(p, server, rx, sums)));
  CHECK(cell.paths == sums.paths[server]);
  CHECK(cell.line_of_sight == (sums.direct[server] > 0 ? 1 : 0));
  if (sums.direct[server] == 0)
    CHECK(std::isnan(cell.k_factor_db));
  else if (sums.direct[server] == own)
    CHECK(std::isinf(cell.k_factor_db));
  else
    CHECK(cell.k_factor_db == near(db(sums.direct[server] / (own - sums.direct[server]))));
}

// Three transmitters, some cells without a path, some links with up to five.
void add_random_paths(MadeGrid& made) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (uint32_t tx = 0; tx < 3; ++tx)
    for (uint32_t cell = 0; cell < made.columns * made.rows; ++cell) {
      const auto count = cell == 5 ? 0 : static_cast<uint32_t>(uniform(random) * 6);
      const bool direct = uniform(random) < 0.5;
      for (uint32_t k = 0; k < count; ++k)
        made.add(tx, cell, std::polar(std::pow(10, -3 - 3 * uniform(random)), 6 * uniform(random)),
                 1e-7 * (k + uniform(random)), direct && k == 0 ? 0 : 1);
    }
}

}  // namespace

TEST_CASE("layers are the sums over the paths of a cell, for the best server and for each that is named") {
  MadeGrid made(5, 4, {{0, 0, 20}, {50, 0, 20}, {0, 40, 20}});
  add_random_paths(made);
  const SavedRun run = made.written();
  for (const std::optional<uint32_t> tx : {std::optional<uint32_t>(), std::optional(0u), std::optional(2u)}) {
    const Map map = map_of(run, whole_radio(), {.tx = tx});
    REQUIRE(map.cells.size() == 20);
    CHECK(map.layers.size() == layer_kinds.size() - 3);
    REQUIRE(map.left_out.size() == 1);
    CHECK(map.left_out[0] ==
          "beam_gain_db, tx_beam, rx_beam need the links.csv of a run where a transmitter or the grid has an [[array]] "
          "with a codebook");
    for (uint32_t cell = 0; cell < 20; ++cell) check_cell(map.cells[cell], made.frame.paths, cell + 1, tx);
  }
  CHECK(std::isnan(map_of(run, whole_radio()).cells[5].path_gain_db));
  CHECK_FALSE(map_of(run, whole_radio()).reached(5));
}

TEST_CASE("without links.csv the paths of paths.h5 count") {
  MadeGrid made(5, 4, {{0, 0, 20}, {50, 0, 20}, {0, 40, 20}});
  add_random_paths(made);
  made.written();
  std::filesystem::remove(made.folder.path() / "run" / "links.csv");
  const Map map = map_of(SavedRun(made.folder.path() / "run"), whole_radio());
  for (uint32_t cell = 0; cell < 20; ++cell) check_cell(map.cells[cell], made.frame.paths, cell + 1, {});
}

TEST_CASE("two antennas in free space: the nearer one serves, and ratios are those of Friis' formula") {
  const std::vector<glm::dvec3> antennas = {{3, 12, 10}, {97, 28, 10}};
  MadeGrid made(10, 4, antennas);
  const auto distance = [&](uint32_t tx, uint32_t cell) { return glm::distance(antennas[tx], made.at(cell)); };
  const auto gain = [&](uint32_t tx, uint32_t cell) {
    return std::pow(light_m_s / carrier_hz / (4 * M_PI * distance(tx, cell)), 2);
  };
  for (uint32_t tx = 0; tx < 2; ++tx)
    for (uint32_t cell = 0; cell < 40; ++cell)
      made.add(tx, cell, std::sqrt(gain(tx, cell)), distance(tx, cell) / light_m_s, 0);
  const Map map = map_of(made.written(), whole_radio());
  CHECK(map.columns == 10);
  CHECK(map.rows == 4);
  const double noise_mw = 1.380649e-23 * 290 * bandwidth_hz * 1e3 * power(noise_figure_db), sent_mw = power(power_dbm);
  for (uint32_t cell = 0; cell < 40; ++cell) {
    const uint32_t near_one = distance(0, cell) < distance(1, cell) ? 0 : 1, far_one = 1 - near_one;
    const Cell& c = map.cells[cell];
    CHECK(map.x_m(cell) == near(made.at(cell).x));
    CHECK(map.y_m(cell) == near(made.at(cell).y));
    CHECK(c.best_server == near_one);
    CHECK(c.margin_db == near(20 * std::log10(distance(far_one, cell) / distance(near_one, cell))));
    CHECK(c.sinr_db == near(db(sent_mw * gain(near_one, cell) / (noise_mw + sent_mw * gain(far_one, cell)))));
    CHECK(c.line_of_sight == 1);
    CHECK(c.k_factor_db == INFINITY);
    CHECK(c.delay_spread_ns == doctest::Approx(0));
  }
}

TEST_CASE("paths that limits of the output left out still count") {
  MadeGrid made(2, 1, {{0, 0, 20}});
  made.sample.config.output.max_paths_per_link = 2;
  for (uint32_t cell = 0; cell < 2; ++cell) {
    made.add(0, cell, 1e-3, 1e-7, 0);
    made.add(0, cell, 5e-4, 2e-7, 1);
    made.add(0, cell, 1e-4, 3e-7, 1);
  }
  const SavedRun run = made.written();
  REQUIRE(run.path_count() == 4);
  const Map map = map_of(run, whole_radio());
  for (const Cell& cell : map.cells) {
    CHECK(cell.paths == 3);
    CHECK(cell.path_gain_db == near(db(1e-6 + 25e-8 + 1e-8)));
    CHECK(cell.k_factor_db == near(db(1e-6 / (25e-8 + 1e-8))));
  }
}

TEST_CASE("beams are those of the server's best pair, and need an array with a codebook at the grid or a transmitter") {
  MadeGrid made(3, 1, {{0, 0, 20}, {9, 0, 20}});
  made.add(0, 0, 1e-3, 1e-7, 0);
  made.add(0, 1, 1e-4, 1e-7, 0);
  made.add(1, 0, 1e-4, 1e-7, 0);
  made.add(1, 1, 1e-3, 1e-7, 0);
  BeamRows& beams = made.frame.beams;
  for (uint32_t tx = 0; tx < 2; ++tx)
    for (uint32_t cell = 0; cell < 3; ++cell)
      for (uint32_t pair = 0; pair < 4; ++pair) {
        beams.tx.push_back(tx);
        beams.rx.push_back(cell + 1);
        beams.tx_beam.push_back(pair / 2);
        beams.rx_beam.push_back(pair % 2);
        beams.gain_db.push_back(cell == 2 ? -INFINITY : pair == 1 + tx ? -50.0 - cell : -70.0);
      }
  const SavedRun run = made.written();
  const Map best = map_of(run, {}), first = map_of(run, {}, {.tx = 0, .layers = {"tx_beam", "rx_beam"}});
  CHECK(best.layers.back() == &layer_kind("rx_beam"));
  CHECK(best.cells[0].beam_gain_db == -50);
  CHECK(best.cells[0].tx_beam == 0);
  CHECK(best.cells[0].rx_beam == 1);
  CHECK(best.cells[1].beam_gain_db == -51);
  CHECK(best.cells[1].tx_beam == 1);
  CHECK(best.cells[1].rx_beam == 0);
  CHECK(first.cells[1].tx_beam == 0);
  CHECK(first.cells[1].rx_beam == 1);
  for (const double value : {best.cells[2].beam_gain_db, best.cells[2].tx_beam, best.cells[2].rx_beam})
    CHECK(std::isnan(value));
  CHECK(layer_kind("tx_beam").of_choices());
  CHECK_FALSE(layer_kind("beam_gain_db").of_choices());
}

TEST_CASE("numbers of beams that no codebook has are not taken from links.csv") {
  MadeGrid made(3, 1, {{0, 0, 20}});
  for (uint32_t cell = 0; cell < 3; ++cell) made.add(0, cell, 1e-3, 1e-7, 0);
  made.written();
  std::ofstream table(made.folder.path() / "run" / "links.csv");
  table << "tx_beam,rx_beam,beam_gain_db\n,,\n-1,65536,-60\n1e300,65535,-60\ninf,nan,-60\n";
  table.close();
  const Map map = map_of(SavedRun(made.folder.path() / "run"), {});
  for (const Cell& cell : map.cells) {
    CHECK(cell.beam_gain_db == -60);
    CHECK(std::isnan(cell.tx_beam));
  }
  CHECK(std::isnan(map.cells[0].rx_beam));
  CHECK(map.cells[1].rx_beam == 65535);
}

TEST_CASE("layers that need a key of the radio are left out, or refused if they were named") {
  MadeGrid made(2, 2, {{0, 0, 20}});
  made.add(0, 0, 1e-3, 1e-7, 0);
  const SavedRun run = made.written();
  RadioConfig radio;
  const auto refusal = [&](const std::string& layer) {
    try {
      map_of(run, radio, {.layers = {layer}});
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  Map map = map_of(run, radio);
  CHECK(map.layers.size() == layer_kinds.size() - 7);
  REQUIRE(map.left_out.size() == 3);
  CHECK(map.left_out[0] ==
        "received_dbm, interference_dbm need radio.transmit_power_dbm, which the run's configuration does not set");
  CHECK(
      refusal("tx_beam") ==
      "--layers tx_beam needs the links.csv of a run where a transmitter or the grid has an [[array]] with a codebook");
  CHECK(
      refusal("sinr_db") ==
      "--layers sinr_db needs radio.transmit_power_dbm and radio.bandwidth_hz, which the run's configuration does not "
      "set");
  radio.transmit_power_dbm = 30;
  CHECK(refusal("received_dbm").empty());
  CHECK(refusal("snr_db").find("needs radio.bandwidth_hz, which") != std::string::npos);
  CHECK(refusal("path_gian_db").find("did you mean \"path_gain_db\"?") != std::string::npos);
  map = map_of(run, radio, {.layers = {"paths", "received_dbm", "paths"}});
  REQUIRE(map.layers.size() == 2);
  CHECK(map.layers[0]->name == "paths");
  CHECK(map.values(*map.layers[1])[0] == near(-30));
}

TEST_CASE("a grid that is not whole is refused") {
  MadeGrid made(3, 2, {{0, 0, 20}});
  made.sample.config.receivers[2].name = "g/1,7";
  const SavedRun run = made.written();
  CHECK_THROWS_WITH_AS(map_of(run, {}), doctest::Contains("receivers of the grid \"g\" are missing, or there twice"),
                       InputError);
}
