// SPDX-License-Identifier: Apache-2.0
// Writes arrays in the layout of Sionna RT's Paths with synthetic arrays: ports are antennas; delays and angles belong
// to a link. `a` means the same there, a passband coefficient without the carrier phase of the delay, so no phase is
// added.
#include <fmt/format.h>
#include <algorithm>
#include "base/pending_file.hpp"
#include "convert/convert.hpp"
#include "convert/npz.hpp"
#include "convert/response_arrays.hpp"
#include "radio/link_groups.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr uint32_t invalid_id = 0xFFFFFFFFu;

struct Frame {
  SavedFrame saved;
  std::vector<size_t> slot;  // slot of each path in an array (frame, rx, tx, path)
};

// Sizes of the axes. A single frame has no frame axis: its arrays are exactly those of Sionna.
struct Axes {
  size_t frames = 0, rx = 0, tx = 0, rx_ports = 1, tx_ports = 1, paths = 0, depth = 0;

  Npz::Shape with_frames(const Npz::Shape& inner) const {
    Npz::Shape shape;
    if (frames > 1) shape.push_back(frames);
    for (const size_t size : inner) shape.push_back(size);
    return shape;
  }
  Npz::Shape link() const { return with_frames({rx, tx, paths}); }
  size_t slots() const { return frames * rx * tx * paths; }
  // Values per slot: a_real and a_imag; tau, four angles, doppler; valid; for each interaction three numbers and a
  // position.
  double bytes() const {
    const double slot = 16.0 * static_cast<double>(rx_ports * tx_ports) + 6 * 8 + 1 + 36.0 * static_cast<double>(depth);
    return slot * static_cast<double>(frames) * static_cast<double>(rx) * static_cast<double>(tx) *
           static_cast<double>(paths);
  }
};

std::vector<Frame> read_frames(const SavedRun& run, const ExportOptions& options, Axes& axes) {
  axes = {.rx = run.receivers().size(),
          .tx = run.transmitters().size(),
          .rx_ports = run.rx_ports(),
          .tx_ports = run.tx_ports()};
  std::vector<Frame> frames;
  for (size_t row = options.first_row; row <= options.last_row; ++row) {
    options.tell(row);
    Frame& frame = frames.emplace_back(run.frame(row), std::vector<size_t>{});
    for (const uint32_t depth : frame.saved.paths.depth) axes.depth = std::max<size_t>(axes.depth, depth);
    LinkGroups groups = group_by_link(frame.saved.paths.tx, frame.saved.paths.rx);
    for (size_t g = 0; g < groups.size(); ++g) axes.paths = std::max(axes.paths, groups.rows(g).size());
  }
  axes.frames = frames.size();
  return frames;
}

void check_size(const Axes& axes) {
  if (axes.bytes() > static_cast<double>(npz_limit_bytes))
    throw InputError(fmt::format(
        "sionna: {} frames x {} receivers x {} transmitters, padded to {} paths and {} interactions, take {:.3g} GB, "
        "and more than {:.3g} are not written; choose fewer frames with --frames",
        axes.frames, axes.rx, axes.tx, axes.paths, axes.depth, axes.bytes() / 1e9,
        static_cast<double>(npz_limit_bytes) / 1e9));
}

void place_paths(std::vector<Frame>& frames, const Axes& axes) {
  for (size_t f = 0; f < frames.size(); ++f) {
    const Paths& paths = frames[f].saved.paths;
    frames[f].slot.resize(paths.size());
    LinkGroups groups = group_by_link(paths.tx, paths.rx);
    for (size_t g = 0; g < groups.size(); ++g) {
      const std::span<uint32_t> rows = groups.rows(g);
      const size_t link = (f * axes.rx + paths.rx[rows[0]]) * axes.tx + paths.tx[rows[0]];
      for (size_t k = 0; k < rows.size(); ++k) frames[f].slot[rows[k]] = link * axes.paths + k;
    }
  }
}

// Makes (frame, rx, tx, path): value(paths, row), or `padding` where there is no path.
template <typename T, typename Value>
std::vector<T> per_path(const std::vector<Frame>& frames, const Axes& axes, T padding, Value value) {
  std::vector<T> out(axes.slots(), padding);
  for (const Frame& frame : frames)
    for (size_t row = 0; row < frame.slot.size(); ++row) out[frame.slot[row]] = value(frame.saved.paths, row);
  return out;
}

// Makes (frame, rx, rx port, tx, tx port, path): the real or the imaginary part of the coefficients.
std::vector<double> coefficients(const std::vector<Frame>& frames, const Axes& axes,
                                 double (*part)(const std::complex<double>&)) {
  std::vector<double> out(axes.slots() * axes.rx_ports * axes.tx_ports);
  for (const Frame& frame : frames)
    for (size_t row = 0; row < frame.slot.size(); ++row) {
      const size_t path = frame.slot[row] % axes.paths, link = frame.slot[row] / axes.paths;
      const size_t tx = link % axes.tx, rx_and_frame = link / axes.tx;
      for (size_t i = 0; i < axes.rx_ports; ++i)
        for (size_t j = 0; j < axes.tx_ports; ++j)
          out[(((rx_and_frame * axes.rx_ports + i) * axes.tx + tx) * axes.tx_ports + j) * axes.paths + path] =
              part(frame.saved.paths.a[row][i * axes.tx_ports + j]);
    }
  return out;
}

// Makes (frame, interaction, rx, tx, path, width): put(paths, vertex, cell) fills the `width` values of one
// interaction.
template <typename T, typename Put>
std::vector<T> per_interaction(const std::vector<Frame>& frames, const Axes& axes, size_t width, T padding, Put put) {
  const size_t slots = axes.rx * axes.tx * axes.paths;  // slots of one frame
  std::vector<T> out(axes.slots() * axes.depth * width, padding);
  for (size_t f = 0; f < frames.size(); ++f) {
    const Paths& paths = frames[f].saved.paths;
    for (size_t row = 0; row < paths.size(); ++row)
      for (size_t d = 0; d < paths.depth[row]; ++d) {
        const size_t cell = (f * axes.depth + d) * slots + frames[f].slot[row] % slots;
        put(paths, paths.vertex_offset[row] + d, &out[cell * width]);
      }
  }
  return out;
}

void add_paths(Npz& npz, const std::vector<Frame>& frames, const Axes& axes) {
  const auto column = [&](const char* name, double padding, std::vector<double> Paths::*member) {
    npz.add(name, axes.link(),
            per_path(frames, axes, padding, [&](const Paths& paths, size_t row) { return (paths.*member)[row]; }));
  };
  const Npz::Shape ports = axes.with_frames({axes.rx, axes.rx_ports, axes.tx, axes.tx_ports, axes.paths});
  npz.add("a_real", ports, coefficients(frames, axes, [](const auto& z) { return z.real(); }));
  npz.add("a_imag", ports, coefficients(frames, axes, [](const auto& z) { return z.imag(); }));
  column("tau", -1, &Paths::delay_s);
  column("theta_t", 0, &Paths::aod_theta_rad);
  column("phi_t", 0, &Paths::aod_phi_rad);
  column("theta_r", 0, &Paths::aoa_theta_rad);
  column("phi_r", 0, &Paths::aoa_phi_rad);
  column("doppler", 0, &Paths::doppler_hz);
  npz.add_flags("valid", axes.link(),
                per_path(frames, axes, uint8_t{0}, [](const Paths&, size_t) { return uint8_t{1}; }));
}

// Kinds have Sionna's numbers. Objects: 0 is the scene, n + 1 is the vehicle of row n. Primitives are surfaces or
// edges.
void add_interactions(Npz& npz, const std::vector<Frame>& frames, const Axes& axes) {
  const Npz::Shape shape = axes.with_frames({axes.depth, axes.rx, axes.tx, axes.paths});
  const auto numbers = [&](const char* name, uint32_t padding, auto value) {
    npz.add(name, shape,
            per_interaction(frames, axes, 1, padding,
                            [&](const Paths& paths, size_t vertex, uint32_t* out) { *out = value(paths, vertex); }));
  };
  numbers("interactions", 0, [](const Paths& paths, size_t v) { return uint32_t{paths.vertex_interaction[v]}; });
  numbers("objects", invalid_id, [](const Paths& paths, size_t v) {
    return paths.vertex_instance[v] == no_instance ? 0 : paths.vertex_instance[v] + 1;
  });
  numbers("primitives", invalid_id, [](const Paths& paths, size_t v) { return paths.vertex_surface[v]; });
  Npz::Shape positions = shape;
  positions.push_back(3);
  npz.add("vertices", positions,
          per_interaction(frames, axes, 3, 0.0, [](const Paths& paths, size_t vertex, double* out) {
            for (int i = 0; i < 3; ++i) out[i] = paths.vertex_position_m[vertex][i];
          }));
}

void add_ends(Npz& npz, const SavedRun& run, const std::vector<Frame>& frames, const Axes& axes) {
  // The order is (frame, coordinate, end), as arrays made of Sionna's Point3f have it.
  const auto points = [&](const char* name, size_t ends, std::vector<glm::dvec3> SavedFrame::*member) {
    std::vector<double> values;
    for (const Frame& frame : frames)
      for (int i = 0; i < 3; ++i)
        for (const glm::dvec3& point : frame.saved.*member) values.push_back(point[i]);
    npz.add(name, axes.with_frames({3, ends}), values);
  };
  points("sources", axes.tx, &SavedFrame::transmitter_position_m);
  points("targets", axes.rx, &SavedFrame::receiver_position_m);
  points("tx_velocities", axes.tx, &SavedFrame::transmitter_velocity_m_s);
  points("rx_velocities", axes.rx, &SavedFrame::receiver_velocity_m_s);
  // A link that was not computed has no paths either; this array distinguishes the two.
  std::vector<uint8_t> linked(axes.frames * axes.rx * axes.tx);
  for (size_t f = 0; f < frames.size(); ++f)
    for (const Link& link : frames[f].saved.links) linked[(f * axes.rx + link.rx) * axes.tx + link.tx] = 1;
  npz.add_flags("linked", axes.with_frames({axes.rx, axes.tx}), linked);
  const auto names = [](const std::vector<RadioEnd>& ends) {
    std::vector<std::string> out;
    for (const RadioEnd& end : ends) out.push_back(end.name);
    return out;
  };
  npz.add_texts("tx_names", names(run.transmitters()));
  npz.add_texts("rx_names", names(run.receivers()));
  std::vector<std::string> objects{"scene"};
  for (const SavedInstance& instance : run.instances()) objects.push_back(instance.id);
  npz.add_texts("object_names", objects);
}

// Responses are in the order of Paths.cfr(): (rx, rx antenna, tx, tx antenna, time, frequency).
void add_responses(Npz& npz, const ResponseArray& responses, const Axes& axes) {
  const Npz::Shape shape = axes.with_frames({responses.rx, responses.rx_antennas, responses.tx, responses.tx_antennas,
                                             responses.times, responses.frequencies});
  npz.add("h_real", shape, responses.re);
  npz.add("h_imag", shape, responses.im);
  npz.add("h_frequency_hz", {responses.frequencies}, responses.frequencies_hz);
  npz.add("h_time_s", {responses.times}, responses.times_s);
}

}  // namespace

Written export_sionna(const SavedRun& run, const ExportOptions& options, Warnings& warnings) {
  Axes axes;
  std::vector<Frame> frames = read_frames(run, options, axes);
  check_size(axes);
  place_paths(frames, axes);

  PendingFile file(options.output);
  Npz npz([&file](std::span<const std::byte> bytes) { file.write(bytes); });
  add_paths(npz, frames, axes);
  add_interactions(npz, frames, axes);
  add_ends(npz, run, frames, axes);
  npz.add_number("frequency", run.frequency_hz());
  std::vector<uint32_t> numbers;
  std::vector<double> times_s;
  for (const Frame& frame : frames) {
    numbers.push_back(frame.saved.number);
    times_s.push_back(frame.saved.time_s);
  }
  npz.add("frame", {numbers.size()}, numbers);
  npz.add("time_s", {times_s.size()}, times_s);
  if (const auto responses = response_array(run, options, "sionna")) add_responses(npz, *responses, axes);
  npz.finish();
  file.sync();
  file.commit();
  if (!run.instances().empty())
    warnings.push_back("sionna: poses and shapes of vehicles have no place in Paths; `objects` names what was hit");
  return {options.output};
}

}  // namespace wavetracer
