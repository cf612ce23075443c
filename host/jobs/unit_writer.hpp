// SPDX-License-Identifier: Apache-2.0
// Writes the units of a run, frame by frame, on a thread of its own, while the next frames are computed.
// HDF5 has one thread: as long as this object exists, only its thread calls it. So the thread has the open unit and the
// merge that is made ahead, and the caller gets them with take_unfinished() and take_ahead(), once it is idle.
#pragma once
#include <deque>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <variant>
#include <vector>
#include "base/guarded.hpp"
#include "base/one_thread.hpp"
#include "jobs/merge_ahead.hpp"
#include "jobs/progress.hpp"
#include "jobs/shards.hpp"

namespace wavetracer {

// A unit is begun, gets its frames, and is ended or dropped, before the next is begun. All functions are for the thread
// that made this object and the shards: on another one they throw std::logic_error.
class UnitWriter {
 public:
  // All arguments must outlive this object.
  UnitWriter(const Run& run, Shards& shards, Progress& progress);
  // Writes what it was given, but errors are lost.
  ~UnitWriter();
  UnitWriter(const UnitWriter&) = delete;
  UnitWriter& operator=(const UnitWriter&) = delete;

  // All functions below throw the exception of the writing thread; it does nothing more after that.

  // From now on, the thread looks for finished units after each that it has written, see MergeAhead::look().
  void follow(std::unique_ptr<MergeAhead> ahead);
  // Makes the thread look for units that other processes have finished.
  void look_ahead();
  // The following frames belong to this unit.
  void begin(const Unit& unit);
  // Waits while frames of more than some megabytes wait to be written.
  void add(FrameResult frame);
  // Returns the last frame that was written since the call before, whose memory can be used again; nothing if there is
  // none.
  std::optional<FrameResult> take_written();
  // Ends the unit. Waits until the one before is on the disk, so that a process that is killed loses two at most.
  void end();
  // Drops the unit that was begun.
  void drop();
  // Waits until everything is written; whole units count as finished then.
  void finish();
  // Does the same, and returns the unit that was begun and neither ended nor dropped, or null.
  std::unique_ptr<OpenUnit> take_unfinished();
  // Does the same, and returns what follow() was given, or null.
  std::unique_ptr<MergeAhead> take_ahead();

 private:
  struct Follow {
    std::unique_ptr<MergeAhead> ahead;
  };
  struct Look {};
  struct Begin {
    Unit unit;
  };
  struct End {};
  struct Drop {};
  struct Quit {};  // the last request
  using Request = std::variant<Follow, Look, Begin, FrameResult, End, Drop, Quit>;

  // The thread tells the caller:
  struct News {
    std::vector<Shard> written;  // units that do not count as finished yet
    std::exception_ptr failure;  // the thread does nothing more once it is set
  };
  // All that passes between the caller and the thread.
  struct Mail {
    std::deque<Request> requests;  // those that are not done yet; the thread works on the first
    size_t frame_bytes = 0;        // the memory of all frames among them
    std::optional<FrameResult> written;
    News news;
  };
  // The things that only one thread may use at a time.
  struct Desk {
    std::unique_ptr<OpenUnit> open;
    std::unique_ptr<MergeAhead> ahead;
  };

  const Run& run_;
  Shards& shards_;
  Progress& progress_;
  OneThread owner_;
  Guarded<Mail> mail_;
  Guarded<Desk> desk_;
  std::thread thread_;  // started when all other members exist, and joined before they go

  static News take_news(Mail& mail);
  void collect(const News& news);
  void request(Request request);

  void work();
  void perform(Request& request);
  void perform(Desk& desk, Follow& request);
  void perform(Desk& desk, Look& request);
  void perform(Desk& desk, Begin& request);
  void perform(Desk& desk, FrameResult& frame);
  void perform(Desk& desk, End& request);
  void perform(Desk& desk, Drop& request);
  void perform(Desk&, Quit&) {}
};

}  // namespace wavetracer
