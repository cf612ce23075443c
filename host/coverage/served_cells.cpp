// SPDX-License-Identifier: Apache-2.0
// Links are walked twice: servers are found first, then the powers of all others are added, so that a weak sum keeps
// its digits beside a strong server.
#include "coverage/served_cells.hpp"
#include <cmath>
#include <utility>
#include "coverage/grid_cells.hpp"
#include "radio/link_budget.hpp"

namespace wavetracer::coverage {
namespace {

double to_db(double power) { return 10 * std::log10(power); }
double to_power(double db) { return std::pow(10, db / 10); }

void add_link(Heard& cell, const LinkRow& link, std::optional<uint32_t> tx) {
  if (!cell.best || link.path_gain_db > cell.best->path_gain_db)
    cell.second = std::exchange(cell.best, &link);
  else if (!cell.second || link.path_gain_db > cell.second->path_gain_db)
    cell.second = &link;
  if (!tx)
    cell.server = cell.best;
  else if (link.link.tx == *tx)
    cell.server = &link;
}

}  // namespace

std::vector<Heard> heard_links(std::span<const LinkRow> links, std::span<const uint32_t> cell_of, size_t cells,
                               std::optional<uint32_t> tx) {
  std::vector<Heard> heard(cells);
  const auto each = [&](const auto& visit) {
    for (const LinkRow& link : links)
      if (const uint32_t k = cell_of[link.link.rx]; k != no_cell && std::isfinite(link.path_gain_db))
        visit(heard[k], link);
  };
  each([&](Heard& cell, const LinkRow& link) { add_link(cell, link, tx); });
  each([&](Heard& cell, const LinkRow& link) {
    if (!cell.server || link.link.tx != cell.server->link.tx) cell.others += to_power(link.path_gain_db);
  });
  return heard;
}

Cell values_of(const Heard& heard, const RadioConfig& radio) {
  Cell cell;
  if (!heard.best) return cell;
  cell.best_server = heard.best->link.tx;
  if (heard.others > 0) cell.interference_dbm = link_budget(radio, to_db(heard.others)).received_dbm;
  if (!heard.server) return cell;
  const LinkRow& server = *heard.server;
  const LinkBudget budget = link_budget(radio, server.path_gain_db);
  cell.path_gain_db = server.path_gain_db;
  cell.narrowband_gain_db = server.narrowband_gain_db;
  cell.received_dbm = budget.received_dbm;
  cell.snr_db = budget.snr_db;
  const double disturbing_mw = to_power(noise_dbm(radio)) + (heard.others > 0 ? to_power(cell.interference_dbm) : 0);
  cell.sinr_db = budget.received_dbm - to_db(disturbing_mw);
  if (const LinkRow* const other = heard.server == heard.best ? heard.second : heard.best)
    cell.margin_db = server.path_gain_db - other->path_gain_db;
  cell.delay_spread_ns = server.rms_delay_spread_s * 1e9;
  cell.k_factor_db = to_db(server.k_factor);
  cell.line_of_sight = server.los ? 1 : 0;
  cell.paths = server.paths;
  cell.beam_gain_db = server.beam_gain_db;
  if (server.tx_beam) cell.tx_beam = *server.tx_beam;
  if (server.rx_beam) cell.rx_beam = *server.rx_beam;
  return cell;
}

}  // namespace wavetracer::coverage
