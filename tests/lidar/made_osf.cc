#include "made_osf.h"

#include <png.h>

#include <cstring>
#include <functional>

#include "made_bag.h"
#include "saker/lidar/metadata.h"

namespace saker::lidar::testing {
namespace {

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

/// The scan's own fields with its inertial samples.
FlatWriter::Field imu_fields(FlatWriter& flat, const SensorInfo& info, int frame, int count) {
  std::vector<std::uint64_t> times;
  std::vector<std::uint16_t> valid;
  std::vector<float> accelerations, rates;
  for (int i = 0; i < count; ++i) {
    const MadeOsfSample sample = made_osf_sample(info, frame, i);
    times.push_back(static_cast<std::uint64_t>(sample.stamp));
    valid.push_back(i % 5 == 4 ? 0 : 1);
    for (int k = 0; k < 3; ++k) accelerations.push_back(sample.acceleration[k]);
    for (int k = 0; k < 3; ++k) rates.push_back(sample.rate[k]);
  }
  const auto rows = static_cast<std::size_t>(count);
  const auto bits = [&](const std::vector<float>& values) {
    std::vector<std::uint32_t> all(values.size());
    std::memcpy(all.data(), values.data(), 4 * values.size());
    return packed32(all, rows, 3);
  };
  const auto field = [&](const char* name, const Bytes& data) {
    return std::vector<FlatWriter::Field>{flat.text(name),
                                          FlatWriter::number(std::uint8_t{9}),
                                          {},
                                          FlatWriter::number(std::int64_t{4}),
                                          flat.vector(data, data.size())};
  };
  return flat.tables({field("IMU_TIMESTAMP", raw(times)), field("IMU_STATUS", raw(valid)),
                      field("IMU_ACC", bits(accelerations)), field("IMU_GYRO", bits(rates))});
}

Bytes scan_message(const SensorInfo& info, int frame, bool png, bool timed, int imu) {
  const auto ranges = made_ranges(info, frame);
  FlatWriter flat;
  const Bytes channel = png ? png32(ranges, info)
                            : packed32(ranges, static_cast<std::size_t>(info.rows),
                                       static_cast<std::size_t>(info.columns));
  std::vector<std::uint64_t> times;
  for (int column = 0; column < info.columns; ++column) {
    times.push_back(static_cast<std::uint64_t>(made_time(info, frame, column)));
  }
  const auto columns = static_cast<std::size_t>(info.columns);
  return flat.buffer({flat.tables({{flat.vector(channel, channel.size())}}),
                      flat.vector({1, 3}, 1),
                      timed ? flat.vector(raw(times), columns) : flat.vector({}, 0),
                      flat.vector(raw(std::vector<std::uint16_t>(columns, 0)), columns),
                      flat.vector(raw(std::vector<std::uint32_t>(columns, 1)), columns),
                      FlatWriter::number(std::int32_t{100 + frame}),
                      {},
                      {},
                      imu > 0 ? imu_fields(flat, info, frame, imu) : FlatWriter::Field{}},
                     "    ", true);
}

void add_block(Bytes& file, const Bytes& block) {
  file.insert(file.end(), block.begin(), block.end());
  file.insert(file.end(), 4, 0);  // its check
}

}  // namespace

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
  const Bytes data = compressed("zstd", planes);
  file.insert(file.end(), data.begin(), data.end());
  return file;
}

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

SensorInfo osf_sensor() {
  SensorInfo info = SensorInfo::make_os1(16, 512, PacketProfile::kRng19Rfl8Sig16Nir16);
  info.serial_number = "122246000293";
  return info;
}

MadeOsfSample made_osf_sample(const SensorInfo& info, int frame, int i) {
  const auto step = static_cast<float>(i);
  return {made_time(info, frame, 0) + 1'000'000 + i * 9'000'000,
          {0.01F * step, -0.1F, 1},
          {step, 2, -3.5F * static_cast<float>(frame)}};
}

Bytes made_osf(const SensorInfo& info, int frames, bool png, bool timed, int imu) {
  FlatWriter flat;
  Bytes file;
  add_block(file, flat.buffer({FlatWriter::number(std::uint64_t{2})}, "OSF$", true));
  for (int frame = 0; frame < frames; ++frame) {
    const Bytes message = scan_message(info, frame, png, timed, imu);
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

}  // namespace saker::lidar::testing
