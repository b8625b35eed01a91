#include "saker/autonomy/incomplete_targets.h"

#include <gtest/gtest.h>

namespace saker::autonomy {
namespace {

objects::MapObject vehicle(int id) {
  objects::MapObject object;
  object.id = id;
  object.model = objects::Cuboid{};
  return object;
}

active::Target target_at(int incomplete_id) {
  active::Target target;
  target.incomplete_id = incomplete_id;
  return target;
}

std::vector<int> ids_of(const std::vector<objects::MapObject>& objects) {
  std::vector<int> ids;
  for (const objects::MapObject& object : objects) ids.push_back(object.id);
  return ids;
}

TEST(IncompleteTargets, AreInTheMapByAscendingId) {
  objects::ObjectMap map;
  map.objects = {vehicle(1), vehicle(7)};
  map.incomplete = {vehicle(2), vehicle(5), vehicle(9)};
  add_incomplete_targets(map, std::vector{target_at(9), target_at(-1), target_at(5)});
  EXPECT_EQ(ids_of(map.objects), (std::vector{1, 5, 7, 9}));
  EXPECT_EQ(ids_of(map.incomplete), std::vector{2}) << "no prior map speaks for it";
}

TEST(IncompleteTargets, ChangeNothingWhereThereAreNone) {
  objects::ObjectMap map;
  map.objects = {vehicle(1)};
  map.incomplete = {vehicle(2)};
  add_incomplete_targets(map, std::vector{target_at(-1)});
  EXPECT_EQ(ids_of(map.objects), std::vector{1});
  EXPECT_EQ(ids_of(map.incomplete), std::vector{2});
}

}  // namespace
}  // namespace saker::autonomy
