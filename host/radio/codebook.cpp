// SPDX-License-Identifier: Apache-2.0
// Codebooks by formula and from files.
#include "radio/codebook.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/input_file.hpp"
#include "wavetracer/arrays.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr std::string_view codebook_header = "beam,element,re,im";
constexpr uint32_t most_beams = 65536;
constexpr uint64_t most_weights = uint64_t{1} << 26;  // in a codebook: 1 GiB

// The place of a line of a codebook file, for errors.
struct CodebookLine {
  const std::string& file;
  size_t number;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file, number, what));
  }

  template <class T>
  T value(std::string_view text, std::string_view column, std::string_view wanted) const {
    while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
    while (text.ends_with(' ') || text.ends_with('\t') || text.ends_with('\r')) text.remove_suffix(1);
    T out{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(static_cast<double>(out)))
      fail(fmt::format("\"{}\" in column {} is not {}", text, column, wanted));
    return out;
  }

  std::array<std::string_view, 4> cells(std::string_view text) const {
    std::array<std::string_view, 4> out;
    for (size_t i = 0; i < out.size(); ++i) {
      const size_t comma = text.find(',');
      if ((comma == text.npos) != (i + 1 == out.size()))
        fail(fmt::format("a row needs four values: {}", codebook_header));
      out[i] = text.substr(0, comma);
      if (comma != text.npos) text.remove_prefix(comma + 1);
    }
    return out;
  }
};

using Weights = std::map<std::pair<uint32_t, uint32_t>, std::complex<double>>;  // by beam and element

void read_weight(const CodebookLine& line, std::string_view text, uint32_t elements, Weights& weights) {
  const auto cells = line.cells(text);
  const auto beam = line.value<uint32_t>(cells[0], "beam", "the number of a beam, counted from 0"),
             element = line.value<uint32_t>(cells[1], "element", "the number of an element, counted from 0");
  if (beam >= most_beams) line.fail(fmt::format("beam {} is one too many: {} are the limit", beam, most_beams));
  if (element >= elements)
    line.fail(fmt::format("element {} is not there: the array has {}, counted from 0", element, elements));
  const std::complex<double> weight(line.value<double>(cells[2], "re", "a finite number"),
                                    line.value<double>(cells[3], "im", "a finite number"));
  if (!weights.try_emplace({beam, element}, weight).second)
    line.fail(fmt::format("element {} of beam {} has a weight already", element, beam));
}

Weights read_weights(const std::string& file, uint32_t elements) {
  check_input_file(file, "the codebook", uint64_t{256} << 20);
  std::ifstream stream(file);
  if (!stream) throw InputError(fmt::format("{}: the codebook cannot be opened", file));
  Weights weights;
  std::string text;
  bool header_seen = false;
  for (size_t number = 1; std::getline(stream, text); ++number) {
    if (number == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // a byte order mark, as Excel writes it
    if (text.ends_with('\r')) text.pop_back();
    if (text.empty() || text.front() == '#') continue;
    const CodebookLine line{file, number};
    if (header_seen)
      read_weight(line, text, elements, weights);
    else if (text != codebook_header)
      line.fail(fmt::format("a codebook begins with the header {}", codebook_header));
    header_seen = true;
  }
  if (weights.empty()) throw InputError(fmt::format("{}: the codebook has no rows", file));
  return weights;
}

}  // namespace

Codebook dft_codebook(uint32_t rows, uint32_t columns) {
  Codebook out{rows * columns, rows * columns, {}};
  const double amplitude = 1 / std::sqrt(static_cast<double>(out.elements));
  if (uint64_t{out.beams} * out.elements > most_weights)
    throw ConfigError(fmt::format(
        "codebook = \"dft\" of {} x {} elements has more than 2^26 weights: use a smaller panel, or a codebook file",
        rows, columns));
  out.weights.reserve(uint64_t{out.beams} * out.elements);
  for (uint32_t beam = 0; beam < out.beams; ++beam)
    for (uint32_t element = 0; element < out.elements; ++element) {
      // Rows go down, so their phases grow upwards, in the opposite sense to those of columns.
      const double down = static_cast<double>(beam % rows) * (element % rows) / rows,
                   left = static_cast<double>(beam / rows) * (element / rows) / columns;
      out.weights.push_back(std::polar(amplitude, 2 * std::numbers::pi * std::fmod(down - left, 1.0)));
    }
  return out;
}

Codebook load_codebook(const std::string& file, uint32_t elements) {
  const Weights weights = read_weights(file, elements);
  Codebook out{weights.rbegin()->first.first + 1, elements, {}};
  if (uint64_t{out.beams} * elements > most_weights)
    throw InputError(fmt::format("{}: {} beams of {} elements are more than 2^26 weights", file, out.beams, elements));
  out.weights.resize(uint64_t{out.beams} * elements);
  for (const auto& [place, weight] : weights) out.weights[uint64_t{place.first} * elements + place.second] = weight;
  for (uint32_t beam = 0; beam < out.beams; ++beam) {
    const auto first = out.weights.begin() + static_cast<std::ptrdiff_t>(uint64_t{beam} * elements);
    double largest = 0, power = 0;
    for (auto w = first; w != first + elements; ++w)
      largest = std::max({largest, std::abs(w->real()), std::abs(w->imag())});
    if (!(largest > 0)) throw InputError(fmt::format("{}: beam {} has no weight but 0", file, beam));
    for (auto w = first; w != first + elements; ++w) power += std::norm(*w /= largest);
    for (auto w = first; w != first + elements; ++w) *w /= std::sqrt(power);
  }
  return out;
}

Codebook codebook_of(const Config& config, const RadioEnd& end) {
  const auto array = std::ranges::find(config.arrays, end.array, &ArrayConfig::name);
  if (end.array.empty() || array == config.arrays.end() || !array->has_codebook()) return {};
  if (array->codebook != "dft")
    return load_codebook(array->codebook, static_cast<uint32_t>(element_positions_m(config, end).size()));
  if (!array->positions_m.empty())
    throw ConfigError(fmt::format(
        "[[array]] \"{}\" has positions_m, but codebook = \"dft\" needs a panel of rows and columns", array->name));
  return dft_codebook(array->rows, array->columns);
}

bool has_beams(const Config& config) {
  return std::ranges::any_of(config.arrays, [](const ArrayConfig& array) { return array.has_codebook(); });
}

}  // namespace wavetracer
