#include "saker/lidar/sensor_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "saker/lidar/frame_number.h"

namespace saker::lidar {
namespace {

constexpr Time kSilence = 150'000'000;     // ns; then everybody is heard
constexpr Time kStepSilence = 30'000'000;  // what was known fits no longer
constexpr Time kMostDoubt = 100'000'000;   // that inertial packets wait for
constexpr Time kMostUntold = 50'000'000;   // without a packet of the lidar
constexpr double kLeastMoved_s = 0.002;    // real ones jitter by half of it
constexpr Time kRestartSilence = kNanosecondsPerSecond;
constexpr double kMostOvertaken_s = 0.03;
constexpr double kMostDelay_s = 10;        // on the network, or of a sensor that falls behind
constexpr double kMostCounted_s = 0.5;     // that columns tell better than arrival
constexpr double kMostMiscounted_s = 0.2;  // beyond, frames are numbered anew
constexpr double kMostOften = 2;           // times the lidar's rate
constexpr double kMostSamples_hz = 1000;   // the fastest inertial unit has 640
constexpr double kMostSamplesAtOnce = 400;

/// Credit that grew since it was paid for last.
double grown(double credit, Time since, Time now, double rate_hz, double most) {
  return std::min(most, credit + std::max(0.0, to_seconds(now - since)) * rate_hz);
}

/// Causes of a sensor that is what it was, or says what was not expected; those of packets that are
/// none tell nothing.
bool may_be_sensor(GateCause cause) {
  switch (cause) {
    case GateCause::not_agreed:
    case GateCause::address:
    case GateCause::port:
    case GateCause::restarted:
    case GateCause::ahead:
    case GateCause::late:
    case GateCause::back:
    case GateCause::frame:
    case GateCause::out_of_order:
      return true;
    default:
      return false;
  }
}

GateCause cause_of(ReadingFault fault) {
  return fault == ReadingFault::shape     ? GateCause::shape
         : fault == ReadingFault::columns ? GateCause::columns
                                          : GateCause::stamp;
}

/// Its stamps are not those that are due: the clock may have stepped.
bool tells_of_step(GateCause cause) {
  return cause == GateCause::ahead || cause == GateCause::late || cause == GateCause::frame;
}

}  // namespace

SensorGate::SensorGate(const SensorInfo& info, const SensorGateOptions& options)
    : info_(info),
      format_(info),
      count_(info),
      options_(options),
      serial_number_(std::strtoull(info.serial_number.c_str(), nullptr, 10)),
      candidates_(info) {
  if (!options.offset) return;
  agreed_ = true;
  line_.begin(*options.offset, 0);
}

void SensorGate::pass(std::span<const std::uint8_t> payload, const UdpSource& from, Time arrival,
                      const Sink& sink) {
  const GateVerdict verdict = judge(payload, from, arrival);
  for (WaitingPacket& waited : released_) sink(std::move(waited.payload), waited.packet.arrival);
  released_.clear();
  if (!verdict.passes()) return;
  std::vector<std::uint8_t> passed(payload.begin(), payload.end());
  correct(passed, verdict);
  sink(std::move(passed), arrival);
}

GateVerdict SensorGate::judge(std::span<const std::uint8_t> payload, const UdpSource& from,
                              Time arrival) {
  released_.clear();
  if (options_.address && from.address != *options_.address) {
    return {count(GateCause::address, from)};
  }
  const ReadPacket read = read_sensor_packet(payload, format_, info_);
  if (read.fault != ReadingFault::none) return {count(cause_of(read.fault), from)};
  if (foreign(read.reading)) return {count(GateCause::serial_number, from)};
  const ArrivedReading packet{read.reading, from, arrival};
  if (waited_enough(arrival)) release(arrival);
  GateCause cause = judge(packet);
  if (take_up_from(packet, cause)) cause = judge(packet);
  if (packet.reading.stream == SensorStream::imu) {
    cause = wait(payload, packet, cause);
  } else if (tells_of_step(cause) && !doubted_since_) {
    doubted_since_ = arrival;
  }
  if (cause == GateCause::none) accept(packet);
  return {count(cause, from), correction_};
}

GateCause SensorGate::judge(const ArrivedReading& packet) {
  if (!agreed_) return GateCause::not_agreed;
  if (const GateCause cause = unlike(packet); cause != GateCause::none) return cause;
  if (const GateCause cause = misplaced(packet); cause != GateCause::none) return cause;
  return affordable(packet) ? GateCause::none : GateCause::too_many;
}

/// Of another sensor than the metadata's, or than the one that is known.
bool SensorGate::foreign(const SensorReading& reading) const {
  const std::uint64_t serial = reading.sender ? reading.sender->serial_number : 0;
  const std::uint64_t known = serial_number_ != 0 ? serial_number_ : known_.sender.serial_number;
  return serial != 0 && known != 0 && serial != known;
}

/// Not from the sensor that is known.
GateCause SensorGate::unlike(const ArrivedReading& packet) const {
  if (packet.from.address != known_.address) return GateCause::address;
  const bool lidar = packet.reading.stream == SensorStream::lidar;
  if (packet.from.port != (lidar ? known_.lidar_port : known_.imu_port)) return GateCause::port;
  const bool told = packet.reading.sender && known_.sender != PacketSender{};
  return told && *packet.reading.sender != known_.sender ? GateCause::restarted : GateCause::none;
}

GateCause SensorGate::misplaced(const ArrivedReading& packet) const {
  const SensorReading& reading = packet.reading;
  if (!reading.any) return GateCause::none;
  switch (line_.judge(packet.offset())) {
    case StampLine::Place::ahead:
      return GateCause::ahead;
    case StampLine::Place::late:
      return GateCause::late;
    case StampLine::Place::on:
      break;
  }
  if (reading.stream == SensorStream::imu) {
    return reading.oldest + correction_ > newest_imu_ ? GateCause::none : GateCause::back;
  }
  if (!any_column_) return GateCause::none;
  if (!count_.agrees(last_column_, reading.last)) return GateCause::frame;
  const double ahead = count_.seconds(last_column_, reading.last);
  return ahead < -kMostOvertaken_s ? GateCause::out_of_order : GateCause::none;
}

bool SensorGate::affordable(const ArrivedReading& packet) {
  const Time now = packet.arrival;
  if (packet.reading.stream == SensorStream::imu) {
    const double samples = packet.reading.samples;
    imu_credit_ = grown(imu_credit_, imu_paid_, now, kMostSamples_hz, kMostSamplesAtOnce);
    imu_paid_ = std::max(imu_paid_, now);
    if (imu_credit_ < samples) return false;
    imu_credit_ -= samples;
    return true;
  }
  const double revolution =
      std::ceil(static_cast<double>(info_.columns) / info_.columns_per_packet);
  lidar_credit_ = grown(lidar_credit_, lidar_paid_, now,
                        kMostOften * revolution * info_.frame_rate_hz, kMostOften * revolution);
  lidar_paid_ = std::max(lidar_paid_, now);
  if (lidar_credit_ < 1) return false;
  lidar_credit_ -= 1;
  return true;
}

void SensorGate::accept(const ArrivedReading& packet) {
  const SensorReading& reading = packet.reading;
  const bool lidar = reading.stream == SensorStream::lidar;
  if (!reading.any) return;
  (lidar ? lidar_heard_ : imu_heard_) = packet.arrival;
  if (reading.sender && known_.sender == PacketSender{}) known_.sender = *reading.sender;
  line_.follow(packet.offset(), packet.arrival);
  if (!lidar) {
    newest_imu_ = reading.newest + correction_;
    imu_offset_ = packet.offset();
  } else if (!any_column_ || count_.seconds(last_column_, reading.last) > 0) {
    any_column_ = true;
    last_column_ = reading.last;
    doubted_since_.reset();
    candidates_.drop(known_);
    release(packet.arrival);
  }
}

GateCause SensorGate::count(GateCause cause, const UdpSource& from) {
  if (cause == GateCause::waits) return cause;
  if (cause == GateCause::none) {
    ++figures_.passed;
  } else {
    ++figures_.refused[static_cast<std::size_t>(cause)];
    figures_.last_from[static_cast<std::size_t>(cause)] = from;
  }
  return cause;
}

bool SensorGate::doubted(Time arrival) const {
  return doubted_since_ && arrival - *doubted_since_ <= kMostDoubt;
}

/// Against its arrival, and the lidar is there to tell whether that was a step.
bool SensorGate::moved(const ArrivedReading& packet) const {
  if (!imu_offset_ || packet.arrival - lidar_heard_ > kMostUntold) return false;
  return std::abs(to_seconds(packet.offset() - *imu_offset_)) > kLeastMoved_s;
}

bool SensorGate::waited_enough(Time arrival) const {
  return !waiting_.empty() && !doubted(arrival) &&
         arrival - waiting_.oldest_arrival() > kMostUntold;
}

/// What becomes of an inertial packet whose clock may have stepped.
GateCause SensorGate::wait(std::span<const std::uint8_t> payload, const ArrivedReading& packet,
                           GateCause cause) {
  const bool fits = cause == GateCause::none;
  const bool misplaced =
      cause == GateCause::ahead || cause == GateCause::late || cause == GateCause::back;
  if (!packet.reading.any || (!fits && !misplaced)) return cause;
  if (fits && !doubted(packet.arrival) && !waiting_.any_due() && !moved(packet)) return cause;
  if (fits) cause = GateCause::waits;
  return waiting_.keep(payload, packet, cause) || !fits ? cause : GateCause::too_many;
}

/// Those that arrived until then, by what is known now.
void SensorGate::release(Time until) {
  while (std::optional<WaitingPacket> waited = waiting_.take(until)) {
    const ArrivedReading& packet = waited->packet;
    const bool refused_before = waited->cause != GateCause::waits;
    GateCause cause = unlike(packet);
    if (cause == GateCause::none) cause = misplaced(packet);
    if (cause != GateCause::none) {
      if (!refused_before) (void)count(cause, packet.from);
      continue;
    }
    if (refused_before) --figures_.refused[static_cast<std::size_t>(waited->cause)];
    accept(packet);
    (void)count(cause, packet.from);
    add_to_stamps(waited->payload, correction_, format_, info_);
    released_.push_back(std::move(*waited));
  }
}

/// Whether an inertial packet was sent before the clock stepped.
bool SensorGate::sent_before(const SensorCandidates::Candidate& stepped, Time step,
                             const ArrivedReading& packet) const {
  if (line_.judge(packet.offset()) != StampLine::Place::on) return false;
  if (packet.arrival <= lidar_heard_) return true;
  if (packet.arrival >= stepped.first_arrival || !imu_offset_) return false;
  const double moved_s = to_seconds(packet.offset() - *imu_offset_);
  return std::abs(moved_s) < std::abs(moved_s - to_seconds(step));
}

/// As if all had been sent after it.
void SensorGate::restamp_waiting(const SensorCandidates::Candidate& stepped, Time step) {
  for (WaitingPacket& waiting : waiting_.all()) {
    if (!sent_before(stepped, step, waiting.packet)) continue;
    waiting.packet.reading.oldest += step;
    waiting.packet.reading.newest += step;
    add_to_stamps(waiting.payload, step, format_, info_);
  }
}

/// Whether the packet made a sensor known that was not, or not so.
bool SensorGate::take_up_from(const ArrivedReading& packet, GateCause cause) {
  const bool imu_passes = cause == GateCause::none && packet.reading.stream == SensorStream::imu;
  if (!packet.reading.any || (!imu_passes && !may_be_sensor(cause))) return false;
  const SensorCandidates::Candidate* candidate = candidates_.offer(packet, !imu_passes);
  if (candidate == nullptr || !may_replace(*candidate, packet)) return false;
  take_up(*candidate, packet.arrival);
  return true;
}

/// Of a step the lidar's packets tell alone: its port may be read after the inertial unit's.
bool SensorGate::may_replace(const SensorCandidates::Candidate& candidate,
                             const ArrivedReading& packet) const {
  const SensorIdentity& identity = candidate.identity;
  if (agreed_ && identity == known_) {
    return candidate.agrees_on_step() && packet.reading.stream == SensorStream::lidar &&
           packet.arrival - lidar_heard_ > kStepSilence;
  }
  if (!candidate.agrees()) return false;
  if (!agreed_) return true;
  const bool proven = identity.sender.serial_number != 0 &&
                      identity.sender.serial_number == known_.sender.serial_number;
  return (proven || identity.address == known_.address) &&
         packet.arrival - std::max(lidar_heard_, imu_heard_) > kRestartSilence;
}

/// By how much the clock was set. Arrival tells it to the network's delay, columns to the motor's
/// evenness. Where columns say that it was not, what changed is how long packets are on their way.
Time SensorGate::step_of(const SensorCandidates::Candidate& candidate) const {
  const Time by_arrival = candidate.offset - line_.offset();
  if (!any_column_ || candidate.identity != known_) return by_arrival;
  const double arrival_s = to_seconds(candidate.offset) - to_seconds(line_.offset());
  const ColumnTime& first = candidate.first_column;
  if (std::abs(arrival_s) < kMostDelay_s && count_.agrees(last_column_, first)) return 0;
  const double counted_s = count_.seconds(last_column_, first);
  const Time by_columns = first.stamp - last_column_.stamp - from_seconds(counted_s);
  const bool counts = counted_s > 0 && counted_s < kMostCounted_s &&
                      std::abs(to_seconds(by_columns) - arrival_s) < kMostMiscounted_s;
  return counts ? by_columns : by_arrival;
}

/// Stamps go on in the time that was flown by.
void SensorGate::take_up(const SensorCandidates::Candidate& candidate, Time arrival) {
  const bool known = agreed_ && candidate.identity == known_;
  const Time step = agreed_ ? step_of(candidate) : 0;
  figures_.last_agreement = describe(candidate.identity, known, step);
  if (known) {
    restamp_waiting(candidate, step);
    if (imu_offset_) *imu_offset_ += step;
  } else {
    waiting_.clear();
    imu_offset_.reset();
  }
  correction_ -= step;
  agreed_ = true;
  known_ = candidate.identity;
  line_.begin(candidate.offset, arrival);
  any_column_ = true;
  last_column_ = candidate.last_column;
  lidar_heard_ = imu_heard_ = arrival;
  doubted_since_.reset();
  ++figures_.agreements;
  candidates_.clear();
  release(arrival);
}

/// What is known from now on.
std::string SensorGate::describe(const SensorIdentity& identity, bool known, Time step) const {
  const std::string who = to_string(identity);
  if (!agreed_) return who + ": taken for the sensor";
  if (known && step == 0) return who + ": its packets come sooner, or later";
  return fmt::format("{}: {}, stamps are put back by {:.6f} s", who,
                     known ? "its clock stepped" : "it restarted", -to_seconds(step));
}

UdpSource SensorGate::source(SensorStream stream, Time arrival) const {
  const UdpSource configured{options_.address.value_or(0), 0};
  if (!agreed_) return configured;
  const bool lidar = stream == SensorStream::lidar;
  if (arrival - (lidar ? lidar_heard_ : imu_heard_) > kSilence) return configured;
  return {known_.address, lidar ? known_.lidar_port : known_.imu_port};
}

}  // namespace saker::lidar
