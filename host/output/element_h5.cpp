// SPDX-License-Identifier: Apache-2.0
// Each file has one table, except responses.h5, whose rows belong to links: links have different numbers of antennas.
#include "output/element_h5.hpp"
#include <fmt/format.h>
#include "wavetracer/arrays.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using hdf5::Meaning;

void write_element_root(const Run& run, hdf5::File& file, const std::string& format) {
  const auto text = [&](const char* name, const std::string& value) { hdf5::write_attribute(file.id(), name, value); };
  text("format", format);
  hdf5::write_attribute(file.id(), "format_version", uint32_t{1});
  text("version", run.summary.version);
  text("config_file", run.config.file);
  text("config", run.config.text);
  text("scene_file", run.scene.file);
}

void write_numbers(hdf5::File& file, const std::string& group, const std::string& description, const std::string& name,
                   const Meaning& meaning, const std::vector<double>& values) {
  const auto id = file.make_group(group, description);
  hdf5::Rows<double>(file, group + "/" + name, meaning, {values.size()}).append(values);
}

// Writes the elements of all ends of a role, one after the other.
void write_elements(hdf5::File& file, const std::string& group, const Config& config,
                    const std::vector<RadioEnd>& ends) {
  std::vector<std::string> names;
  std::vector<uint32_t> ports;
  std::vector<uint64_t> first{0};
  std::vector<double> positions_m;
  for (const RadioEnd& end : ends) {
    names.push_back(end.name);
    ports.push_back(ports_of(end.polarization));
    for (const glm::dvec3& p : element_positions_m(config, end)) positions_m.insert(positions_m.end(), {p.x, p.y, p.z});
    first.push_back(positions_m.size() / 3);
  }
  const auto id = file.make_group(group, "one row per end, as in paths.h5");
  file.write_strings(group + "/name", {"1", "as in paths.h5"}, names);
  hdf5::Rows<uint32_t>(file, group + "/ports", {"1", "ports of each element"}, {ports.size()}).append(ports);
  hdf5::Rows<uint64_t>(file, group + "/first_element",
                       {"1",
                        "the elements of end i are rows first_element[i] to first_element[i + 1] - 1 "
                        "of element_position_m"},
                       {first.size()})
      .append(first);
  hdf5::Rows<double>(file, group + "/element_position_m",
                     {"m", "of an element from the position of its end, in the axes of the antenna, (x, y, z)"},
                     {positions_m.size() / 3, 3})
      .append(positions_m);
}

[[noreturn]] void contradicts(const char* what, uint32_t frame) {
  throw RuntimeError(
      fmt::format("the {} of frame {} have columns of unequal length; this is a fault of wavetracer, "
                  "report it",
                  what, frame));
}

template <class T>
void append_column(FrameTables& tables, const char* name, const char* unit, const char* description,
                   const std::vector<T>& values) {
  tables.append(name, {unit, description}, std::span(values));
}

}  // namespace

void encode_responses_head_h5(const Run& run, hdf5::File& file) {
  write_element_root(run, file, "wavetracer responses");
  hdf5::write_attribute(file.id(), "convention_channel",
                        "h = sum over paths of a exp(-j 2 pi f delay) exp(j 2 pi doppler t), "
                        "f the absolute frequency and delay that between the two elements, t the time since "
                        "that of the frame; free space between isotropic antennas gives |h| = wavelength / (4 pi "
                        "distance)");
  hdf5::write_attribute(file.id(), "convention_wavefront", std::string(run.config.radio.wavefront.word()));
  write_numbers(file, "/frequencies", "the last axis of h_re and h_im", "frequency_hz",
                {"Hz", "absolute frequency; the subcarriers of each carrier in its order"},
                response_frequencies_hz(run.config));
  write_numbers(file, "/times", "times within each frame", "time_s", {"s", "since the time of the frame"},
                response_times_s(run.config));
  write_elements(file, "/transmitters", run.config, run.config.transmitters);
  write_elements(file, "/receivers", run.config, run.config.receivers);
}

void append_responses_h5(const Run&, const FrameResult& frame, FrameTables& tables) {
  const Responses& responses = frame.responses;
  const std::vector<Link>& links = frame.world.links;
  if (responses.row_offset.size() != links.size() + 1 ||
      responses.h.size() != responses.row_offset.back() * responses.frequencies)
    contradicts("responses", frame.frame);
  std::vector<uint32_t> tx, rx;
  for (const Link& link : links) {
    tx.push_back(link.tx);
    rx.push_back(link.rx);
  }
  tables.group("/links", "one row per frame and link that was asked for, sorted by frame, tx, rx");
  append_column(tables, "frame", "1", "number of the frame, see /frames/frame of paths.h5",
                std::vector<uint32_t>(links.size(), frame.frame));
  append_column(tables, "time_s", "s", "time of the frame", std::vector<double>(links.size(), frame.world.time_s));
  append_column(tables, "tx", "1", "row of /transmitters", tx);
  append_column(tables, "rx", "1", "row of /receivers", rx);
  append_column(tables, "row_offset", "1",
                "the responses of link row i are rows row_offset[i] to row_offset[i + 1] - 1 of /responses",
                responses.row_offset);
  std::vector<float> re, im;
  re.reserve(responses.h.size());
  im.reserve(responses.h.size());
  for (const std::complex<float>& h : responses.h) {
    re.push_back(h.real());
    im.push_back(h.imag());
  }
  tables.group("/responses",
               "of each link the rows (time, rx antenna, tx antenna), the last of which goes fastest; "
               "antenna i of an end is element i / ports, port i % ports");
  const std::string shape = " part of the channel h; shape (row, frequency)";
  tables.append<float>("h_re", {"1", "real" + shape}, re, {responses.frequencies});
  tables.append<float>("h_im", {"1", "imaginary" + shape}, im, {responses.frequencies});
}

void encode_beams_head_h5(const Run& run, hdf5::File& file) {
  write_element_root(run, file, "wavetracer beams");
  write_elements(file, "/transmitters", run.config, run.config.transmitters);
  write_elements(file, "/receivers", run.config, run.config.receivers);
}

void append_beams_h5(const Run&, const FrameResult& frame, FrameTables& tables) {
  const BeamRows& rows = frame.beams;
  for (const auto* column : {&rows.tx, &rows.rx, &rows.tx_beam, &rows.rx_beam})
    if (column->size() != rows.size()) contradicts("beams", frame.frame);
  tables.group("/beams",
               "one row per frame, link and pair of beams, of links of which an end has a codebook; sorted by frame, "
               "tx, rx, tx_beam, rx_beam");
  append_column(tables, "frame", "1", "number of the frame, see /frames/frame of paths.h5",
                std::vector<uint32_t>(rows.size(), frame.frame));
  append_column(tables, "tx", "1", "row of /transmitters", rows.tx);
  append_column(tables, "rx", "1", "row of /receivers", rows.rx);
  append_column(tables, "tx_beam", "1", "beam of the transmitter's codebook; 0, its first element, without a codebook",
                rows.tx_beam);
  append_column(tables, "rx_beam", "1", "beam of the receiver's codebook; 0, its first element, without a codebook",
                rows.rx_beam);
  append_column(tables, "gain_db", "dB",
                "10 log10 of the sum over paths and pairs of ports of |w_rx a w_tx|^2, w the weights of elements, "
                "of unit power; -inf where nothing arrives",
                rows.gain_db);
}

void encode_carriers_head_h5(const Run& run, hdf5::File& file) {
  write_element_root(run, file, "wavetracer carriers");
  write_numbers(file, "/carriers", "the carriers, the first of which is that of paths.h5", "frequency_hz",
                {"Hz", "of the carrier"}, run.config.radio.frequencies_hz);
}

void append_carriers_h5(const Run& run, const FrameResult& frame, FrameTables& tables) {
  const Paths& paths = frame.paths;
  const size_t carriers = run.config.radio.frequencies_hz.size(), ports = size_t{paths.rx_ports} * paths.tx_ports;
  bool whole = frame.carriers.size() + 1 == carriers;
  for (const CarrierFields& fields : frame.carriers)
    whole &= fields.a.size() == paths.size() && fields.gain_db.size() == paths.size() &&
             fields.doppler_hz.size() == paths.size();
  if (!whole) contradicts("carriers", frame.frame);
  std::vector<double> a_re, a_im, gain_db, doppler_hz;
  const auto append_row = [&](size_t row, const auto& a, const auto& gains, const auto& shifts) {
    for (size_t i = 0; i < ports; ++i) {
      a_re.push_back(a[row][i].real());
      a_im.push_back(a[row][i].imag());
    }
    gain_db.push_back(gains[row]);
    doppler_hz.push_back(shifts[row]);
  };
  for (size_t row = 0; row < paths.size(); ++row) {
    append_row(row, paths.a, paths.gain_db, paths.doppler_hz);
    for (const CarrierFields& fields : frame.carriers) append_row(row, fields.a, fields.gain_db, fields.doppler_hz);
  }
  tables.group("/paths", "one row per path, those of paths.h5 in their order");
  append_column(tables, "frame", "1", "number of the frame, see /frames/frame of paths.h5", paths.frame);
  const std::vector<hsize_t> shape{carriers, paths.rx_ports, paths.tx_ports};
  const std::string meaning = " part of a, as in paths.h5, at each carrier; shape (path, carrier, rx port, tx port)";
  tables.append<double>("a_re", {"1", "real" + meaning}, a_re, shape);
  tables.append<double>("a_im", {"1", "imaginary" + meaning}, a_im, shape);
  tables.append<double>("gain_db", {"dB", "as in paths.h5, at each carrier; shape (path, carrier)"}, gain_db,
                        {carriers});
  tables.append<double>("doppler_hz", {"Hz", "as in paths.h5, at each carrier; shape (path, carrier)"}, doppler_hz,
                        {carriers});
}

}  // namespace wavetracer
