#include "saker/lidar/spinning/spinning_capture.h"

#include <algorithm>

#include "saker/core/error.h"
#include "saker/lidar/spinning/calibration_file.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

constexpr int kMostDatagrams = 20'000;

std::string name_of(const Datagram& datagram) {
  return to_string(datagram.source) + ":" + std::to_string(datagram.port);
}

std::string list_of(const std::vector<SpinningSenders::Sender>& senders) {
  std::string list;
  for (const auto& sender : senders) {
    list +=
        (list.empty() ? "" : ", ") + sender.name + " (" + spinning_model(sender.kind).name + ")";
  }
  return list;
}

const SpinningSenders::Sender& choose(const std::vector<SpinningSenders::Sender>& senders,
                                      const std::string& wanted, const std::string& where) {
  if (wanted.empty()) {
    if (senders.size() == 1) return senders.front();
    throw Error(where + ": packets of " + std::to_string(senders.size()) + " sensors, " +
                list_of(senders) + ": choose one with --sensor");
  }
  const auto named = [&](const SpinningSenders::Sender& sender) {
    return sender.name == wanted || sender.name.substr(0, sender.name.rfind(':')) == wanted;
  };
  const auto found = std::find_if(senders.begin(), senders.end(), named);
  if (found == senders.end() || std::find_if(found + 1, senders.end(), named) != senders.end()) {
    throw Error(where + ": --sensor " + wanted + ": expected one of " + list_of(senders));
  }
  return *found;
}

}  // namespace

SpinningSenders find_spinning_senders(const fs::path& capture) {
  CaptureReader reader(capture);
  SpinningSenders found;
  while (found.datagrams < kMostDatagrams) {
    const auto datagram = reader.next();
    if (!datagram) break;
    ++found.datagrams;
    const auto packet = read_spinning_packet(datagram->payload);
    if (!packet) {
      if (found.unread.empty()) found.unread = unread_spinning_packet(datagram->payload);
      continue;
    }
    ++found.packets;
    const std::string name = name_of(*datagram);
    auto& senders = found.senders;
    auto known = std::find_if(senders.begin(), senders.end(),
                              [&](const auto& sender) { return sender.name == name; });
    if (known == senders.end()) known = senders.insert(known, {name, packet->kind, 0});
    ++known->packets;
  }
  return found;
}

SpinningModel calibrated_model(SpinningKind kind, const fs::path& given, const fs::path& recording,
                               std::string& note) {
  SpinningModel model = spinning_model(kind);
  const fs::path file = given.empty() ? find_calibration(recording) : given;
  if (!file.empty()) {
    read_calibration(file, model);
    note = model.name + ", calibration of " + file.filename().string();
  } else if (model.needs_calibration) {
    throw Error(recording.string() + ": packets of a " + model.name +
                ", which has a calibration file of its own: expected --meta FILE (db.xml or YAML)");
  } else {
    note = model.name + ", angles of its manual";
  }
  return model;
}

SpinningCapture::SpinningCapture(const std::vector<fs::path>& files, const SpinningSenders& found,
                                 const RecordingOptions& options)
    : reader_(files),
      only_(choose(found.senders, options.sensor, files.front().string()).name),
      stream_(calibrated_model(choose(found.senders, options.sensor, files.front().string()).kind,
                               options.metadata, files.front(), note_)) {}

std::optional<Frame> SpinningCapture::next() {
  while (true) {
    if (auto frame = stream_.take()) return frame;
    if (over_) return std::nullopt;
    const auto datagram = reader_.next();
    if (!datagram) {
      over_ = true;
      stream_.finish();
      continue;
    }
    if (name_of(*datagram) == only_) {
      stream_.add(datagram->payload, datagram->captured);
    } else {
      other_sensors_ += read_spinning_packet(datagram->payload).has_value();
    }
  }
}

SourceCounters SpinningCapture::counters() const {
  SourceCounters counters = stream_.counters();
  counters.bad_packets += reader_.cut_packets();
  counters.other_sensors = other_sensors_;
  counters.lost_fragments = reader_.lost_datagrams();
  counters.ended_early = reader_.ended_early();
  return counters;
}

}  // namespace saker::lidar
