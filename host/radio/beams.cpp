// Elements differ by phase and spreading alone, so ports are taken as a whole: the power of a path over its ports times
// what beams make of its elements. Links on all cores.
#include "radio/beams.hpp"

#include <tbb/parallel_for.h>

#include <cmath>

#include "radio/element_link.hpp"
#include "radio/path_power.hpp"
#include "radio/unit_phases.hpp"

namespace wavetracer {
namespace {

using Complex = std::complex<double>;

Complex times(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

// The first element alone.
Codebook first_element(uint32_t elements) {
  Codebook out{1, elements, std::vector<Complex>(elements)};
  out.weights[0] = 1;
  return out;
}

// What the beams make of one path's elements, (tx beam, rx beam).
std::vector<Complex> through_beams(const PathOfElements& path, double carrier_hz, double delay_s, const Codebook& sent,
                                   const Codebook& heard) {
  std::vector<Complex> by_sent(size_t{sent.beams} * heard.elements);
  std::vector<double> late_s(sent.elements), amplitude(sent.elements), re(sent.elements), im(sent.elements);
  for (uint32_t r = 0; r < heard.elements; ++r) {
    path.between(r, 0, sent.elements, late_s.data(), amplitude.data());
    for (double& late : late_s) late = carrier_hz * (late - delay_s);
    unit_phases(late_s.data(), sent.elements, re.data(), im.data());
    for (uint32_t beam = 0; beam < sent.beams; ++beam) {
      Complex sum = 0;
      for (uint32_t t = 0; t < sent.elements; ++t)
        sum += times({amplitude[t] * re[t], amplitude[t] * im[t]}, sent.weights[size_t{beam} * sent.elements + t]);
      by_sent[size_t{beam} * heard.elements + r] = sum;
    }
  }
  std::vector<Complex> out;
  for (uint32_t tx_beam = 0; tx_beam < sent.beams; ++tx_beam)
    for (uint32_t rx_beam = 0; rx_beam < heard.beams; ++rx_beam) {
      Complex sum = 0;
      for (uint32_t r = 0; r < heard.elements; ++r)
        sum +=
            times(by_sent[size_t{tx_beam} * heard.elements + r], heard.weights[size_t{rx_beam} * heard.elements + r]);
      out.push_back(sum);
    }
  return out;
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
    std::vector<double> power(first[i + 1] - first[i]);
    for (size_t row = elements.first_row(); row < elements.end_row(); ++row) {
      const auto made =
          through_beams(elements.path(row), model.carriers_hz()[0], frame.paths.delay_s[row], sent, heard);
      for (size_t k = 0; k < power.size(); ++k) power[k] += power_of(frame.paths, row) * std::norm(made[k]);
    }
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
