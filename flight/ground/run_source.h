#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

#include "flight/ground/publisher.h"
#include "flight/viewers/run.h"

namespace saker::flight::ground {

/// A finished run that is played, for the hub: services `play` and `seek`, the protocol's playback
/// control, `/playback`. It stands at its end at first, where all of it is shown. One thread steps.
class RunSource {
 public:
  /// \param run, hub  outlive this
  RunSource(viewers::Run& run, const viewers::Site& site, Hub& hub);

  /// Registers the services; before clients come.
  void offer();

  /// Does what was asked, plays on by `passed_s` of wall time, says what is due.
  void step(double passed_s);

  struct State {
    bool playing = false;
    double speed = 1, t_s = 0, begin_s = 0, end_s = 0;
  };
  [[nodiscard]] State state() const;
  [[nodiscard]] Json state_json() const;

 private:
  struct Wish {
    std::optional<bool> playing;
    std::optional<double> speed, seek;
    Hub::Reply reply;     ///< may be empty
    std::string request;  ///< of the protocol's playback control
  };
  static constexpr std::size_t kMostWishes = 64;

  void ask(Wish wish);
  void ask_play(const Json& request, Hub::Reply reply);
  void ask_seek(const Json& request, Hub::Reply reply);
  void fulfil(const Wish& wish);
  void jump(double t);
  void say(bool jumped, const std::string& request);

  viewers::Run& run_;
  viewers::RobotViews views_;
  Hub& hub_;
  Publisher publisher_;
  std::uint64_t channel_ = 0;
  mutable std::mutex mutex_;  ///< of what follows
  State state_;
  std::vector<Wish> wishes_;
  double since_said_s_ = 0;
  bool said_ended_ = false;
};

}  // namespace saker::flight::ground
