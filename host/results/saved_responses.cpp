// SPDX-License-Identifier: Apache-2.0
// Links and their offsets are checked and kept at opening; rows are read by frame.
#include "results/saved_responses.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "base/input_file.hpp"
#include "output/foreign_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t most_antennas = 2 * 65536;  // limit for an end

}  // namespace

struct SavedResponses::State {
  fs::path path;
  hdf5::ForeignFile file;
  std::vector<double> frequencies_hz, times_s;
  std::vector<uint32_t> tx_antennas, rx_antennas;
  std::vector<uint32_t> frames, tx, rx;  // for each link
  std::vector<uint64_t> offset;          // the first rows of each link

  explicit State(const fs::path& where) : path(where), file(where) {
    if (file.root_text("format") != "wavetracer responses")
      throw RuntimeError("its format is not \"wavetracer responses\"");
    if (const double format = file.root_number("format_version"); format != 1)
      throw RuntimeError(fmt::format("it has version {} of the format; this program reads 1", format));
    frequencies_hz = file.all_rows<double>("/frequencies/frequency_hz");
    times_s = file.all_rows<double>("/times/time_s");
    tx_antennas = antennas("/transmitters");
    rx_antennas = antennas("/receivers");
    frames = file.all_rows<uint32_t>("/links/frame");
    tx = file.all_rows<uint32_t>("/links/tx");
    rx = file.all_rows<uint32_t>("/links/rx");
    offset = file.all_rows<uint64_t>("/links/row_offset");
    check_links();
    for (const char* part : {"/responses/h_re", "/responses/h_im"})
      if (file.shape(part, {frequencies_hz.size()})[0] != offset.back())
        throw RuntimeError(fmt::format("{} has another number of rows than /links/row_offset says", part));
  }

  std::vector<uint32_t> antennas(const std::string& ends) const {
    const auto ports = file.all_rows<uint32_t>(ends + "/ports");
    const auto first = file.all_rows<uint64_t>(ends + "/first_element");
    if (first.size() != ports.size() + 1) throw RuntimeError(ends + " has columns of unequal length");
    std::vector<uint32_t> out;
    for (size_t i = 0; i < ports.size(); ++i) {
      const uint64_t elements = first[i + 1] - first[i];
      if (first[i + 1] < first[i] || elements == 0 || elements > most_antennas || ports[i] < 1 || ports[i] > 2)
        throw RuntimeError(fmt::format("{} has an end of no, or too many, elements or ports", ends));
      out.push_back(static_cast<uint32_t>(elements) * ports[i]);
    }
    return out;
  }

  void check_links() const {
    if (tx.size() != frames.size() || rx.size() != frames.size() || offset.size() != frames.size() + 1)
      throw RuntimeError("/links has columns of unequal length");
    if (!std::ranges::is_sorted(frames)) throw RuntimeError("/links/frame is not sorted");
    if (offset[0] != 0) throw RuntimeError("/links/row_offset does not begin with 0");
    for (size_t i = 0; i < frames.size(); ++i) {
      if (tx[i] >= tx_antennas.size() || rx[i] >= rx_antennas.size())
        throw RuntimeError(fmt::format("row {} of /links names an end that is not there", i));
      const uint64_t rows = uint64_t{tx_antennas[tx[i]]} * rx_antennas[rx[i]] * times_s.size();
      if (offset[i + 1] < offset[i] || offset[i + 1] - offset[i] != rows)
        throw RuntimeError(fmt::format("row {} of /links has another number of responses than its antennas make", i));
    }
  }

  std::vector<SavedResponse> read(uint32_t number) const {
    const auto [begin, end] = std::ranges::equal_range(frames, number);
    const auto first = static_cast<size_t>(begin - frames.begin()), last = static_cast<size_t>(end - frames.begin());
    std::vector<SavedResponse> out;
    for (size_t i = first; i < last; ++i) {
      const auto part = [&](const char* name) {
        return file.rows<double>(name, offset[i], offset[i + 1] - offset[i], {frequencies_hz.size()});
      };
      const std::vector<double> re = part("/responses/h_re"), im = part("/responses/h_im");
      SavedResponse& response = out.emplace_back(SavedResponse{{tx[i], rx[i]}, {}});
      for (size_t k = 0; k < re.size(); ++k) response.h.emplace_back(re[k], im[k]);
    }
    return out;
  }
};

SavedResponses::SavedResponses(const fs::path& file) {
  check_input_file(file, "the responses.h5 of a run");
  try {
    state_ = std::make_unique<State>(file);
  } catch (const RuntimeError& e) {
    throw InputError(fmt::format("{}: cannot be read as the responses.h5 of a run: {}", file.string(), e.what()));
  }
}

SavedResponses::~SavedResponses() = default;
SavedResponses::SavedResponses(SavedResponses&&) noexcept = default;

const std::vector<double>& SavedResponses::frequencies_hz() const { return state_->frequencies_hz; }
const std::vector<double>& SavedResponses::times_s() const { return state_->times_s; }
const std::vector<uint32_t>& SavedResponses::tx_antennas() const { return state_->tx_antennas; }
const std::vector<uint32_t>& SavedResponses::rx_antennas() const { return state_->rx_antennas; }

std::vector<SavedResponse> SavedResponses::frame(uint32_t number) const {
  try {
    return state_->read(number);
  } catch (const RuntimeError& e) {
    throw InputError(fmt::format("{}: frame {}: {}", state_->path.string(), number, e.what()));
  }
}

std::optional<SavedResponses> saved_responses(const SavedRun& run) {
  std::error_code ignored;
  const fs::path file = run.file().parent_path() / "responses.h5";
  if (!fs::exists(file, ignored)) return std::nullopt;
  SavedResponses out(file);
  if (out.tx_antennas().size() != run.transmitters().size() || out.rx_antennas().size() != run.receivers().size())
    throw InputError(fmt::format("{}: it has other transmitters or receivers than {} beside it", file.string(),
                                 run.file().filename().string()));
  return out;
}

}  // namespace wavetracer
