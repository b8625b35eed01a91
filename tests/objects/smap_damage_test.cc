/// Files that are cut, damaged or made up: what is whole is read, a line says what is lost, and
/// nothing crashes or claims memory without end.
#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <sstream>

#include "made_map.h"
#include "paths.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/checksum.h"
#include "saker/objects/map_io.h"

namespace saker::objects {
namespace {

const ClassTable kTable;

ObjectMap some_map(int count = 600) {
  ObjectMap map = made::large_map(count, 4);
  for (MapObject& object : map.objects) {
    if (object.class_id == 1) object.covariance = Matrix9d(0.01 * Matrix9d::Identity());
    object.observations = object.id % 9;
  }
  for (int i = 0; i < 40; ++i) {
    map.ground.push_back({Eigen::Vector3d::UnitZ(), {3.0 * i, 2.0 * i, 1}, 2});
  }
  return map;
}

const std::string& good_file() {
  static const std::string bytes = to_smap(some_map(), kTable);
  return bytes;
}

/// For thousands of tries.
const std::string& small_file() {
  static const std::string bytes = to_smap(some_map(60), kTable);
  return bytes;
}

MapRead read_of(const std::string& bytes) {
  std::istringstream in(bytes);
  return SmapReader(in, "m.smap").read(kTable);
}

SmapHead head_of(const std::string& bytes) {
  return unpack_head(content_of(std::string_view(bytes).substr(0, bytes_of(bytes))));
}

/// Where the tile with the most objects begins.
std::size_t begin_of_fullest(const SmapHead& head, SmapTile& fullest) {
  std::size_t at = bytes_of(good_file()), begin = at;
  for (const SmapTile& tile : head.tiles) {
    if (tile.objects > fullest.objects) {
      fullest = tile;
      begin = at;
    }
    at += static_cast<std::size_t>(tile.bytes());
  }
  return begin;
}

std::string flipped(std::string bytes, std::size_t at) {
  bytes[at] = static_cast<char>(bytes[at] ^ 0x40);
  return bytes;
}

TEST(SmapDamage, ADamagedTileLosesItsObjectsAndNoOthers) {
  SmapTile tile;
  const std::size_t at = begin_of_fullest(head_of(good_file()), tile);
  const MapRead read = read_of(flipped(good_file(), at + 30));
  EXPECT_EQ(read.map.objects.size(), 600U - static_cast<std::size_t>(tile.objects));
  EXPECT_EQ(read.map.ground.size(), 40U);
  ASSERT_EQ(read.damage.size(), 1U);
  EXPECT_NE(read.damage[0].find("m.smap: tile of x "), std::string::npos) << read.damage[0];
  EXPECT_NE(read.damage[0].find("wrong checksum; " + std::to_string(tile.objects) + " objects"),
            std::string::npos)
      << read.damage[0];
  const ObjectMap whole = from_smap(good_file(), kTable, "m.smap");
  std::size_t next = 0;
  for (const MapObject& object : read.map.objects) {
    while (next < whole.objects.size() && whole.objects[next].id != object.id) ++next;
    ASSERT_LT(next, whole.objects.size());
    EXPECT_EQ(place(object.model), place(whole.objects[next].model));
  }
}

TEST(SmapDamage, WhereDetailsAreDamagedTheGeometryIsKept) {
  SmapTile tile;
  const std::size_t at = begin_of_fullest(head_of(good_file()), tile);
  const auto last = at + static_cast<std::size_t>(tile.bytes()) - 1;
  const MapRead read = read_of(flipped(good_file(), last));
  EXPECT_EQ(read.map.objects.size(), 600U);
  ASSERT_EQ(read.damage.size(), 1U);
  EXPECT_NE(read.damage[0].find("details of"), std::string::npos);
  std::set<int> ids;
  for (const MapObject& object : read.map.objects) ids.insert(object.id);
  EXPECT_EQ(ids.size(), 600U);
}

TEST(SmapDamage, ADamagedHeadIsReadFromTheEnd) {
  const std::string whole = to_json(read_of(good_file()).map, kTable);
  for (const std::size_t at : {0, 5, 9, 20, 60}) {
    const MapRead read = read_of(flipped(good_file(), at));
    EXPECT_TRUE(to_json(read.map, kTable) == whole) << at;
    ASSERT_EQ(read.damage.size(), 1U);
    EXPECT_NE(read.damage[0].find("the copy at its end was read"), std::string::npos);
  }
}

TEST(SmapDamage, OfACutFileTheFirstTilesAreRead) {
  const std::string& good = good_file();
  const MapRead read = read_of(good.substr(0, good.size() / 2));
  EXPECT_GT(read.map.objects.size(), 100U);
  EXPECT_LT(read.map.objects.size(), 500U);
  EXPECT_GT(read.damage.size(), 1U);
  EXPECT_NE(read.damage.back().find("(cut?)"), std::string::npos);
}

TEST(SmapDamage, AStrictReaderTakesNoDamageAtAll) {
  core::Rng rng(8);
  const auto size = static_cast<int>(small_file().size());
  for (int i = 0; i < 3000; ++i) {
    std::string bad = small_file();
    const int at = rng.index(size);
    bad[static_cast<std::size_t>(at)] =
        static_cast<char>(bad[static_cast<std::size_t>(at)] ^ (1 << rng.index(8)));
    EXPECT_THROW((void)from_smap(bad, kTable, "m.smap"), Error) << at;
  }
  for (int i = 0; i < 300; ++i) {
    const auto cut = static_cast<std::size_t>(rng.index(size));
    EXPECT_THROW((void)from_smap(small_file().substr(0, cut), kTable, "m.smap"), Error) << cut;
  }
}

std::string resealed_part(const std::string& part, const std::function<void(std::string&)>& spoil) {
  if (part.empty()) return part;
  std::string content = part.substr(4);
  spoil(content);
  return word(checksum(content)) + content;
}

/// The file with its parts and heads changed by `spoil`, and every checksum right again.
std::string made_up(const std::function<void(std::string&)>& spoil_part,
                    const std::function<void(std::string&)>& spoil_head) {
  SmapHead head = head_of(small_file());
  std::size_t at = bytes_of(small_file());
  std::string tiles;
  for (const SmapTile& tile : head.tiles) {
    for (const std::int64_t bytes : {tile.geometry_bytes, tile.ground_bytes, tile.detail_bytes}) {
      tiles += resealed_part(small_file().substr(at, static_cast<std::size_t>(bytes)), spoil_part);
      at += static_cast<std::size_t>(bytes);
    }
  }
  std::string content = pack_head(head);
  spoil_head(content);
  const std::string frame = framed(kSmapVersion, content);
  return frame + tiles + frame + word(static_cast<std::uint32_t>(frame.size()));
}

void spoil_a_byte(std::string& bytes, core::Rng& rng) {
  const auto at = static_cast<std::size_t>(rng.index(static_cast<int>(bytes.size())));
  bytes[at] = static_cast<char>(rng.index(256));
}

/// \return whether the map could be opened; what it holds is valid then.
bool survives(const std::string& bytes) {
  try {
    const MapRead read = read_of(bytes);
    EXPECT_LE(read.map.objects.size(), bytes.size());
    // What was believed is a map like any other: it can be written, and read again.
    const std::string json = to_json(read.map, kTable);
    EXPECT_EQ(from_json(json, kTable, "m.json").objects.size(), read.map.objects.size());
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    EXPECT_TRUE(std::string(error.what()).starts_with("m.smap: ")) << error.what();
    return false;
  }
}

TEST(SmapDamage, TilesThatWereMadeUpNeverCrashTheReader) {
  core::Rng rng(9);
  for (int i = 0; i < 1500; ++i) {
    EXPECT_TRUE(survives(made_up(
        [&](std::string& part) {
          for (int n = rng.index(4); n > 0; --n) spoil_a_byte(part, rng);
          if (rng.chance(0.05)) part.resize(static_cast<std::size_t>(rng.index(40)));
        },
        [](std::string&) {})));
  }
}

TEST(SmapDamage, HeadsThatWereMadeUpNeverCrashTheReader) {
  core::Rng rng(10);
  int opened = 0;
  for (int i = 0; i < 3000; ++i) {
    opened += survives(made_up([](std::string&) {},
                               [&](std::string& head) {
                                 for (int n = 1 + rng.index(3); n > 0; --n) spoil_a_byte(head, rng);
                               }));
  }
  EXPECT_GT(opened, 0);
  EXPECT_LT(opened, 3000);
}

TEST(SmapDamage, NoiseIsRefusedWithALine) {
  core::Rng rng(11);
  for (int i = 0; i < 2000; ++i) {
    std::string noise(static_cast<std::size_t>(rng.index(200)), '\0');
    for (char& byte : noise) byte = static_cast<char>(rng.index(256));
    if (i % 2 == 0) noise = "SMAP" + word(kSmapVersion) + noise;
    EXPECT_FALSE(survives(noise));
  }
}

TEST(SmapDamage, ANewerVersionIsNamed) {
  const std::string frame = framed(3, "something new");
  try {
    (void)from_smap(frame, kTable, "m.smap");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "m.smap: .smap version 3, expected 1 or 2");
  }
}

TEST(SmapDamage, EveryVersionThatWasEverWrittenIsRead) {
  const std::string folder = source_dir() + "/tests/objects/";
  const std::string json = core::read_file(folder + "version_1.json");
  for (const char* name : {"version_1.smap", "version_2.smap"}) {
    EXPECT_EQ(to_json(read_map(folder + name, kTable), kTable), json) << name;
  }
}

}  // namespace
}  // namespace saker::objects
