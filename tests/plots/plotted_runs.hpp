// SPDX-License-Identifier: Apache-2.0
// Invented runs whose numbers are known, written as a run writes them, and the tables of figures as rows.
#pragma once
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "check_contains.hpp"
#include "output/sample_run.hpp"
#include "results/saved_run.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer::test {

using Row = std::map<std::string, std::string>;

inline std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> out(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

inline std::vector<Row> table(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> header = fields(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> values = fields(line);
    REQUIRE(values.size() == header.size());
    Row& row = rows.emplace_back();
    for (size_t i = 0; i < header.size(); ++i) row[header[i]] = values[i];
  }
  return rows;
}

inline double number(const Row& row, const std::string& column) { return std::strtod(row.at(column).c_str(), nullptr); }

template <class E>
std::string error_of(const auto& action) {
  try {
    action();
  } catch (const E& e) {
    return e.what();
  }
  return "no error";
}

// Written as a run writes it, in a folder of its own.
struct Written {
  SampleRun sample;
  TemporaryFolder folder;
  std::vector<FrameResult> frames;
  explicit Written(std::vector<FrameResult> of) : frames(std::move(of)) { write(); }
  Written(SampleRun run, std::vector<FrameResult> of) : sample(std::move(run)), frames(std::move(of)) { write(); }
  void write() { write_outputs(folder.path() / "run", sample.run(), frames); }
  SavedRun run() const { return SavedRun(folder.path() / "run"); }
};

inline double power_db(const Paths& paths, size_t row) {
  double power = 0;
  for (const auto& a : paths.a[row]) power += std::norm(a);
  return 10 * std::log10(power);
}

// A grid "g" of 3 x 2 behind a receiver of its own; transmitter 0 reaches cells 0 to 3, transmitter 1 cells 3 and 4,
// and none reaches cell 5. Powers are 10^-(tx + cell + 8).
inline Written grid_run() {
  SampleRun sample;
  sample.config.text =
      "scene.generate = \"--seed 1 --blocks 1x1\"\n"
      "[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 9]\n[[receiver]]\nname = \"r\"\nposition_m = [1, 1, 1]\n"
      "[[receiver_grid]]\nname = \"g\"\nx_min_m = 0\nx_max_m = 15\ny_min_m = 0\ny_max_m = 10\nstep_m = 5\n";
  sample.config.receivers = {{.name = "r"}};
  for (int cell = 0; cell < 6; ++cell)
    sample.config.receivers.push_back({.name = fmt::format("g/{},{}", cell % 3, cell / 3),
                                       .position_m = {2.5 + 5.0 * (cell % 3), 2.5 + 5.0 * (cell / 3), 1.5}});
  FrameResult frame = sample.empty().front();
  frame.world.links.clear();
  for (uint32_t tx = 0; tx < 2; ++tx)
    for (uint32_t rx = 0; rx < 7; ++rx) frame.world.links.push_back({tx, rx});
  Paths& p = frame.paths;
  const auto add = [&](uint32_t tx, uint32_t rx, double amplitude) {
    p.frame.push_back(0);
    p.tx.push_back(tx);
    p.rx.push_back(rx);
    p.depth.push_back(0);
    p.delay_s.push_back(1e-7);
    p.gain_db.push_back(20 * std::log10(amplitude));
    p.a.push_back({{{amplitude, 0}, {0, 0}, {0, 0}, {0, 0}}});
    for (auto* column : {&p.aod_theta_rad, &p.aod_phi_rad, &p.aoa_theta_rad, &p.aoa_phi_rad, &p.doppler_hz})
      column->push_back(0);
    p.vertex_offset.push_back(0);
  };
  const auto amplitude = [](uint32_t tx, uint32_t cell) { return std::pow(10, -0.5 * (tx + cell + 8.0)); };
  for (uint32_t cell = 0; cell < 4; ++cell)
    for (int half = 0; half < 2; ++half) add(0, cell + 1, amplitude(0, cell) * std::sqrt(0.5));  // two paths a cell
  for (uint32_t cell = 3; cell < 5; ++cell) add(1, cell + 1, amplitude(1, cell));
  return Written(std::move(sample), {frame});
}

}  // namespace wavetracer::test
