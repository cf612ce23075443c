// SPDX-License-Identifier: Apache-2.0
// Arrays are padded to the largest number of antennas on either side.
#include "convert/response_arrays.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "convert/npz.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

std::optional<ResponseArray> response_array(const SavedRun& run, const ExportOptions& options, const char* format) {
  const std::optional<SavedResponses> saved = saved_responses(run);
  if (!saved) return std::nullopt;
  const auto largest = [](const std::vector<uint32_t>& antennas) {
    return antennas.empty() ? size_t{0} : size_t{std::ranges::max(antennas)};
  };
  ResponseArray out{.frames = options.last_row - options.first_row + 1,
                    .rx = saved->rx_antennas().size(),
                    .rx_antennas = largest(saved->rx_antennas()),
                    .tx = saved->tx_antennas().size(),
                    .tx_antennas = largest(saved->tx_antennas()),
                    .times = saved->times_s().size(),
                    .frequencies = saved->frequencies_hz().size(),
                    .re = {},
                    .im = {},
                    .frequencies_hz = saved->frequencies_hz(),
                    .times_s = saved->times_s()};
  double bytes = 16;
  for (const size_t size : {out.frames, out.rx, out.rx_antennas, out.tx, out.tx_antennas, out.times, out.frequencies})
    bytes *= static_cast<double>(size);
  if (bytes > static_cast<double>(npz_limit_bytes))
    throw InputError(fmt::format(
        "{}: responses of {} frames x {} receivers x {} transmitters, padded to {} x {} antennas, at {} times "
        "and {} "
        "frequencies take {:.3g} GB, and more than {:.3g} are not written; choose fewer frames with --frames, "
        "or read responses.h5",
        format, out.frames, out.rx, out.tx, out.rx_antennas, out.tx_antennas, out.times, out.frequencies, bytes / 1e9,
        static_cast<double>(npz_limit_bytes) / 1e9));
  out.re.resize(static_cast<size_t>(bytes / 16));
  out.im.resize(out.re.size());
  for (size_t row = options.first_row; row <= options.last_row; ++row)
    for (const SavedResponse& response : saved->frame(run.number(row))) {
      const size_t rx = saved->rx_antennas()[response.link.rx], tx = saved->tx_antennas()[response.link.tx];
      for (size_t i = 0; i < response.h.size(); ++i) {
        const size_t k = i % out.frequencies, t = i / out.frequencies % tx, r = i / out.frequencies / tx % rx,
                     time = i / out.frequencies / tx / rx;
        const size_t receiver = ((row - options.first_row) * out.rx + response.link.rx) * out.rx_antennas + r;
        const size_t pair = (receiver * out.tx + response.link.tx) * out.tx_antennas + t;
        const size_t cell = (pair * out.times + time) * out.frequencies + k;
        out.re[cell] = response.h[i].real();
        out.im[cell] = response.h[i].imag();
      }
    }
  return out;
}

}  // namespace wavetracer
