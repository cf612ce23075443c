// One row after the other, so memory holds two numbers per row and a sum per pair.
// Columns are found by their names.
#include "jobs/link_statistics.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <string_view>
#include <unordered_map>
#include "simulation/receiver_grid.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// The fields of an RFC 4180 record. A quoted field may hold line ends, so a record may take several lines.
bool read_record(std::istream& file, std::vector<std::string>& fields) {
  fields.assign(1, "");
  bool quoted = false, any = false;
  for (int c = file.get(); c != EOF; c = file.get()) {
    any = true;
    if (quoted) {
      if (c != '"')
        fields.back() += static_cast<char>(c);
      else if (file.peek() == '"')
        fields.back() += static_cast<char>(file.get());
      else
        quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      fields.emplace_back();
    } else if (c == '\n') {
      return true;
    } else {
      fields.back() += static_cast<char>(c);
    }
  }
  return any;
}

struct Sum {
  bool forwards = false, backwards = false;
  std::string tx, rx;
  double power = 0, delay_spread_s = 0;
  uint64_t rows = 0, los_rows = 0;
};

class Reader {
 public:
  Reader(const std::filesystem::path& path, const Config& config) : path_(path), file_(path, std::ios::binary) {
    for (const ReceiverGridConfig& grid : config.receiver_grids) grids_.push_back({grid.name, {}});
    for (const RadioEnd& end : config.receivers)
      for (size_t g = 0; g < grids_.size(); ++g)
        if (grid_cell(grids_[g].name, end.name)) {
          grid_of_[end.name] = g;
          grids_[g].best_db[end.name] = -INFINITY;
        }
  }

  LinkStatistics read() {
    std::vector<std::string> fields;
    if (!read_record(file_, fields)) fail("it is empty");
    header_ = fields;
    const size_t tx = column("tx"), rx = column("rx"), paths = column("paths"), gain = column("path_gain_db"),
                 spread = column("rms_delay_spread_s"), los = column("los");
    while (read_record(file_, fields)) {
      if (fields.size() != header_.size()) fail("its rows differ in length");
      add(fields[tx], fields[rx], number(fields[paths]), number(fields[gain]), number(fields[spread]),
          number(fields[los]) > 0);
    }
    finish();
    return std::move(out_);
  }

 private:
  struct Grid {
    std::string name;
    std::unordered_map<std::string, double> best_db;  // of each receiver
  };
  std::filesystem::path path_;
  std::ifstream file_;
  std::vector<std::string> header_;
  std::vector<Grid> grids_;
  std::unordered_map<std::string, size_t> grid_of_;
  std::map<std::pair<std::string, std::string>, Sum> sums_;  // by the names of the ends, the smaller first
  std::vector<double> gains_db_, spreads_s_;
  LinkStatistics out_;

  [[noreturn]] void fail(const std::string& why) const {
    throw RuntimeError(
        fmt::format("{}: {}, so the report cannot be made; was it changed by another program?", path_.string(), why));
  }
  size_t column(std::string_view name) const {
    const auto found = std::ranges::find(header_, name);
    if (found == header_.end()) fail(fmt::format("it has no column {}", name));
    return static_cast<size_t>(found - header_.begin());
  }
  double number(const std::string& text) const {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) fail("\"" + text + "\" is not a number");
    return value;
  }

  void add(const std::string& tx, const std::string& rx, double paths, double gain_db, double spread_s, bool los) {
    ++out_.asked;
    const auto grid = grid_of_.find(rx);
    Sum* sum = grid == grid_of_.end() ? &sums_[std::pair(std::min(tx, rx), std::max(tx, rx))] : nullptr;
    if (sum) {
      if (sum->tx.empty()) {
        sum->tx = tx;
        sum->rx = rx;
      }
      (sum->tx == tx ? sum->forwards : sum->backwards) = true;
    }
    if (paths == 0) return;
    ++out_.with_path;
    out_.los += los;
    if (!std::isfinite(gain_db)) return;
    gains_db_.push_back(gain_db);
    if (std::isfinite(spread_s)) spreads_s_.push_back(spread_s);
    if (sum) {
      sum->power += std::pow(10, gain_db / 10);
      sum->delay_spread_s += spread_s;
      ++sum->rows;
      sum->los_rows += los;
    } else {
      double& best = grids_[grid->second].best_db[rx];
      best = std::max(best, gain_db);
    }
  }

  void finish() {
    out_.gain_db = quantiles(std::move(gains_db_));
    out_.delay_spread_s = quantiles(std::move(spreads_s_));
    for (const auto& [names, sum] : sums_) {
      if (sum.rows == 0) continue;
      const auto rows = static_cast<double>(sum.rows);
      const char* const arrow = sum.forwards && sum.backwards ? "<->" : "->";
      out_.pairs.push_back({fmt::format("{} {} {}", sum.tx, arrow, sum.rx), 10 * std::log10(sum.power / rows),
                            sum.delay_spread_s / rows, sum.rows, sum.los_rows});
    }
    std::ranges::stable_sort(out_.pairs, std::ranges::greater(), &PairSummary::mean_gain_db);
    for (const Grid& grid : grids_) {
      std::vector<double> covered;
      for (const auto& [name, gain_db] : grid.best_db)
        if (std::isfinite(gain_db)) covered.push_back(gain_db);
      const uint64_t count = covered.size();
      out_.grids.push_back({grid.name, grid.best_db.size(), count, quantiles(std::move(covered))});
    }
  }
};

}  // namespace

Quantiles quantiles(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<size_t>(place);
    const double next = values[std::min(below + 1, values.size() - 1)];
    return values[below] + (place - static_cast<double>(below)) * (next - values[below]);
  };
  return {at(0.1), at(0.5), at(0.9)};
}

LinkStatistics link_statistics(const std::filesystem::path& links_csv, const Config& config) {
  return Reader(links_csv, config).read();
}

}  // namespace wavetracer
