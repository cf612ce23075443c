// SPDX-License-Identifier: Apache-2.0
// Elements differ only by phase and spreading, so ports are taken as a whole: the power of a path over its ports, times
// the result of the beams for its elements. Links are computed on all cores.
#include "radio/beams.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "radio/element_link.hpp"
#include "radio/grouped_power.hpp"
#include "radio/path_power.hpp"
#include "radio/unit_phases.hpp"
#include "radio/wide_loops.hpp"

namespace wavetracer {
namespace {

using Complex = std::complex<double>;

constexpr size_t port_pairs = 4;  // pairs of ports, as in Paths::a

// A codebook that uses the first element alone.
Codebook first_element(uint32_t elements) {
  Codebook out{1, elements, std::vector<Complex>(elements)};
  out.weights[0] = 1;
  return out;
}

// The weights as columns of beams, one column for each element.
struct BeamColumns {
  size_t beams, elements;
  std::vector<double> re, im;  // (element, beam)

  explicit BeamColumns(const Codebook& book) : beams(book.beams), elements(book.elements) {
    for (size_t element = 0; element < elements; ++element)
      for (size_t beam = 0; beam < beams; ++beam) {
        const Complex& weight = book.weights[beam * elements + element];
        re.push_back(weight.real());
        im.push_back(weight.imag());
      }
  }
};

// The sums of the beams of a link, for one of its paths after the other.
class LinkBeams {
 public:
  LinkBeams(const Codebook& sent, const Codebook& heard)
      : sent_(sent),
        heard_(heard),
        late_s_(sent.elements),
        amplitude_(sent.elements),
        phase_re_(sent.elements),
        phase_im_(sent.elements),
        by_sent_re_(size_t{sent.beams} * heard.elements),
        by_sent_im_(by_sent_re_.size()),
        re(size_t{sent.beams} * heard.beams),
        im(re.size()) {}

  // Computes the sums for one path, into re and im.
  void hear(const PathOfElements& path, double carrier_hz, double delay_s);

 private:
  BeamColumns sent_, heard_;
  std::vector<double> late_s_, amplitude_, phase_re_, phase_im_;
  std::vector<double> by_sent_re_, by_sent_im_;  // (rx element, tx beam)

 public:
  std::vector<double> re, im;  // (tx beam, rx beam)
};

WAVETRACER_WIDE void LinkBeams::hear(const PathOfElements& path, double carrier_hz, double delay_s) {
  for (auto* column : {&by_sent_re_, &by_sent_im_, &re, &im}) std::fill(column->begin(), column->end(), 0.0);
  for (size_t r = 0; r < heard_.elements; ++r) {
    path.between(r, 0, sent_.elements, late_s_.data(), amplitude_.data());
    for (double& late : late_s_) late = carrier_hz * (late - delay_s);
    unit_phases(late_s_.data(), sent_.elements, phase_re_.data(), phase_im_.data());
    for (size_t t = 0; t < sent_.elements; ++t)
      add_product({amplitude_[t] * phase_re_[t], amplitude_[t] * phase_im_[t]}, &sent_.re[t * sent_.beams],
                  &sent_.im[t * sent_.beams], sent_.beams, &by_sent_re_[r * sent_.beams],
                  &by_sent_im_[r * sent_.beams]);
  }
  for (size_t beam = 0; beam < sent_.beams; ++beam)
    for (size_t r = 0; r < heard_.elements; ++r)
      add_product({by_sent_re_[r * sent_.beams + beam], by_sent_im_[r * sent_.beams + beam]},
                  &heard_.re[r * heard_.beams], &heard_.im[r * heard_.beams], heard_.beams, &re[beam * heard_.beams],
                  &im[beam * heard_.beams]);
}

}  // namespace

Beams::Beams(const Config& config) {
  find(config, config.transmitters, transmitters_);
  find(config, config.receivers, receivers_);
}

void Beams::find(const Config& config, const std::vector<RadioEnd>& ends, std::vector<const Codebook*>& out) {
  for (const RadioEnd& end : ends) {
    auto found = codebooks_.find(end.array);
    if (found == codebooks_.end()) found = codebooks_.emplace(end.array, codebook_of(config, end)).first;
    out.push_back(found->second.beams > 0 ? &found->second : nullptr);
  }
}

BeamRows Beams::gains(const ElementModel& model, const FrameResult& frame) const {
  const std::vector<Link>& links = frame.world.links;
  std::vector<size_t> first{0};
  const auto beams = [](const Codebook* codebook) { return codebook ? size_t{codebook->beams} : 1; };
  const auto counted = [&](const Link& link) { return transmitters_.at(link.tx) || receivers_.at(link.rx); };
  for (const Link& link : links)
    first.push_back(first.back() +
                    (counted(link) ? beams(transmitters_[link.tx]) * beams(receivers_[link.rx]) : size_t{0}));
  BeamRows out;
  for (auto* column : {&out.tx, &out.rx, &out.tx_beam, &out.rx_beam}) column->resize(first.back());
  out.gain_db.resize(first.back());
  tbb::parallel_for(size_t{0}, links.size(), [&](size_t i) {
    const Link link = links[i];
    if (!counted(link)) return;
    const Codebook none_sent = first_element(model.tx_elements(link.tx)),
                   none_heard = first_element(model.rx_elements(link.rx));
    const Codebook &sent = transmitters_[link.tx] ? *transmitters_[link.tx] : none_sent,
                   &heard = receivers_[link.rx] ? *receivers_[link.rx] : none_heard;
    const ElementLink elements(model, frame, link);
    LinkBeams made(sent, heard);
    std::vector<double> power(first[i + 1] - first[i]);
    GroupFields groups(frame.paths, elements.first_row(), elements.end_row(), port_pairs * power.size());
    std::vector<Complex> fields(port_pairs * power.size());
    for (size_t row = elements.first_row(); row < elements.end_row(); ++row) {
      made.hear(elements.path(row), model.carriers_hz()[0], frame.paths.delay_s[row]);
      if (groups.is_alone(row)) {
        for (size_t k = 0; k < power.size(); ++k)
          power[k] += power_of(frame.paths, row) * (made.re[k] * made.re[k] + made.im[k] * made.im[k]);
        continue;
      }
      const Complex carrier = carrier_phase(model.carriers_hz()[0], frame.paths.delay_s[row]);
      for (size_t v = 0; v < fields.size(); ++v)
        fields[v] =
            carrier * frame.paths.a[row][v % port_pairs] * Complex(made.re[v / port_pairs], made.im[v / port_pairs]);
      groups.add(row, fields);
    }
    groups.add_powers(power);
    for (size_t k = 0; k < power.size(); ++k) {
      const size_t at = first[i] + k;
      out.tx[at] = link.tx;
      out.rx[at] = link.rx;
      out.tx_beam[at] = static_cast<uint32_t>(k / heard.beams);
      out.rx_beam[at] = static_cast<uint32_t>(k % heard.beams);
      out.gain_db[at] = 10 * std::log10(power[k]);
    }
  });
  return out;
}

}  // namespace wavetracer
