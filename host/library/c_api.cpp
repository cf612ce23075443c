// SPDX-License-Identifier: Apache-2.0
// The functions of wavetracer.h, except for the columns: they are thin, and no exception leaves them.
// The caller must follow the header: no object is used after it was given back.
#include <unistd.h>
#include <atomic>
#include <filesystem>
#include <limits>
#include <memory>
#include "gpu/gpu.hpp"
#include "library/handles.hpp"
#include "radio/carriers.hpp"
#include "radio/links.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer::c_api {
namespace {

std::atomic<uint64_t> opened{0};

// An error that needs no memory to be made.
::wavetracer_error* out_of_memory() {
  static ::wavetracer_error error{WAVETRACER_RUNTIME,
                                  "out of memory: lower trace.batch_rays or trace.rays, or use a smaller scene"};
  return &error;
}

std::string lines(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : "\n") + text;
  return out;
}

std::vector<glm::dvec3> file_positions(const std::vector<EndState>& ends, const glm::dvec3& origin_m) {
  std::vector<glm::dvec3> out;
  for (const EndState& end : ends)
    out.push_back(end.present ? origin_m + end.position_m : glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
  return out;
}

std::vector<std::complex<double>> packed(const Paths& paths) {
  const size_t ports = size_t{paths.rx_ports} * paths.tx_ports;
  std::vector<std::complex<double>> out;
  out.reserve(paths.size() * ports);
  for (const auto& a : paths.a) out.insert(out.end(), a.begin(), a.begin() + static_cast<std::ptrdiff_t>(ports));
  return out;
}

LinkColumns link_columns(const FrameResult& frame, double frequency_hz) {
  LinkColumns out;
  for (const LinkFigures& link : link_figures(frame.paths, frame.frame, frame.world.links, frequency_hz)) {
    out.paths.push_back(link.paths);
    out.los.push_back(link.los);
    out.path_gain_db.push_back(link.path_gain_db);
    out.sum_of_powers_db.push_back(link.sum_of_powers_db);
    out.narrowband_gain_db.push_back(link.narrowband_gain_db);
    out.mean_delay_s.push_back(link.mean_delay_s);
    out.rms_delay_spread_s.push_back(link.rms_delay_spread_s);
    out.doppler_spread_hz.push_back(link.doppler_spread_hz);
    out.missed_power_share.push_back(link.missed_power_share);
  }
  return out;
}

std::string device_lines() {
  std::vector<std::string> out;
  for (const wavetracer::gpu::DeviceInfo& device : wavetracer::gpu::list_devices())
    out.push_back(device.name + "\t" + device.platform + "\t" + (device.gpu ? "GPU" : device.cpu ? "CPU" : "other"));
  return lines(out);
}

CarrierColumns carrier_columns(const FrameResult& frame) {
  CarrierColumns out;
  if (frame.carriers.empty()) return out;
  const Paths& paths = frame.paths;
  const auto ports = static_cast<std::ptrdiff_t>(size_t{paths.rx_ports} * paths.tx_ports);
  out.carriers = 1 + frame.carriers.size();
  const auto append = [&](size_t row, const auto& fields) {
    out.a.insert(out.a.end(), fields.a[row].begin(), fields.a[row].begin() + ports);
    out.gain_db.push_back(fields.gain_db[row]);
    out.doppler_hz.push_back(fields.doppler_hz[row]);
  };
  for (size_t row = 0; row < paths.size(); ++row) {
    append(row, paths);
    for (const CarrierFields& fields : frame.carriers) append(row, fields);
  }
  return out;
}

// Calls the current observer, and returns whether to continue.
bool observed(wavetracer_simulation& self, const FrameProgress& progress) {
  wavetracer_observer observer = nullptr;
  void* user = nullptr;
  {
    const std::lock_guard lock(self.watching);
    observer = self.observer;
    user = self.observer_user;
  }
  return !observer || observer(user, progress.stage.word().data(), progress.done, progress.total) != 0;
}

const char* name_of(const std::vector<RadioEnd>& ends, size_t index) {
  return index < ends.size() ? ends[index].name.c_str() : nullptr;
}

}  // namespace

void report(::wavetracer_error** error, ExitCode code, const char* message) noexcept {
  if (!error) return;
  try {
    *error = new ::wavetracer_error{static_cast<int>(code), message};
  } catch (const std::bad_alloc&) {
    *error = out_of_memory();
  }
}

void report_out_of_memory(::wavetracer_error** error) noexcept {
  if (error) *error = out_of_memory();
}

}  // namespace wavetracer::c_api

using namespace wavetracer::c_api;
using wavetracer::ConfigError;

extern "C" {

int wavetracer_error_code(const wavetracer_error* error) { return error ? error->code : WAVETRACER_OK; }
const char* wavetracer_error_message(const wavetracer_error* error) { return error ? error->message.c_str() : ""; }
void wavetracer_error_free(wavetracer_error* error) {
  if (error != out_of_memory()) delete error;
}

const char* wavetracer_version(void) { return WAVETRACER_VERSION; }

const char* wavetracer_devices(wavetracer_error** error) {
  thread_local std::string listed;
  return guarded(error, static_cast<const char*>(nullptr), [&] {
    check_process("wavetracer_devices");
    listed = device_lines();
    return listed.c_str();
  });
}

wavetracer_simulation* wavetracer_open(const char* config, const char* folder, const char* const* sets,
                                       size_t set_count, const char* device, wavetracer_error** error) {
  return guarded(error, static_cast<wavetracer_simulation*>(nullptr), [&] {
    const char* const here = "wavetracer_open";
    check_process(here);
    std::vector<std::string> texts;
    for (size_t i = 0; i < set_count; ++i)
      texts.emplace_back(&needed((&needed(sets, here, "sets"))[i], here, "one of sets"));
    const std::string file = (std::filesystem::path(folder ? folder : "") / "config").string();
    wavetracer::Simulation simulation(wavetracer::parse_config(&needed(config, here, "config"), file, texts),
                                      device ? device : "");
    std::string warnings = lines(simulation.warnings());
    auto* const out = new wavetracer_simulation{std::move(simulation), std::move(warnings), ++opened, getpid()};
    out->simulation.observe([out](const wavetracer::FrameProgress& progress) { return observed(*out, progress); });
    return out;
  });
}

void wavetracer_close(wavetracer_simulation* self) { close_simulation(self); }

uint32_t wavetracer_frame_count(const wavetracer_simulation* self) {
  return self ? static_cast<uint32_t>(self->simulation.frame_count()) : 0;
}
double wavetracer_time_s(const wavetracer_simulation* self, uint32_t frame) {
  return frame < wavetracer_frame_count(self) ? self->simulation.time_s(frame)
                                              : std::numeric_limits<double>::quiet_NaN();
}
size_t wavetracer_transmitter_count(const wavetracer_simulation* self) {
  return self ? self->simulation.config().transmitters.size() : 0;
}
size_t wavetracer_receiver_count(const wavetracer_simulation* self) {
  return self ? self->simulation.config().receivers.size() : 0;
}
const char* wavetracer_transmitter_name(const wavetracer_simulation* self, size_t index) {
  return self ? name_of(self->simulation.config().transmitters, index) : nullptr;
}
const char* wavetracer_receiver_name(const wavetracer_simulation* self, size_t index) {
  return self ? name_of(self->simulation.config().receivers, index) : nullptr;
}
size_t wavetracer_carrier_count(const wavetracer_simulation* self) {
  return self ? carriers_hz(self->simulation.config().radio).size() : 0;
}
double wavetracer_carrier_hz(const wavetracer_simulation* self, size_t index) {
  return index < wavetracer_carrier_count(self) ? carriers_hz(self->simulation.config().radio)[index]
                                                : std::numeric_limits<double>::quiet_NaN();
}
const char* wavetracer_device_name(const wavetracer_simulation* self) {
  return self ? self->simulation.device().name.c_str() : nullptr;
}
const char* wavetracer_config_text(const wavetracer_simulation* self) {
  return self ? self->simulation.config().text.c_str() : nullptr;
}
const char* wavetracer_warnings(const wavetracer_simulation* self) { return self ? self->warnings.c_str() : nullptr; }

wavetracer_frame* wavetracer_run_frame(wavetracer_simulation* self, uint32_t frame, wavetracer_error** error) {
  return guarded(error, static_cast<wavetracer_frame*>(nullptr), [&] {
    wavetracer::Simulation& simulation = needed(self, "wavetracer_run_frame", "self").simulation;
    const Turn turn(*self, "wavetracer_run_frame");
    if (frame >= simulation.frame_count())
      throw ConfigError("wavetracer_run_frame: there is no frame " + std::to_string(frame) + ", only " +
                        std::to_string(simulation.frame_count()) + " counted from 0");
    if (self->forgets.exchange(false)) simulation.forget();
    auto out = std::make_unique<wavetracer_frame>();
    out->owner = self->number;
    out->result = simulation.run_frame(frame);
    out->warnings = lines(out->result.warnings);
    out->a = packed(out->result.paths);
    out->links = link_columns(out->result, simulation.config().radio.frequency_hz);
    out->carriers = carrier_columns(out->result);
    out->radars = radar_columns(out->result, simulation.radar_axes());
    out->transmitter_position_m = file_positions(out->result.world.transmitters, simulation.scene().origin_m);
    out->receiver_position_m = file_positions(out->result.world.receivers, simulation.scene().origin_m);
    return out.release();
  });
}

void wavetracer_observe(wavetracer_simulation* self, wavetracer_observer observer, void* user) {
  if (!self) return;
  const std::lock_guard lock(self->watching);
  self->observer = observer;
  self->observer_user = user;
}

void wavetracer_frame_free(wavetracer_frame* self) { delete self; }

void wavetracer_forget(wavetracer_simulation* self) {
  if (self) self->forgets = true;
}

uint32_t wavetracer_frame_number(const wavetracer_frame* self) { return self ? self->result.frame : 0; }
double wavetracer_frame_time_s(const wavetracer_frame* self) {
  return self ? self->result.world.time_s : std::numeric_limits<double>::quiet_NaN();
}
uint32_t wavetracer_frame_rx_ports(const wavetracer_frame* self) { return self ? self->result.paths.rx_ports : 0; }
uint32_t wavetracer_frame_tx_ports(const wavetracer_frame* self) { return self ? self->result.paths.tx_ports : 0; }

wavetracer_counts wavetracer_frame_counts(const wavetracer_frame* self) {
  if (!self) return {};
  const wavetracer::FrameCounts& n = self->result.counts;
  return {n.rays, n.segments, n.hits, n.sequences, n.candidates, n.solved, n.paths};
}

wavetracer_missed wavetracer_frame_missed(const wavetracer_frame* self) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!self || self->result.missed.frames == 0) return {unknown, unknown, unknown, unknown, unknown, unknown};
  const wavetracer::Missed missed = estimate_missed(self->result.missed);
  return {missed.paths.estimate,       missed.paths.low,       missed.paths.high,
          missed.power_share.estimate, missed.power_share.low, missed.power_share.high};
}

wavetracer_certificate wavetracer_frame_certificate(const wavetracer_frame* self) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (!self || self->result.certificate.frames == 0) return {0, 0, unknown, unknown, unknown, unknown, unknown, 0};
  const wavetracer::Certificate& of = self->result.certificate;
  return {of.depth,          of.any_depth,
          of.left_out_sr,    of.left_out_share(),
          of.left_out_power, of.floor_db.value_or(-std::numeric_limits<double>::infinity()),
          of.weak_share(),   of.edges};
}

const char* wavetracer_frame_warnings(const wavetracer_frame* self) { return self ? self->warnings.c_str() : nullptr; }

int wavetracer_write(const wavetracer_simulation* self, const char* folder, const wavetracer_frame* const* frames,
                     size_t count, wavetracer_error** error) {
  return guarded(error, 0, [&] {
    const char* const here = "wavetracer_write";
    needed(self, here, "self");
    needed(folder, here, "folder");
    static std::mutex writing;  // HDF5 has one thread
    const Turn turn(*self, here);
    const std::lock_guard lock(writing);
    if (count == 0) throw ConfigError("wavetracer_write: no frames are given");
    std::vector<wavetracer::FrameResult> results;
    for (size_t i = 0; i < count; ++i) {
      const wavetracer_frame& frame = needed((&needed(frames, here, "frames"))[i], here, "one of frames");
      if (frame.owner != self->number)
        throw ConfigError("wavetracer_write: frame " + std::to_string(frame.result.frame) +
                          " is of another simulation");
      if (!results.empty() && frame.result.frame <= results.back().frame)
        throw ConfigError("wavetracer_write: frames must be sorted by their number, each once");
      results.push_back(frame.result);
    }
    wavetracer::write_outputs(folder, wavetracer::make_run(self->simulation, count), results);
    return 1;
  });
}

}  // extern "C"
