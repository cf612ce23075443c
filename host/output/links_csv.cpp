// SPDX-License-Identifier: Apache-2.0
// Writes the figures of radio/links.hpp as comma-separated text, sorted by frame, transmitter, receiver.
// One frame at a time is in memory, and a small part of its rows as text.
#include "output/links_csv.hpp"
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>
#include "base/csv.hpp"
#include "output/copy_pieces.hpp"
#include "output/path_limits.hpp"
#include "radio/link_budget.hpp"
#include "radio/links.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr std::string_view header =
    "time_s,tx,rx,paths,path_gain_db,sum_of_powers_db,narrowband_gain_db,mean_delay_s,rms_delay_spread_s,"
    "doppler_spread_hz,los,"
    "missed_power_share,received_dbm,snr_db,paths_left_out,left_out_power_share,tx_beam,rx_beam,"
    "beam_gain_db,k_factor_db\n";

std::span<const std::byte> bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string label(const std::vector<RadioEnd>& ends, size_t i) {
  const std::string& name = ends.at(i).name;
  return name.empty() ? std::to_string(i) : csv_field(name);
}

// Returns the pair of beams with the largest gain, and that gain. beam: the first row that may belong to the link; it
// is moved to the first one that may belong to the next link.
std::string best_beams(const BeamRows& beams, const Link& link, size_t& beam) {
  while (beam < beams.size() && Link{beams.tx[beam], beams.rx[beam]} < link) ++beam;
  size_t best = beam;
  const size_t first = beam;
  for (; beam < beams.size() && Link{beams.tx[beam], beams.rx[beam]} == link; ++beam)
    if (beams.gain_db[beam] > beams.gain_db[best]) best = beam;
  if (beam == first || std::isinf(beams.gain_db[best])) return beam == first ? "nan,nan,nan" : "nan,nan,-inf";
  return fmt::format("{},{},{}", beams.tx_beam[best], beams.rx_beam[best], beams.gain_db[best]);
}

// Returns the first row of sorted columns that belongs to this link, or to a later one.
size_t first_row(const std::vector<uint32_t>& tx, const std::vector<uint32_t>& rx, const Link& link) {
  const auto rows = std::views::iota(size_t{0}, tx.size());
  return static_cast<size_t>(std::ranges::partition_point(rows,
                                                          [&](size_t row) {
                                                            return Link{tx[row], rx[row]} < link;
                                                          }) -
                             rows.begin());
}

}  // namespace

LinksCsv::LinksCsv(const Run& run, const std::filesystem::path& path)
    : file_(path), radio_(run.config.radio), tx_(run.config.transmitters), rx_(run.config.receivers) {
  file_.write(bytes(header));
}

std::string LinksCsv::rows(const FrameResult& frame, std::span<const LinkFigures> links,
                           std::span<const uint8_t> written) const {
  std::string text, tx;
  const Link first{links.front().tx, links.front().rx};
  size_t row = first_row(frame.paths.tx, frame.paths.rx, first),
         beam = first_row(frame.beams.tx, frame.beams.rx, first);
  for (const LinkFigures& link : links) {
    if (&link == links.data() || link.tx != (&link - 1)->tx) tx = label(tx_, link.tx);
    while (row < frame.paths.size() && Link{frame.paths.tx[row], frame.paths.rx[row]} < Link{link.tx, link.rx}) ++row;
    // If the device has summed the paths, all are left out.
    const LeftOutPaths gone =
        frame.summed ? LeftOutPaths{link.paths, 1, 1} : left_out(frame.paths, written, row, row + link.paths);
    if (!frame.summed) row += link.paths;
    const std::string best = best_beams(frame.beams, {link.tx, link.rx}, beam);
    const LinkBudget budget = link_budget(radio_, link.path_gain_db);
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{:d},{},{},{},{},{},{},{}\n",
                   frame.world.time_s, tx, label(rx_, link.rx), link.paths, link.path_gain_db, link.sum_of_powers_db,
                   link.narrowband_gain_db, link.mean_delay_s, link.rms_delay_spread_s, link.doppler_spread_hz,
                   link.los, link.missed_power_share, budget.received_dbm, budget.snr_db, gone.paths,
                   gone.paths > 0 && gone.all > 0 ? gone.power / gone.all : 0.0, best, 10 * std::log10(link.k_factor));
  }
  return text;
}

void LinksCsv::add(const FrameResult& frame, std::span<const uint8_t> written) {
  std::vector<LinkFigures> computed;
  if (!frame.summed) computed = link_figures(frame.paths, frame.frame, frame.world.links, radio_.frequency_hz);
  const std::span<const LinkFigures> links = frame.summed ? frame.summed->links : computed;
  constexpr size_t links_of_text = 2048;
  std::array<std::string, 16> texts;  // written by all cores, and stored before the next ones
  for (size_t first = 0; first < links.size(); first += texts.size() * links_of_text) {
    const size_t count = std::min(texts.size(), (links.size() - first + links_of_text - 1) / links_of_text);
    tbb::parallel_for(size_t{0}, count, [&](size_t i) {
      const size_t from = first + i * links_of_text;
      texts[i] = rows(frame, links.subspan(from, std::min(links_of_text, links.size() - from)), written);
    });
    for (size_t i = 0; i < count; ++i) file_.write(bytes(texts[i]));
  }
}

PendingFile LinksCsv::finish() {
  file_.sync();
  return std::move(file_);
}

void join_links_csv(std::span<const std::filesystem::path> parts, PendingFile& file) {
  file.write(bytes(header));
  uint64_t end = header.size();
  Pieces pieces;
  for (const std::filesystem::path& part : parts) {
    const uint64_t rows = std::max<uint64_t>(std::filesystem::file_size(part), header.size()) - header.size();
    pieces.push_back({{header.size(), end, rows}});
    end += rows;
  }
  file.reserve(end);
  copy_pieces(parts, pieces, file);
}

void prove_links_csv(std::span<const std::filesystem::path> parts, const std::filesystem::path& file) {
  constexpr size_t at_once = 1 << 20;
  std::ifstream joined(file, std::ios::binary);
  std::string wanted(header), found(header.size(), '\0');
  const auto refuse_unless = [&file](bool same) {
    if (same) return;
    throw RuntimeError(
        fmt::format("{}: does not read back as it was written, so nothing was removed; check the disk, "
                    "and run again with --resume",
                    file.string()));
  };
  const auto check = [&] {
    found.resize(wanted.size());
    refuse_unless(joined.read(found.data(), static_cast<std::streamsize>(found.size())) && found == wanted);
  };
  check();
  for (const std::filesystem::path& part : parts) {
    std::ifstream rows(part, std::ios::binary);
    rows.seekg(static_cast<std::streamoff>(header.size()));
    do {
      wanted.resize(at_once);
      rows.read(wanted.data(), at_once);
      wanted.resize(static_cast<size_t>(rows.gcount()));
      check();
    } while (rows);
  }
  refuse_unless(joined.peek() == std::ifstream::traits_type::eof());  // there must be no more than the parts have
}

}  // namespace wavetracer
