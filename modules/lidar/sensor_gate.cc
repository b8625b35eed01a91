#include "saker/lidar/sensor_gate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "saker/lidar/frame_number.h"

namespace saker::lidar {
namespace {

constexpr Time kStepSilence = 150'000'000;  // ns; what was known fits no longer
constexpr Time kRestartSilence = kNanosecondsPerSecond;
constexpr double kMostOvertaken_s = 0.03;
constexpr double kMostDelay_s = 10;       // on the network, or of a sensor that falls behind
constexpr double kMostOften = 2;          // times the lidar's rate
constexpr double kMostSamples_hz = 1000;  // the fastest inertial unit has 640
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

}  // namespace

const char* to_string(GateCause cause) {
  switch (cause) {
    case GateCause::none:
      return "believed";
    case GateCause::not_agreed:
      return "before both streams of a sensor agreed";
    case GateCause::shape:
      return "no packet of this sensor";
    case GateCause::address:
      return "from another address";
    case GateCause::port:
      return "from another port";
    case GateCause::serial_number:
      return "of another serial number";
    case GateCause::restarted:
      return "of another init id";
    case GateCause::stamp:
      return "stamped with no time";
    case GateCause::ahead:
      return "stamped ahead of time";
    case GateCause::late:
      return "stamped long before";
    case GateCause::back:
      return "stamped back in time";
    case GateCause::frame:
      return "of a frame that is not due";
    case GateCause::columns:
      return "with columns not in a row";
    case GateCause::out_of_order:
      return "out of order";
    case GateCause::too_many:
      return "more often than the sensor sends";
  }
  return "";
}

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

GateVerdict SensorGate::judge(std::span<const std::uint8_t> payload, const UdpSource& from,
                              Time arrival) {
  if (options_.address && from.address != *options_.address) {
    return {count(GateCause::address, from)};
  }
  const ReadPacket read = read_sensor_packet(payload, format_, info_);
  if (read.fault != ReadingFault::none) return {count(cause_of(read.fault), from)};
  if (foreign(read.reading)) return {count(GateCause::serial_number, from)};
  const ArrivedReading packet{read.reading, from, arrival};
  GateCause cause = judge(packet);
  if (take_up_from(packet, cause)) cause = judge(packet);
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
  } else if (!any_column_ || count_.seconds(last_column_, reading.last) > 0) {
    any_column_ = true;
    last_column_ = reading.last;
  }
}

GateCause SensorGate::count(GateCause cause, const UdpSource& from) {
  if (cause == GateCause::none) {
    ++figures_.passed;
  } else {
    ++figures_.refused[static_cast<std::size_t>(cause)];
    figures_.last_from[static_cast<std::size_t>(cause)] = from;
  }
  return cause;
}

/// Whether the packet made a sensor known that was not, or not so.
bool SensorGate::take_up_from(const ArrivedReading& packet, GateCause cause) {
  const bool imu_passes = cause == GateCause::none && packet.reading.stream == SensorStream::imu;
  if (!packet.reading.any || (!imu_passes && !may_be_sensor(cause))) return false;
  const SensorCandidates::Candidate* candidate = candidates_.offer(packet, !imu_passes);
  if (candidate == nullptr || !candidate->agrees()) return false;
  if (!may_replace(candidate->identity, packet.arrival)) return false;
  take_up(*candidate, packet.arrival);
  return true;
}

bool SensorGate::may_replace(const SensorIdentity& identity, Time arrival) const {
  if (!agreed_) return true;
  if (identity == known_) return arrival - lidar_heard_ > kStepSilence;
  const bool proven = identity.sender.serial_number != 0 &&
                      identity.sender.serial_number == known_.sender.serial_number;
  return (proven || identity.address == known_.address) &&
         arrival - std::max(lidar_heard_, imu_heard_) > kRestartSilence;
}

/// Stamps go on in the time that was flown by. Where columns say that no clock was set, what
/// changed is how long packets are on their way.
void SensorGate::take_up(const SensorCandidates::Candidate& candidate, Time arrival) {
  const double change = to_seconds(candidate.offset) - to_seconds(line_.offset());
  const bool counted_on = agreed_ && candidate.identity == known_ && any_column_ &&
                          std::abs(change) < kMostDelay_s &&
                          count_.agrees(last_column_, candidate.first_column);
  const Time before = correction_;
  if (agreed_ && !counted_on) correction_ += line_.offset() - candidate.offset;
  figures_.last_agreement =
      to_string(candidate.identity) +
      (!agreed_ ? ": taken for the sensor"
                : (candidate.identity == known_ ? ": its clock stepped" : ": it restarted") +
                      std::string(", stamps are put back by ") +
                      std::to_string(to_seconds(correction_ - before)) + " s");
  if (counted_on)
    figures_.last_agreement = to_string(known_) + ": its packets come sooner, or later";
  agreed_ = true;
  known_ = candidate.identity;
  line_.begin(candidate.offset, arrival);
  any_column_ = true;
  last_column_ = candidate.last_column;
  lidar_heard_ = imu_heard_ = arrival;
  ++figures_.agreements;
  candidates_.clear();
}

UdpSource SensorGate::source(SensorStream stream, Time arrival) const {
  const UdpSource configured{options_.address.value_or(0), 0};
  if (!agreed_) return configured;
  const bool lidar = stream == SensorStream::lidar;
  if (arrival - (lidar ? lidar_heard_ : imu_heard_) > kStepSilence) return configured;
  return {known_.address, lidar ? known_.lidar_port : known_.imu_port};
}

}  // namespace saker::lidar
