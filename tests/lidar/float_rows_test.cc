#include "saker/lidar/clouds/float_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"
#include "saker/lidar/kitti_folder.h"

namespace saker::lidar {
namespace {

using testing::TemporaryFolder;

/// A scan of 32 rings around a sensor 2 m over the ground, column by column, with what `fields`
/// says.
std::vector<double> made_scan(const FloatFields& fields, double intensity_scale,
                              std::uint64_t seed) {
  core::Rng rng(seed);
  std::vector<double> values;
  for (int column = 0; column < 200; ++column) {
    for (int ring = 0; ring < 32; ++ring) {
      const double azimuth = 2 * M_PI * column / 200, elevation = 0.02 * (ring - 24);
      const double range = std::min(2 / std::max(0.03, -std::sin(elevation)), 5.0 + rng.index(60));
      for (const std::string& field : fields) {
        double value = 0;
        if (field == "x") value = range * std::cos(elevation) * std::cos(azimuth);
        if (field == "y") value = range * std::cos(elevation) * std::sin(azimuth);
        if (field == "z") value = range * std::sin(elevation);
        if (field == "intensity") {
          value = intensity_scale == 255 ? rng.index(120) : 0.01 * rng.index(60);
        }
        if (field == "ring") value = ring;
        if (field == "time") value = 0.0005 * column + 1e-6 * ring;
        values.push_back(value);
      }
    }
  }
  return values;
}

template <class T>
void write_scan(const std::filesystem::path& file, const std::vector<double>& values) {
  const std::vector<T> numbers(values.begin(), values.end());
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(numbers.data()),
             static_cast<std::streamsize>(numbers.size() * sizeof(T)));
}

std::string error_of(const std::filesystem::path& path, const std::string& fields = {}) {
  try {
    const KittiFolder source(path, fields);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

struct Layout {
  FloatFields fields;
  double intensity_scale;
};

class FloatRows : public ::testing::TestWithParam<Layout> {};
INSTANTIATE_TEST_SUITE_P(Layouts, FloatRows,
                         ::testing::Values(Layout{{"x", "y", "z"}, 1},
                                           Layout{{"x", "y", "z", "intensity"}, 1},
                                           Layout{{"x", "y", "z", "intensity"}, 255},
                                           Layout{{"x", "y", "z", "intensity", "ring"}, 255},
                                           Layout{{"x", "y", "z", "intensity", "ring"}, 1},
                                           Layout{{"x", "y", "z", "intensity", "ring", "time"}, 1},
                                           Layout{{"x", "y", "z", "intensity", "time"}, 255}));

TEST_P(FloatRows, TheNumberAndTheKindOfAPointsFloatsAreFound) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i) {
    write_scan<float>(folder / (std::to_string(i) + ".bin"),
                      made_scan(GetParam().fields, GetParam().intensity_scale, 10 + i));
  }
  KittiFolder source(folder.path());
  const auto frame = source.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->fault, "");
  EXPECT_EQ(frame->scan.size(), 200U * 32);
  const auto has = [&](const char* field) {
    const auto& fields = GetParam().fields;
    return std::find(fields.begin(), fields.end(), field) != fields.end();
  };
  EXPECT_EQ(!frame->scan.ring.empty(), has("ring"));
  if (has("ring")) {
    EXPECT_EQ(frame->scan.ring[33], 1);
  }
  if (has("time")) {
    EXPECT_LT(frame->scan.offset_ns.front(), -90'000'000);
  }
  if (GetParam().fields.size() != 4) {
    EXPECT_NE(source.note().find(describe_fields(GetParam().fields)), std::string::npos)
        << source.note();
  }
}

TEST(FloatFields, Float64IsRefusedByName) {
  const TemporaryFolder folder;
  write_scan<double>(folder / "0.bin", made_scan({"x", "y", "z", "intensity"}, 1, 1));
  EXPECT_NE(error_of(folder.path()).find("float64"), std::string::npos) << error_of(folder.path());
}

TEST(FloatFields, NoiseIsRefusedAndTheOptionIsNamed) {
  const TemporaryFolder folder;
  core::Rng rng(4);
  std::ofstream out(folder / "0.bin", std::ios::binary);
  for (int i = 0; i < 40'000; ++i) out.put(static_cast<char>(rng.index(256)));
  out.close();
  EXPECT_NE(error_of(folder.path()).find("--point-fields"), std::string::npos);
}

TEST(FloatFields, TheOptionOverrules) {
  const TemporaryFolder folder;
  write_scan<float>(folder / "0.bin", made_scan({"x", "y", "z", "intensity", "ring"}, 255, 1));
  const auto frame = KittiFolder(folder.path(), "x,y,z,_,ring").next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->scan.reflectivity[5], 0);
  EXPECT_EQ(frame->scan.ring[5], 5);
  for (const char* wrong : {"x,y", "x,y,z,x", "x,y,z,colour", "", "x,,y,z"}) {
    if (*wrong == 0) continue;  // not given
    EXPECT_NE(error_of(folder.path(), wrong).find("--point-fields"), std::string::npos) << wrong;
  }
}

TEST(FloatFields, OneDamagedFileOfThreeDoesNotMatter) {
  const TemporaryFolder folder;
  auto values = made_scan({"x", "y", "z", "intensity", "ring"}, 255, 1);
  write_scan<float>(folder / "1.bin", values);
  write_scan<float>(folder / "2.bin", values);
  values.pop_back();
  write_scan<float>(folder / "0.bin", values);
  KittiFolder source(folder.path());
  EXPECT_NE(source.next()->fault, "");
  EXPECT_EQ(source.next()->scan.size(), 200U * 32);
}

TEST(FloatFields, ASingleFileIsARecordingOfOneScan) {
  const TemporaryFolder folder;
  write_scan<float>(folder / "a.pcd.bin", made_scan({"x", "y", "z", "intensity", "ring"}, 255, 1));
  const auto source = open_recording(folder / "a.pcd.bin");
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->scan.ring.size(), 200U * 32);
  EXPECT_FALSE(source->next());
}

}  // namespace
}  // namespace saker::lidar
