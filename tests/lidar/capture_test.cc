#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "made_bag.h"
#include "made_clouds.h"
#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/bytes.h"
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

/// A capture of one datagram to port 7502 at 5.25 s, by the format's description.
Bytes made_pcap(bool nanoseconds, bool big_endian, std::uint32_t link, std::size_t link_head) {
  const Bytes data = payload(48, 1);
  std::array<std::uint8_t, 28> ip = {0x45};
  ip[9] = 17;
  write_network16(static_cast<unsigned>(28 + data.size()), &ip[2]);
  write_network16(7502, &ip[22]);
  write_network16(static_cast<unsigned>(8 + data.size()), &ip[24]);
  Bytes packet(link_head);
  packet.insert(packet.end(), ip.begin(), ip.end());
  packet.insert(packet.end(), data.begin(), data.end());
  Bytes file;
  testing::put(file, nanoseconds ? 0xA1B23C4DU : 0xA1B2C3D4U, big_endian);
  for (const int version : {2, 4}) {
    testing::put(file, static_cast<std::uint16_t>(version), big_endian);
  }
  const auto size = static_cast<std::uint32_t>(packet.size());
  const std::uint32_t fraction = nanoseconds ? 250'000'000 : 250'000;
  for (const std::uint32_t word : {0U, 0U, 65535U, link, 5U, fraction, size, size}) {
    testing::put(file, word, big_endian);
  }
  file.insert(file.end(), packet.begin(), packet.end());
  return file;
}

void expect_the_datagram(const std::filesystem::path& file) {
  CaptureReader reader(file);
  const auto datagram = reader.next();
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->captured, 5'250'000'000);
  EXPECT_EQ(datagram->port, 7502);
  EXPECT_TRUE(std::ranges::equal(datagram->payload, payload(48, 1)));
  EXPECT_FALSE(reader.next());
}

TEST(Capture, EitherOrderOfBytesAndPrecisionOfTimeReadsTheSame) {
  const TemporaryFolder folder;
  for (const bool nanoseconds : {false, true}) {
    for (const bool big_endian : {false, true}) {
      testing::write_bytes(folder / "a.pcap", made_pcap(nanoseconds, big_endian, 101, 0));
      expect_the_datagram(folder / "a.pcap");
    }
  }
}

TEST(Capture, IsReadOfEveryLinkWithIpAndRefusedOfOthersByTheirNumber) {
  const TemporaryFolder folder;
  // Loopback of two kinds, raw IP of two kinds, Linux cooked of two versions: numbers in files.
  const std::pair<std::uint32_t, std::size_t> links[] = {{0, 4},   {108, 4},  {101, 0},
                                                         {228, 0}, {113, 16}, {276, 20}};
  for (const auto& [link, head] : links) {
    SCOPED_TRACE(link);
    testing::write_bytes(folder / "a.pcap", made_pcap(true, false, link, head));
    expect_the_datagram(folder / "a.pcap");
  }
  testing::write_bytes(folder / "a.pcap", made_pcap(true, false, 105, 24));
  try {
    CaptureReader reader(folder / "a.pcap");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("link type 105"), std::string::npos) << error.what();
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
