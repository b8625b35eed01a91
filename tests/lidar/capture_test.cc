#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/capture_reader.h"
#include "saker/lidar/capture_writer.h"

namespace saker::lidar {
namespace {

using testing::Bytes;
using testing::TemporaryFolder;

Bytes payload(std::size_t size, int seed) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 31 + seed);
  return bytes;
}

void write_capture(const std::filesystem::path& file, int mtu) {
  CaptureWriter writer(file, mtu);
  for (int i = 0; i < 20; ++i) {
    writer.write(i * 1'000'000, 7502, payload(24832, i));
    writer.write(i * 1'000'000, 7503, payload(48, i));
  }
  writer.finish();
}

int check_capture(CaptureReader& reader) {
  int count = 0;
  for (; const auto datagram = reader.next(); ++count) {
    const bool lidar = count % 2 == 0;
    EXPECT_EQ(datagram->port, lidar ? 7502 : 7503);
    EXPECT_TRUE(std::ranges::equal(datagram->payload, payload(lidar ? 24832 : 48, count / 2)));
    EXPECT_EQ(datagram->captured, count / 2 * 1'000'000);
  }
  return count;
}

TEST(Capture, WhatIsWrittenReadsBackWholeOrInFragments) {
  const TemporaryFolder folder;
  for (const int mtu : {CaptureWriter::kEthernetMtu, 576, CaptureWriter::kNoFragments}) {
    write_capture(folder / "a.pcap", mtu);
    CaptureReader reader(folder / "a.pcap");
    EXPECT_EQ(check_capture(reader), 40);
    EXPECT_EQ(reader.ended_early(), "");
    EXPECT_EQ(reader.lost_datagrams(), 0);
  }
}

TEST(Capture, ACutCaptureGivesWhatWasWholeAndSaysSo) {
  const TemporaryFolder folder;
  write_capture(folder / "a.pcap", CaptureWriter::kEthernetMtu);
  const auto size = std::filesystem::file_size(folder / "a.pcap");
  std::filesystem::resize_file(folder / "a.pcap", size / 2 + 7);
  CaptureReader reader(folder / "a.pcap");
  const int count = check_capture(reader);
  EXPECT_NEAR(count, 20, 2);
  EXPECT_NE(reader.ended_early(), "");
}

TEST(Capture, AnUnfinishedCaptureLeavesNoFile) {
  const TemporaryFolder folder;
  {
    CaptureWriter writer(folder / "a.pcap");
    writer.write(0, 7502, payload(48, 0));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Capture, FilesThatAreNoCapturesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(CaptureReader(folder / "missing.pcap"), Error);
  EXPECT_THROW(CaptureReader{folder.path()}, Error);
  for (const char* content : {"", "not a capture, for it begins otherwise"}) {
    std::ofstream(folder / "a.pcap") << content;
    EXPECT_THROW(CaptureReader(folder / "a.pcap"), Error);
  }
}

TEST(Capture, AnUnwritableFileIsRefusedByName) {
  try {
    CaptureWriter writer("/nowhere/a.pcap");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/a.pcap"), std::string::npos);
  }
}

TEST(Capture, ADatagramLargerThanUdpAllowsIsRefused) {
  const TemporaryFolder folder;
  CaptureWriter writer(folder / "a.pcap");
  EXPECT_THROW(writer.write(0, 7502, payload(65508, 0)), Error);
}

}  // namespace
}  // namespace saker::lidar
