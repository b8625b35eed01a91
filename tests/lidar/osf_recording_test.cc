#include "saker/lidar/osf/osf_recording.h"

#include <gtest/gtest.h>
#include <png.h>

#include <functional>

#include "made_bag.h"
#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"
#include "saker/lidar/metadata.h"
#include "saker/lidar/osf/osf_image.h"

namespace saker::lidar {
namespace {

using testing::TemporaryFolder;
using Bytes = std::vector<std::uint8_t>;

/// FlatBuffers, written from the root on: what a table refers to follows it.
class FlatWriter {
 public:
  struct Field {
    Bytes inline_bytes;                     ///< a number; or
    std::function<std::size_t()> referred;  ///< writes what the field refers to, says where
  };

  template <class T>
  static Field number(T value) {
    Bytes bytes(sizeof(T));
    std::memcpy(bytes.data(), &value, sizeof(T));
    return {bytes, {}};
  }
  Field vector(const Bytes& content, std::size_t count) {
    return {{}, [this, content, count] {
              const std::size_t at = bytes_.size();
              put(static_cast<std::uint32_t>(count));
              bytes_.insert(bytes_.end(), content.begin(), content.end());
              return at;
            }};
  }
  Field text(const std::string& text) { return vector({text.begin(), text.end()}, text.size()); }
  Field tables(const std::vector<std::vector<Field>>& all) {
    return {{}, [this, all] {
              const std::size_t at = bytes_.size();
              put(static_cast<std::uint32_t>(all.size()));
              bytes_.resize(bytes_.size() + 4 * all.size());
              for (std::size_t i = 0; i < all.size(); ++i) refer(at + 4 + 4 * i, table(all[i]));
              return at;
            }};
  }

  /// A buffer whose root is that table, with its kind at byte 4.
  Bytes buffer(const std::vector<Field>& root, const std::string& kind, bool size_prefixed) {
    bytes_.assign(4, 0);
    bytes_.insert(bytes_.end(), kind.begin(), kind.end());
    refer(0, table(root));
    if (!size_prefixed) return bytes_;
    Bytes whole(4);
    const auto size = static_cast<std::uint32_t>(bytes_.size());
    std::memcpy(whole.data(), &size, 4);
    whole.insert(whole.end(), bytes_.begin(), bytes_.end());
    return whole;
  }

 private:
  template <class T>
  void put(T value) {
    const auto* from = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), from, from + sizeof value);
  }
  void refer(std::size_t from, std::size_t to) {
    const auto offset = static_cast<std::uint32_t>(to - from);
    std::memcpy(&bytes_[from], &offset, 4);
  }
  std::size_t table(const std::vector<Field>& fields) {
    const std::size_t vtable = bytes_.size();
    std::size_t size = 4;
    put(static_cast<std::uint16_t>(4 + 2 * fields.size()));
    put(std::uint16_t{0});
    for (const Field& field : fields) {
      const std::size_t bytes = field.referred ? 4 : field.inline_bytes.size();
      put(static_cast<std::uint16_t>(bytes == 0 ? 0 : size));
      size += bytes;
    }
    const std::size_t at = bytes_.size();
    put(static_cast<std::int32_t>(at - vtable));
    std::vector<std::size_t> places;
    for (const Field& field : fields) {
      places.push_back(bytes_.size());
      bytes_.insert(bytes_.end(), field.inline_bytes.begin(), field.inline_bytes.end());
      if (field.referred) bytes_.resize(bytes_.size() + 4);
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].referred) refer(places[i], fields[i].referred());
    }
    return at;
  }

  Bytes bytes_;
};

template <class T>
Bytes raw(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// Today's packing of 32-bit numbers, by its description: planes of blue, green less blue, green
/// less red and the fourth byte, each less its left neighbour.
Bytes packed32(const std::vector<std::uint32_t>& values, std::size_t rows, std::size_t columns) {
  Bytes planes(4 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint8_t d[4];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t left = i % columns == 0 ? 0 : values[i - 1];
      d[k] = static_cast<std::uint8_t>((values[i] >> (8 * k)) - (left >> (8 * k)));
    }
    planes[i] = d[2];
    planes[values.size() + i] = static_cast<std::uint8_t>(d[1] - d[2]);
    planes[2 * values.size() + i] = static_cast<std::uint8_t>(d[1] - d[0]);
    planes[3 * values.size() + i] = d[3];
  }
  Bytes file = {0xF8, 0xFB};
  for (const std::size_t n : {columns, rows}) {
    file.push_back(static_cast<std::uint8_t>(n));
    file.push_back(static_cast<std::uint8_t>(n >> 8));
  }
  file.push_back(4);
  file.push_back(1);
  const Bytes data = testing::compressed("zstd", planes);
  file.insert(file.end(), data.begin(), data.end());
  return file;
}

/// PNG, its colours the number's bytes; rows destaggered.
Bytes png32(const std::vector<std::uint32_t>& values, const SensorInfo& info) {
  const auto columns = static_cast<std::size_t>(info.columns);
  std::vector<std::uint32_t> moved(values.size());
  for (int row = 0; row < info.rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t to = (column + info.pixel_shift_by_row[row]) % columns;
      moved[row * columns + to] = values[row * columns + column];
    }
  }
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(info.columns);
  image.height = static_cast<png_uint_32>(info.rows);
  image.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, moved.data(), 0, nullptr);
  Bytes bytes(size);
  png_image_write_to_memory(&image, bytes.data(), &size, 0, moved.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

SensorInfo sensor() {
  SensorInfo info = SensorInfo::make_os1(16, 512, PacketProfile::kRng19Rfl8Sig16Nir16);
  info.serial_number = "122246000293";
  return info;
}

Bytes scan_message(const SensorInfo& info, int frame, bool png) {
  const auto ranges = testing::made_ranges(info, frame);
  FlatWriter flat;
  const Bytes channel = png ? png32(ranges, info)
                            : packed32(ranges, static_cast<std::size_t>(info.rows),
                                       static_cast<std::size_t>(info.columns));
  std::vector<std::uint64_t> times;
  for (int column = 0; column < info.columns; ++column) {
    times.push_back(static_cast<std::uint64_t>(testing::made_time(info, frame, column)));
  }
  const auto columns = static_cast<std::size_t>(info.columns);
  return flat.buffer({flat.tables({{flat.vector(channel, channel.size())}}), flat.vector({1, 3}, 1),
                      flat.vector(raw(times), columns),
                      flat.vector(raw(std::vector<std::uint16_t>(columns, 0)), columns),
                      flat.vector(raw(std::vector<std::uint32_t>(columns, 1)), columns),
                      FlatWriter::number(std::int32_t{100 + frame})},
                     "    ", true);
}

void add_block(Bytes& file, const Bytes& block) {
  file.insert(file.end(), block.begin(), block.end());
  file.insert(file.end(), 4, 0);  // its check
}

Bytes made_osf(const SensorInfo& info, int frames, bool png) {
  FlatWriter flat;
  Bytes file;
  add_block(file, flat.buffer({FlatWriter::number(std::uint64_t{2})}, "OSF$", true));
  for (int frame = 0; frame < frames; ++frame) {
    const Bytes message = scan_message(info, frame, png);
    add_block(file, flat.buffer({flat.tables({{FlatWriter::number(std::uint64_t{1}),
                                               FlatWriter::number(std::uint32_t{2}),
                                               flat.vector(message, message.size())}})},
                                "OSF!", true));
  }
  FlatWriter inner;
  const Bytes lidar = inner.buffer({inner.text(metadata_json(info))}, "oLS_", true);
  const Bytes stream = inner.buffer({FlatWriter::number(std::uint32_t{1})}, "oLSS", true);
  const auto entry = [&](std::uint32_t id, const std::string& type, const Bytes& buffer) {
    return std::vector<FlatWriter::Field>{FlatWriter::number(id), flat.text(type),
                                          flat.vector(buffer, buffer.size())};
  };
  add_block(file,
            flat.buffer({{},
                         {},
                         {},
                         {},
                         flat.tables({entry(1, "ouster/v1/os_sensor/LidarSensor", lidar),
                                      entry(2, "ouster/v1/os_sensor/LidarScanStream", stream)})},
                        "OSF#", true));
  return file;
}

RecordingOptions with_ranges() {
  RecordingOptions options;
  options.keep_ranges = true;
  return options;
}

TEST(OsfRecording, ScansOfTodaysAndOfOlderFilesAreTheSame) {
  for (const bool png : {false, true}) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "drive", made_osf(sensor(), 3, png));
    const auto source = open_recording(folder / "drive", with_ranges());
    int frames = 0;
    for (; const auto frame = source->next(); ++frames) {
      ASSERT_EQ(frame->fault, "");
      EXPECT_EQ(source->assembled()->ranges_mm, testing::made_ranges(sensor(), frames)) << png;
      EXPECT_EQ(source->assembled()->frame_id, 100 + frames);
      EXPECT_EQ(frame->scan.stamp, testing::made_time(sensor(), frames, 511));
    }
    EXPECT_EQ(frames, 3);
    EXPECT_EQ(source->counters().summary(), "");
  }
}

TEST(OsfRecording, AnotherSensorThanTheOneThatIsThereIsRefused) {
  const TemporaryFolder folder;
  testing::write_bytes(folder / "drive", made_osf(sensor(), 1, false));
  RecordingOptions options;
  options.sensor = "1";
  EXPECT_THROW((void)open_recording(folder / "drive", options), Error);
  options.sensor = "122246000293";
  EXPECT_TRUE(open_recording(folder / "drive", options)->next());
}

TEST(OsfRecording, CutOrDamagedFilesNeverThrowPastTheOpening) {
  const TemporaryFolder folder;
  core::Rng rng(9);
  const Bytes whole = made_osf(sensor(), 2, false);
  for (int trial = 0; trial < 200; ++trial) {
    Bytes bytes = whole;
    if (trial % 2 == 0) {
      bytes.resize(static_cast<std::size_t>(rng.index(static_cast<int>(whole.size()))));
    } else {
      for (int i = 0; i < 5; ++i) {
        bytes[static_cast<std::size_t>(rng.index(static_cast<int>(whole.size())))] ^= 0x5A;
      }
    }
    testing::write_bytes(folder / "drive", bytes);
    try {
      OsfRecording source(folder / "drive");
      int frames = 0;
      while (source.next()) ++frames;
      EXPECT_LE(frames, 2);
    } catch (const Error&) {
      // Its head or its metadata were hit.
    }
  }
}

TEST(OsfImage, OfAnotherSizeOrDamagedIsRefused) {
  const auto ranges = testing::made_ranges(sensor(), 0);
  for (const Bytes& whole : {packed32(ranges, 16, 512), png32(ranges, sensor())}) {
    OsfImage image;
    EXPECT_TRUE(unpack_osf_image(whole, 16, 512, image));
    EXPECT_FALSE(unpack_osf_image(whole, 512, 16, image));
    for (std::size_t size = 0; size < whole.size(); size += 97) {
      EXPECT_FALSE(unpack_osf_image(ByteView(whole).first(size), 16, 512, image)) << size;
    }
  }
}

}  // namespace
}  // namespace saker::lidar
