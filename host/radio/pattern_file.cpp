// SPDX-License-Identifier: Apache-2.0
// Antenna patterns read from a CSV grid; the format is documented at load_pattern.
// Angles may have at most six decimals: the grid is compared in whole micro-degrees.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <string_view>
#include <vector>

#include "base/input_file.hpp"
#include "radio/pattern.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr std::string_view header = "theta_deg,phi_deg,v_re,v_im,h_re,h_im";
constexpr int64_t half_turn = 180'000'000, full_turn = 360'000'000;  // micro-degrees

struct Sample {
  FieldPair field;
  size_t line;
};

using Key = std::pair<int64_t, int64_t>;  // theta, phi in micro-degrees, phi in [0, full_turn)
using Samples = std::map<Key, Sample>;

[[noreturn]] void fail(const std::string& file, size_t line, const std::string& what) {
  throw InputError(fmt::format("{}:{}: {}", file, line, what));
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == text.npos ? std::string_view{} : text.substr(first, last - first + 1);
}

std::array<double, 6> parse_row(const std::string& file, size_t line, std::string_view text) {
  std::array<double, 6> row;
  for (size_t column = 0; column < row.size(); ++column) {
    const size_t comma = text.find(',');
    if ((comma == text.npos) != (column + 1 == row.size())) {
      fail(file, line, fmt::format("a row needs six values: {}", header));
    }
    const std::string_view value = trimmed(text.substr(0, comma));
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), row[column]);
    if (error != std::errc{} || end != value.data() + value.size() || !std::isfinite(row[column])) {
      fail(file, line, fmt::format("\"{}\" in column {} is not a finite number", value, column + 1));
    }
    if (comma != text.npos) text.remove_prefix(comma + 1);
  }
  return row;
}

void insert(const std::string& file, Samples& samples, size_t line, const std::array<double, 6>& row) {
  if (row[0] < 0 || row[0] > 180) fail(file, line, fmt::format("theta_deg = {} is not within 0 to 180", row[0]));
  if (std::abs(row[1]) > 360) fail(file, line, fmt::format("phi_deg = {} is not within -360 to 360", row[1]));
  const int64_t phi = (std::llround(row[1] * 1e6) + full_turn) % full_turn;
  const FieldPair field{{row[2], row[3]}, {row[4], row[5]}};
  const auto [at, added] = samples.try_emplace({std::llround(row[0] * 1e6), phi}, Sample{field, line});
  const FieldPair& earlier = at->second.field;
  if (!added && (earlier.theta != field.theta || earlier.phi != field.phi)) {
    fail(file, line, fmt::format("this direction has another value in line {}", at->second.line));
  }
}

Samples read_samples(const std::string& file) {
  check_input_file(file, "the antenna pattern", uint64_t{256} << 20);  // bytes; one with every degree has 4 MB
  std::ifstream stream(file);
  if (!stream) throw InputError(fmt::format("{}: the antenna pattern cannot be opened", file));
  Samples samples;
  std::string text;
  bool header_seen = false;
  for (size_t line = 1; std::getline(stream, text); ++line) {
    if (line == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // a byte order mark, as Excel writes it
    const std::string_view content = trimmed(text);
    if (content.empty() || content.front() == '#') continue;
    if (header_seen) {
      insert(file, samples, line, parse_row(file, line, content));
    } else if (content == header) {
      header_seen = true;
    } else {
      fail(file, line, fmt::format("an antenna pattern begins with the header {}", header));
    }
  }
  if (samples.empty()) throw InputError(fmt::format("{}: the antenna pattern has no rows", file));
  return samples;
}

double degrees(int64_t micro_degrees) { return static_cast<double>(micro_degrees) * 1e-6; }

// The step of a regular axis that covers `span`, the sum of `steps` equal steps.
double regular_step(const std::string& file, const char* name, const std::set<int64_t>& values, int64_t span,
                    size_t steps) {
  const double step = static_cast<double>(span) / static_cast<double>(steps);
  double expected = static_cast<double>(*values.begin());
  for (const int64_t value : values) {
    if (std::abs(static_cast<double>(value) - expected) > 1000) {  // files are commonly printed with three decimals
      throw InputError(fmt::format("{}: {} = {:g} is not on a regular grid: {} values make steps of {:g} degrees", file,
                                   name, degrees(value), values.size(), step * 1e-6));
    }
    expected += step;
  }
  return step;
}

}  // namespace

PatternGrid load_pattern(const std::string& file) {
  const Samples samples = read_samples(file);
  std::set<int64_t> thetas, phis;
  for (const auto& [key, sample] : samples) {
    thetas.insert(key.first);
    phis.insert(key.second);
  }
  if (*thetas.begin() != 0 || *thetas.rbegin() != half_turn) {
    throw InputError(fmt::format("{}: theta_deg goes from {:g} to {:g}; it must cover 0 to 180", file,
                                 degrees(*thetas.begin()), degrees(*thetas.rbegin())));
  }
  PatternGrid grid{.rows = static_cast<uint32_t>(thetas.size()),
                   .columns = static_cast<uint32_t>(phis.size()),
                   .theta_step = regular_step(file, "theta_deg", thetas, half_turn, thetas.size() - 1),
                   .phi_step = regular_step(file, "phi_deg", phis, full_turn, phis.size()),
                   .first_phi = static_cast<double>(*phis.begin()),
                   .samples = {}};
  for (const int64_t theta : thetas) {
    for (const int64_t phi : phis) {
      const auto at = samples.find({theta, phi});
      if (at == samples.end()) {
        throw InputError(fmt::format("{}: the direction theta_deg = {:g}, phi_deg = {:g} is missing from the grid",
                                     file, degrees(theta), degrees(phi)));
      }
      const FieldPair& field = at->second.field;
      grid.samples.insert(grid.samples.end(),
                          {field.theta.real(), field.theta.imag(), field.phi.real(), field.phi.imag()});
    }
  }
  return grid;
}

}  // namespace wavetracer
