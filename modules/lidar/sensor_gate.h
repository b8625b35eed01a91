#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saker/lidar/column_count.h"
#include "saker/lidar/gate_cause.h"
#include "saker/lidar/sensor_candidates.h"
#include "saker/lidar/sensor_reading.h"
#include "saker/lidar/stamp_line.h"
#include "saker/lidar/udp_source.h"
#include "saker/lidar/waiting_packets.h"

/// Which live packets are believed — reads payload, source and arrival, makes a verdict with its
/// cause (for who receives), reads no clock.
///
/// The sensor is known by address, a port for each stream, serial number and init id: as the
/// configuration says (address) and the metadata (serial number), the rest by the first packets
/// that agree. Packets agree when eight of the lidar and four of the inertial unit come from one
/// sensor and their stamps run alike against their arrival. From then on a packet passes that
///   - comes from that sensor, and is a whole one of its streams;
///   - is stamped no more than 20 ms ahead of what its arrival tells and no more than 1 s before;
///   - counts as many columns since the last one as their stamps say (frame numbers, columns), and
///     is not overtaken by more than 30 ms of columns; is newer than the inertial sample before;
///   - is no more than twice what the sensor sends.
///
/// **Taken up again**, on the ground and in flight, are packets of the sensor that agree among each
/// other but not with what was known:
///   - its clock stepped (nothing else changed): after 0.03 s in which no packet of the lidar fits
///     what was known, and eight of it and two of the inertial unit agree on the step;
///   - it restarted, or sends from other ports: after 1 s without a packet of either stream; from
///     another address only with the same serial number in both.
/// Stamps then go on as if nothing had happened: `correction` is to be added. A network that got
/// faster is no step: columns tell.
///
/// **Inertial packets wait** while the lidar's stamps do not fit, and from one on whose stamp moved
/// against its arrival by 2 ms: until the lidar fits again, the step is known, or 0.1 s have
/// passed. They then pass in their order, by the clock that they were stamped by.
///
/// A packet that copies all of this cannot be told from the sensor's: Ouster's are not signed.
namespace saker::lidar {

struct GateVerdict {
  GateCause cause = GateCause::none;
  Time correction = 0;  ///< ns, to be added to the stamps of a packet that passes
  [[nodiscard]] bool passes() const { return cause == GateCause::none; }
};

struct GateFigures {
  long passed = 0;
  std::array<long, kGateCauses> refused{};         ///< by cause
  std::array<UdpSource, kGateCauses> last_from{};  ///< where the last one of each came from
  int agreements = 0;          ///< the first, and each time it was taken up again
  std::string last_agreement;  ///< what that was, as a line
};

struct SensorGateOptions {
  std::optional<std::uint32_t> address;  ///< of the sensor; nothing: whoever fits first
  /// Of stamps and arrivals, where both are of one clock (lockstep): the first packet is believed.
  std::optional<Time> offset;
};

class SensorGate {
 public:
  /// A packet with its stamps as they are to be flown by, and when it arrived.
  using Sink = std::function<void(std::vector<std::uint8_t> payload, Time arrival)>;

  explicit SensorGate(const SensorInfo& info, const SensorGateOptions& options = {});

  /// Gives on what may be flown by now: packets that waited for this one, then this one itself.
  /// \param arrival  ns of any clock that neither steps nor stops, at least 0
  void pass(std::span<const std::uint8_t> payload, const UdpSource& from, Time arrival,
            const Sink& sink);

  /// Of this packet alone: those that it releases are lost.
  [[nodiscard]] GateVerdict judge(std::span<const std::uint8_t> payload, const UdpSource& from,
                                  Time arrival);

  /// The packet that was judged last, with its stamps as they are to be flown by.
  void correct(std::span<std::uint8_t> payload, const GateVerdict& verdict) const {
    add_to_stamps(payload, verdict.correction, format_, info_);
  }

  /// Only who is to be heard on the stream's port; address 0: everybody, since none is known, or
  /// the one that was is silent.
  [[nodiscard]] UdpSource source(SensorStream stream, Time arrival) const;

  [[nodiscard]] const GateFigures& figures() const { return figures_; }
  [[nodiscard]] const SensorIdentity& identity() const { return known_; }

 private:
  [[nodiscard]] GateCause judge(const ArrivedReading& packet);
  [[nodiscard]] bool foreign(const SensorReading& reading) const;
  [[nodiscard]] GateCause unlike(const ArrivedReading& packet) const;
  [[nodiscard]] GateCause misplaced(const ArrivedReading& packet) const;
  [[nodiscard]] bool affordable(const ArrivedReading& packet);
  void accept(const ArrivedReading& packet);
  GateCause count(GateCause cause, const UdpSource& from);

  [[nodiscard]] bool doubted(Time arrival) const;
  [[nodiscard]] bool waited_enough(Time arrival) const;
  [[nodiscard]] bool moved(const ArrivedReading& packet) const;
  [[nodiscard]] GateCause wait(std::span<const std::uint8_t> payload, const ArrivedReading& packet,
                               GateCause cause);
  void release(Time until);
  [[nodiscard]] bool sent_before(const SensorCandidates::Candidate& stepped, Time step,
                                 const ArrivedReading& packet) const;
  void restamp_waiting(const SensorCandidates::Candidate& stepped, Time step);

  [[nodiscard]] bool take_up_from(const ArrivedReading& packet, GateCause cause);
  [[nodiscard]] bool may_replace(const SensorCandidates::Candidate& candidate,
                                 const ArrivedReading& packet) const;
  [[nodiscard]] std::string describe(const SensorIdentity& identity, bool known, Time step) const;
  [[nodiscard]] Time step_of(const SensorCandidates::Candidate& candidate) const;
  void take_up(const SensorCandidates::Candidate& candidate, Time arrival);

  SensorInfo info_;
  PacketFormat format_;
  ColumnCount count_;
  SensorGateOptions options_;
  std::uint64_t serial_number_;  // of the metadata; 0: it does not say

  bool agreed_ = false;
  SensorIdentity known_;
  StampLine line_;
  bool any_column_ = false;
  ColumnTime last_column_;
  Time newest_imu_ = 0;                   // corrected
  Time lidar_heard_ = 0, imu_heard_ = 0;  // arrivals of the last ones that passed
  Time correction_ = 0;
  double lidar_credit_ = 0, imu_credit_ = 0;  // packets, samples
  Time lidar_paid_ = 0, imu_paid_ = 0;
  SensorCandidates candidates_;
  std::optional<Time> doubted_since_;  // arrival of the lidar's first one that did not fit
  std::optional<Time> imu_offset_;     // of stamp and arrival, of the last one that passed
  WaitingPackets waiting_;
  std::deque<WaitingPacket> released_;  // by the packet that is judged
  GateFigures figures_;
};

}  // namespace saker::lidar
