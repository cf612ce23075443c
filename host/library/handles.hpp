// SPDX-License-Identifier: Apache-2.0
// Defines the opaque types of wavetracer.h, and the one place where exceptions become errors.
// wavetracer_run_frame fills a frame once; after that it is only read.
#pragma once
#include <sys/types.h>

#include <atomic>
#include <complex>
#include <cstdint>
#include <glm/vec3.hpp>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <vector>
#include "wavetracer/error.hpp"
#include "wavetracer/simulation.hpp"
#include "wavetracer/wavetracer.h"

struct wavetracer_error {
  int code;
  std::string message;
};

struct wavetracer_simulation {
  wavetracer::Simulation simulation;
  std::string warnings;
  uint64_t number;  // number in this process, so that frames know their simulation
  pid_t process;    // the process that opened it

  // The mutex of the current user (Turn).
  mutable std::mutex turn = {};
  mutable std::atomic<std::thread::id> user = {};

  // Guards the observer: it may change while a frame is solved, and may change itself.
  std::mutex watching = {};
  wavetracer_observer observer = nullptr;
  void* observer_user = nullptr;
  std::atomic<bool> forgets = false;  // before the next frame
};

namespace wavetracer::c_api {

// Figures of links (radio/links.hpp), a row per link.
struct LinkColumns {
  std::vector<uint32_t> paths;
  std::vector<uint8_t> los;
  std::vector<double> path_gain_db, sum_of_powers_db, narrowband_gain_db, mean_delay_s, rms_delay_spread_s,
      doppler_spread_hz, missed_power_share;
};

// Fields at every carrier, one row per path; empty where there is only one.
struct CarrierColumns {
  size_t carriers = 0;
  std::vector<std::complex<double>> a;  // packed: only ports that exist
  std::vector<double> gain_db, doppler_hz;
};

// Detections of radars: a row for each link of each radar, and the detections of all rows one after the other.
struct RadarColumns {
  std::vector<uint32_t> radar, tx, rx, left_out;
  std::vector<uint64_t> detection_offset;
  RadarDetections detections;
  std::vector<uint32_t> place;  // number of the row among those of its radar
  std::vector<RadarAxes> axes;  // one for each radar
};

// Defined in radar_api.cpp.
RadarColumns radar_columns(const FrameResult& frame, std::vector<RadarAxes> axes);

}  // namespace wavetracer::c_api

struct wavetracer_frame {
  uint64_t owner;  // wavetracer_simulation::number
  wavetracer::FrameResult result;
  std::string warnings;
  std::vector<std::complex<double>> a;                                  // packed: only ports that exist
  std::vector<glm::dvec3> transmitter_position_m, receiver_position_m;  // file coordinates
  wavetracer::c_api::LinkColumns links;
  wavetracer::c_api::CarrierColumns carriers;
  wavetracer::c_api::RadarColumns radars;
};

namespace wavetracer::c_api {

// Stores an error, unless error is null.
void report(::wavetracer_error** error, ExitCode code, const char* message) noexcept;
void report_out_of_memory(::wavetracer_error** error) noexcept;

// Returns the result of body; if it throws, stores an error and returns `failed`.
template <class Body, class Result>
Result guarded(::wavetracer_error** error, Result failed, const Body& body) noexcept {
  if (error) *error = nullptr;
  try {
    return body();
  } catch (const Error& e) {
    report(error, e.code(), e.what());
  } catch (const FrameStopped& e) {
    report(error, ExitCode::interrupted, e.what());
  } catch (const std::bad_alloc&) {
    report_out_of_memory(error);
  } catch (const std::exception& e) {
    report(error, ExitCode::runtime, e.what());
  } catch (...) {
    report(error, ExitCode::runtime, "unknown exception");
  }
  return failed;
}

// Throws RuntimeError in a process that was forked from one that has used OpenCL: the threads of its drivers do not
// exist there, and would be waited for without end. It must be called before each use of a device.
void check_process(const char* function);

// The use of a simulation by one thread, as long as this object exists; other threads wait. Throws as check_process()
// does, and ConfigError if this thread uses the simulation already, as an observer does.
class Turn {
 public:
  Turn(const wavetracer_simulation& self, const char* function);
  ~Turn();
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  const wavetracer_simulation& self_;
};

// Waits for the current user, then ends the simulation. Does nothing in a forked process, or if an observer of the
// simulation calls it.
void close_simulation(wavetracer_simulation* self) noexcept;

// Throws ConfigError if a required pointer is null.
template <class T>
T& needed(T* pointer, const char* function, const char* argument) {
  if (!pointer) throw ConfigError(std::string(function) + ": " + argument + " is null");
  return *pointer;
}

// Throws ConfigError if the frame is of another simulation.
inline void check_owner(const char* function, const wavetracer_simulation& self, const wavetracer_frame& frame) {
  if (frame.owner != self.number) throw ConfigError(std::string(function) + ": the frame is of another simulation");
}

// Throws ConfigError if the frame has no path of this row.
inline void check_row(const char* function, const wavetracer_frame& frame, size_t row) {
  if (row >= frame.result.paths.size())
    throw ConfigError(std::string(function) + ": there is no path " + std::to_string(row) + ", only " +
                      std::to_string(frame.result.paths.size()) + " counted from 0");
}

}  // namespace wavetracer::c_api
