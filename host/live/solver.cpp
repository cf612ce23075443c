// SPDX-License-Identifier: Apache-2.0
// Errors of poses are the client's, other errors cost the frame, and errors of the device end the server.
#include "live/solver.hpp"

#include <fmt/format.h>

#include "live/answer.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::live {
namespace {

// Throws AnswerError if the cubes of an answer would be longer than a client may leave unread.
void check_cubes(const Simulation& simulation, const FrameResult& frame, Encoding encoding) {
  // The bytes of a complex value: two float64, or two numbers of up to 23 characters with their commas.
  const bool columns = encoding == Encoding::cbor;
  const uint64_t cells = simulation.radar_cells(frame), bytes = cells * (columns ? 16 : 48),
                 most = simulation.config().live.max_queue_bytes;
  if (bytes > most)
    throw AnswerError(
        "too_large",
        fmt::format("the cubes of this answer have {} cells, {} bytes {}, more than live.max_queue_bytes = {}: ask for "
                    "\"detections\"{}, or let the configuration have fewer links of radars, a smaller radar.chirps or "
                    "radar.samples, or a larger live.max_queue_bytes",
                    cells, bytes, columns ? "as columns" : "as JSON", most,
                    columns ? "" : ", or take the encoding \"cbor\", which has a third of these bytes"));
}

std::vector<RadarRows> radars_of(const Simulation& simulation, const LiveFrame& frame, const Job& job) {
  if (job.radar == RadarDetail::none) return {};
  const bool cubes = job.radar == RadarDetail::cubes;
  if (cubes) check_cubes(simulation, frame.result, job.encoding);
  return simulation.radars(frame.result, cubes);
}

}  // namespace

Solve solve_with(Simulation& simulation, FrameSolved solved) {
  return [&simulation, solved = std::move(solved), axes = simulation.radar_axes()](const Job& job, bool afresh) {
    const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
    const FrameMessage& message = job.message;
    const Clock::time_point start = Clock::now();
    if (message.cold || afresh) simulation.forget();
    LiveFrame frame = message.between ? simulation.run_between(*job.traffic, message.time_s)
                                      : simulation.run_poses(*job.traffic, message.time_s, message.vehicles);
    if (solved) solved(simulation, frame);
    const std::vector<RadarRows> heard = radars_of(simulation, frame, job);
    const FrameTimes times{seconds(start - job.received), seconds(Clock::now() - start)};
    const RadarAnswer radars{simulation.config(), axes, heard, job.radar == RadarDetail::cubes};
    std::string line = channels_line(message, frame, {job.detail, job.encoding}, job.skipped, times, radars);
    simulation.give_back(frame.result);
    return line;
  };
}

Solver::Solver(Solve solve) : solve_(std::move(solve)), worker_([this](Job& job) { return answer(job); }) {}

void Solver::give(Job job) {
  busy_ = true;
  worker_.give(std::move(job));
}

std::optional<Answer> Solver::take() {
  std::optional<Answer> out = worker_.take();
  if (out) busy_ = false;
  return out;
}

Answer Solver::answer(const Job& job) {
  const uint64_t frame = job.message.frame;
  try {
    std::string line = solve_(job, afresh_);
    afresh_ = false;
    return {job.client, std::move(line), {}, false};
  } catch (const PoseError& e) {
    return {job.client, error_line(e.code, e.what(), frame, false), {}, false, job.skipped};
  } catch (const AnswerError& e) {
    afresh_ = false;
    return {job.client, error_line(e.code, e.what(), frame, false), {}, false, job.skipped};
  } catch (const DeviceError& e) {
    return {job.client, error_line("server", e.what(), frame, true), e.what(), true};
  } catch (const std::exception& e) {
    afresh_ = true;
    const std::string text =
        fmt::format("this frame could not be computed: {}; the next frame reuses nothing", e.what());
    return {job.client, error_line("failed", text, frame, false), text, false, job.skipped};
  }
}

}  // namespace wavetracer::live
