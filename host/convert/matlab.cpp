// SPDX-License-Identifier: Apache-2.0
// Writes a run as one MATLAB struct of arrays, with the groups and names of paths.h5 and complex coefficients.
// Rows count from 1, as MATLAB's do: tx, rx, instance, first_path and first_vertex can be used as indices.
#include <functional>
#include "base/pending_file.hpp"
#include "convert/convert.hpp"
#include "convert/matlab_file.hpp"
#include "results/saved_responses.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {
namespace {

constexpr const char* conventions =
    "h(f) = sum over paths of a exp(-j 2 pi f delay_s). a is (path, rx port, tx port). "
    "Angles are those of the global frame: theta from +z, phi from +x towards +y. "
    "tx, rx and instance are rows of transmitters, receivers and instances, counted from 1; "
    "instance 0 is the static scene. The vertices of path i are rows first_vertex(i) to first_vertex(i + 1) - 1, "
    "the paths of frame i rows first_path(i) to first_path(i + 1) - 1. interaction: ";

std::string conventions_text() {
  return conventions + interaction_legend() +
         ". surface counts as wavetracer scene info does. Where responses are there, h is (response, frequency), "
         "absolute frequencies; those of link i of them are rows first_response(i) to first_response(i + 1) - 1, "
         "(time, rx antenna, tx antenna), the last of which goes fastest.";
}

// Writes rows x width values in MATLAB's order.
template <typename T, typename Value>
std::vector<T> by_column(size_t rows, size_t width, Value value) {
  std::vector<T> out;
  out.reserve(rows * width);
  for (size_t j = 0; j < width; ++j)
    for (size_t i = 0; i < rows; ++i) out.push_back(value(i, j));
  return out;
}

// Puts the columns of all frames one below the other.
class Columns {
 public:
  Columns(MatlabFile& file, const std::vector<SavedFrame>& frames) : file_(file), frames_(frames) {}

  template <typename T>
  void add(const std::string& path, std::vector<T> Paths::*column, T plus = 0) const {
    std::vector<T> all;
    for (const SavedFrame& frame : frames_)
      for (const T value : frame.paths.*column) all.push_back(static_cast<T>(value + plus));
    file_.add(path, {all.size(), 1}, all);
  }

  // points(frame) returns the vectors of a frame.
  template <typename Points>
  void add_points(const std::string& path, Points points) const {
    std::vector<glm::dvec3> all;
    for (const SavedFrame& frame : frames_) {
      const std::vector<glm::dvec3> part = points(frame);
      all.insert(all.end(), part.begin(), part.end());
    }
    file_.add(path, {all.size(), 3}, by_column<double>(all.size(), 3, [&](size_t i, size_t j) {
                return all[i][static_cast<glm::length_t>(j)];
              }));
  }

 private:
  MatlabFile& file_;
  const std::vector<SavedFrame>& frames_;
};

void add_paths(MatlabFile& file, const std::vector<SavedFrame>& frames, const SavedRun& run) {
  const Columns columns(file, frames);
  file.add_struct("/run/paths");
  columns.add("/run/paths/frame", &Paths::frame);
  columns.add("/run/paths/tx", &Paths::tx, 1u);
  columns.add("/run/paths/rx", &Paths::rx, 1u);
  columns.add("/run/paths/depth", &Paths::depth);
  columns.add("/run/paths/delay_s", &Paths::delay_s);
  columns.add("/run/paths/gain_db", &Paths::gain_db);
  columns.add("/run/paths/aod_theta_rad", &Paths::aod_theta_rad);
  columns.add("/run/paths/aod_phi_rad", &Paths::aod_phi_rad);
  columns.add("/run/paths/aoa_theta_rad", &Paths::aoa_theta_rad);
  columns.add("/run/paths/aoa_phi_rad", &Paths::aoa_phi_rad);
  columns.add("/run/paths/doppler_hz", &Paths::doppler_hz);

  const size_t rx_ports = run.rx_ports(), tx_ports = run.tx_ports();
  std::vector<std::array<std::complex<double>, 4>> a;
  std::vector<double> first_vertex{1};
  for (const SavedFrame& frame : frames) {
    a.insert(a.end(), frame.paths.a.begin(), frame.paths.a.end());
    const double base = first_vertex.back();
    for (size_t i = 1; i < frame.paths.vertex_offset.size(); ++i)
      first_vertex.push_back(base + static_cast<double>(frame.paths.vertex_offset[i]));
  }
  const auto coefficients =
      by_column<std::complex<double>>(a.size(), rx_ports * tx_ports, [&](size_t i, size_t column) {
        return a[i][column % rx_ports * tx_ports + column / rx_ports];  // in a, the tx port varies fastest
      });
  file.add("/run/paths/a", {a.size(), rx_ports, tx_ports}, coefficients);
  file.add("/run/paths/first_vertex", {first_vertex.size(), 1}, first_vertex);

  file.add_struct("/run/vertices");
  columns.add_points("/run/vertices/position_m", [](const SavedFrame& frame) { return frame.paths.vertex_position_m; });
  columns.add("/run/vertices/interaction", &Paths::vertex_interaction);
  columns.add("/run/vertices/surface", &Paths::vertex_surface);
  static_assert(no_instance + 1u == 0);  // so no_instance becomes 0, the scene
  columns.add("/run/vertices/instance", &Paths::vertex_instance, 1u);
}

void add_frames(MatlabFile& file, const std::vector<SavedFrame>& frames) {
  file.add_struct("/run/frames");
  std::vector<uint32_t> number;
  std::vector<double> time_s, first_path{1};
  for (const SavedFrame& frame : frames) {
    number.push_back(frame.number);
    time_s.push_back(frame.time_s);
    first_path.push_back(first_path.back() + static_cast<double>(frame.paths.size()));
  }
  file.add("/run/frames/frame", {number.size(), 1}, number);
  file.add("/run/frames/time_s", {time_s.size(), 1}, time_s);
  file.add("/run/frames/first_path", {first_path.size(), 1}, first_path);
  // The order is (frame, end, coordinate).
  const auto motion = [&](const char* name, std::vector<glm::dvec3> SavedFrame::*member) {
    const size_t ends = (frames.front().*member).size();
    file.add(std::string("/run/frames/") + name, {frames.size(), ends, 3},
             by_column<double>(frames.size(), ends * 3, [&](size_t i, size_t column) {
               return (frames[i].*member)[column % ends][static_cast<glm::length_t>(column / ends)];
             }));
  };
  motion("transmitter_position_m", &SavedFrame::transmitter_position_m);
  motion("transmitter_velocity_m_s", &SavedFrame::transmitter_velocity_m_s);
  motion("receiver_position_m", &SavedFrame::receiver_position_m);
  motion("receiver_velocity_m_s", &SavedFrame::receiver_velocity_m_s);
}

void add_ends(MatlabFile& file, const std::string& path, const std::vector<RadioEnd>& ends) {
  file.add_struct(path);
  const auto texts = [&](const char* name, const auto& member) {
    std::vector<std::string> values;
    for (const RadioEnd& end : ends) values.emplace_back(std::invoke(member, end));
    file.add_texts(path + "/" + name, values);
  };
  const auto triples = [&](const char* name, std::array<double, 3> RadioEnd::*member) {
    file.add(path + "/" + name, {ends.size(), 3},
             by_column<double>(ends.size(), 3, [&](size_t i, size_t j) { return (ends[i].*member)[j]; }));
  };
  texts("name", &RadioEnd::name);
  texts("antenna", &RadioEnd::antenna);
  texts("polarization", [](const RadioEnd& end) { return end.polarization.word(); });
  triples("position_m", &RadioEnd::position_m);
  triples("orientation_deg", &RadioEnd::orientation_deg);
  triples("velocity_m_s", &RadioEnd::velocity_m_s);
}

void add_vehicles(MatlabFile& file, const std::vector<SavedFrame>& frames, const SavedRun& run) {
  file.add_struct("/run/instances");
  const auto texts = [&](const char* name, std::string SavedInstance::*member) {
    std::vector<std::string> values;
    for (const SavedInstance& instance : run.instances()) values.push_back(instance.*member);
    file.add_texts(std::string("/run/instances/") + name, values);
  };
  texts("id", &SavedInstance::id);
  texts("type", &SavedInstance::type);
  texts("model", &SavedInstance::model);

  file.add_struct("/run/poses");
  std::vector<uint32_t> number, instance;
  std::vector<glm::dmat3> rotation;
  for (const SavedFrame& frame : frames)
    for (const SavedPose& pose : frame.poses) {
      number.push_back(frame.number);
      instance.push_back(pose.instance + 1);
      rotation.push_back(pose.rotation);
    }
  const Columns columns(file, frames);
  const auto vectors = [&](const char* name, glm::dvec3 SavedPose::*member) {
    columns.add_points(std::string("/run/poses/") + name, [member](const SavedFrame& frame) {
      std::vector<glm::dvec3> values;
      for (const SavedPose& pose : frame.poses) values.push_back(pose.*member);
      return values;
    });
  };
  file.add("/run/poses/frame", {number.size(), 1}, number);
  file.add("/run/poses/instance", {instance.size(), 1}, instance);
  vectors("position_m", &SavedPose::position_m);
  vectors("velocity_m_s", &SavedPose::velocity_m_s);
  // The order is (pose, row, column): both glm and MATLAB store matrices column by column.
  file.add("/run/poses/rotation", {rotation.size(), 3, 3},
           by_column<double>(rotation.size(), 9, [&](size_t i, size_t k) {
             return rotation[i][static_cast<glm::length_t>(k / 3)][static_cast<glm::length_t>(k % 3)];
           }));
}

void add_links(MatlabFile& file, const std::vector<SavedFrame>& frames) {
  file.add_struct("/run/links");
  std::vector<uint32_t> number, tx, rx;
  for (const SavedFrame& frame : frames)
    for (const Link& link : frame.links) {
      number.push_back(frame.number);
      tx.push_back(link.tx + 1);
      rx.push_back(link.rx + 1);
    }
  file.add("/run/links/frame", {number.size(), 1}, number);
  file.add("/run/links/tx", {tx.size(), 1}, tx);
  file.add("/run/links/rx", {rx.size(), 1}, rx);
}

// h is (response, frequency). The responses of link i of these rows are first_response(i) to first_response(i + 1) - 1,
// one for each time, receiving antenna and transmitting antenna, the last of which varies fastest.
void add_responses(MatlabFile& file, const SavedRun& run, const ExportOptions& options) {
  const std::optional<SavedResponses> saved = saved_responses(run);
  if (!saved) return;
  std::vector<uint32_t> number, tx, rx, tx_antennas, rx_antennas;
  std::vector<double> first_response{1};
  std::vector<std::complex<double>> h;
  const size_t frequencies = saved->frequencies_hz().size();
  for (size_t row = options.first_row; row <= options.last_row; ++row)
    for (const SavedResponse& response : saved->frame(run.number(row))) {
      number.push_back(run.number(row));
      tx.push_back(response.link.tx + 1);
      rx.push_back(response.link.rx + 1);
      tx_antennas.push_back(saved->tx_antennas()[response.link.tx]);
      rx_antennas.push_back(saved->rx_antennas()[response.link.rx]);
      first_response.push_back(first_response.back() + static_cast<double>(response.h.size() / frequencies));
      h.insert(h.end(), response.h.begin(), response.h.end());
    }
  file.add_struct("/run/responses");
  const auto column = [&](const char* name, const auto& values) {
    file.add(std::string("/run/responses/") + name, {values.size(), 1}, values);
  };
  column("frame", number);
  column("tx", tx);
  column("rx", rx);
  column("tx_antennas", tx_antennas);
  column("rx_antennas", rx_antennas);
  column("first_response", first_response);
  column("frequency_hz", saved->frequencies_hz());
  column("time_s", saved->times_s());
  const size_t rows = h.size() / frequencies;
  file.add(
      "/run/responses/h", {rows, frequencies},
      by_column<std::complex<double>>(rows, frequencies, [&](size_t i, size_t k) { return h[i * frequencies + k]; }));
}

}  // namespace

Written export_matlab(const SavedRun& run, const ExportOptions& options, Warnings&) {
  std::vector<SavedFrame> frames;
  for (size_t row = options.first_row; row <= options.last_row; ++row) {
    options.tell(row);
    frames.push_back(run.frame(row));
  }
  MatlabFile file;
  file.add_struct("/run");
  file.add_text("/run/version", run.version());
  file.add_text("/run/device", run.device());
  file.add_text("/run/config", run.config_text());
  file.add_text("/run/conventions", conventions_text());
  const double frequency_hz = run.frequency_hz();
  file.add("/run/frequency_hz", {1, 1}, std::span(&frequency_hz, 1));
  add_frames(file, frames);
  add_paths(file, frames, run);
  add_ends(file, "/run/transmitters", run.transmitters());
  add_ends(file, "/run/receivers", run.receivers());
  add_vehicles(file, frames, run);
  add_links(file, frames);
  add_responses(file, run, options);
  PendingFile out(options.output, file.image("written by wavetracer " + run.version() + ", HDF5 schema 1.00 ."));
  out.commit();
  return {options.output};
}

}  // namespace wavetracer
