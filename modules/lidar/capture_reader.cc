#include "saker/lidar/capture_reader.h"

#include <pcap/pcap.h>

#include <utility>

#include "saker/core/error.h"

namespace saker::lidar {

void CaptureReader::Closer::operator()(pcap* handle) const { pcap_close(handle); }

CaptureReader::CaptureReader(std::vector<std::filesystem::path> files) : files_(std::move(files)) {
  if (!files_.empty()) open(files_[next_file_++]);
}

void CaptureReader::open(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) {
    throw Error("cannot read capture " + file.string() + ": no such file");
  }
  char why[PCAP_ERRBUF_SIZE] = "";
  handle_.reset(
      pcap_open_offline_with_tstamp_precision(file.c_str(), PCAP_TSTAMP_PRECISION_NANO, why));
  if (!handle_) throw Error("cannot read capture " + file.string() + ": " + why);
  link_ = pcap_datalink(handle_.get());
  if (!link_known(link_)) {
    throw Error("cannot read capture " + file.string() + ": link type " + std::to_string(link_) +
                ", expected Ethernet, Linux cooked, raw IP or loopback");
  }
}

std::optional<Datagram> CaptureReader::next() {
  pcap_pkthdr* head = nullptr;
  const unsigned char* bytes = nullptr;
  while (!over_) {
    const int status = pcap_next_ex(handle_.get(), &head, &bytes);
    if (status != 1) {
      if (status == PCAP_ERROR) ended_early_ = pcap_geterr(handle_.get());
      over_ = !open_next();
      continue;
    }
    const Time captured =
        head->ts.tv_sec * kNanosecondsPerSecond + head->ts.tv_usec;  // nanoseconds, as asked for
    const auto ip = ip_packet({bytes, head->caplen}, link_);
    if (auto datagram = reassembly_.add(ip, captured)) return datagram;
  }
  return std::nullopt;
}

/// A part that is none ends the recording, with a line.
bool CaptureReader::open_next() {
  if (next_file_ >= files_.size()) return false;
  try {
    open(files_[next_file_++]);
  } catch (const Error& error) {
    ended_early_ = error.what();
    return false;
  }
  return true;
}

int CaptureReader::lost_datagrams() const {
  return reassembly_.lost() + (over_ ? reassembly_.unfinished() : 0);
}

}  // namespace saker::lidar
